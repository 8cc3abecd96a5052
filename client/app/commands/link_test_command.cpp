#include <poll.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "client/diagnostics/link_verdict.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/command_line.h"
#include "common/io/datagram_batch.h"
#include "common/io/exit_code.h"
#include "common/io/log.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/realtime.h"
#include "common/io/signals.h"
#include "common/io/terminal.h"
#include "common/io/usage_errors.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr int kPriority = 60;         // real-time priority of a device's thread, so that its lateness is measured
constexpr Duration kSilentMax = 10s;  // silence of the server that ends the test
constexpr Duration kRefusedMax = 1s;  // the same after ECONNREFUSED
constexpr int kRounds = 4;

struct LinkTestArguments {
  ConnectionArguments connection;
  std::string json, duration = "10";
  bool quiet = false;
};

enum class Ended { kDone, kInterrupted, kServerEnded, kServerLost };

/// Runs a LinkTest on a socket with one tick per period. Ends after the duration, on a signal, or with the server.
class Prober {
 public:
  Prober(const io::UdpSocket& socket, LinkTest& test, double tick_hz, int signals)
      : socket_(socket), test_(test), period_(from_seconds(1.0 / tick_hz)), signals_(signals) {}

  Ended run(Duration duration, io::StatusLine& line) {
    const Time begin = io::monotonic_now();
    due_ = begin + period_;
    Time shown = begin;
    while (true) {
      if (!tick()) return Ended::kInterrupted;
      const Time now = io::monotonic_now();
      if (test_.closed()) return Ended::kServerEnded;
      const Duration silence = test_.silence(now);
      if (silence > (refused_ ? kRefusedMax : kSilentMax)) return Ended::kServerLost;
      if (now - begin >= duration) return Ended::kDone;
      if (now - shown >= std::chrono::milliseconds(line.interval_ms())) {
        shown = now;
        line.show(format("link test: %.0f of %.0f s", seconds(now - begin), seconds(duration)));
      }
    }
  }
  /// Receives datagrams that are still in flight. @return false if a signal arrived
  bool listen(Duration time) {
    for (const Time end = io::monotonic_now() + time; io::monotonic_now() < end;)
      if (!tick()) return false;
    return true;
  }

 private:
  bool tick() {
    while (io::monotonic_now() < due_) {
      pollfd files[] = {{socket_.fd.get(), POLLIN, 0}, {signals_, POLLIN, 0}};
      const timespec rest = io::to_timespec(due_ - io::monotonic_now());
      ppoll(files, 2, &rest, nullptr);
      if (files[1].revents != 0) return false;
      receive();
      // A pending socket error keeps poll() returning without datagrams: clear it, then wait for the tick.
      if ((files[0].revents & POLLERR) != 0) take_error();
    }
    const Time now = io::monotonic_now();
    const Duration late = now - due_;
    const auto missed = static_cast<std::uint32_t>(late / period_);
    test_.on_tick(now, late, missed, io::read_clock(CLOCK_REALTIME) - io::monotonic_now().time_since_epoch());
    std::array<std::byte, transport::kDatagramMax> buffer;
    while (const auto size = test_.poll_transmit(io::monotonic_now(), buffer))
      if (::send(socket_.fd.get(), buffer.data(), *size, MSG_NOSIGNAL | MSG_DONTWAIT) <
          0)  // a datagram that cannot be sent counts as lost
        refused_ = refused_ || errno == ECONNREFUSED;
    due_ += (missed + 1) * period_;
    return true;
  }

  void receive() {
    for (int round = 0; round < kRounds; ++round) {
      const int count = in_.receive(socket_.fd.get());
      // Read in this order, a preemption between the two clocks can only lengthen the measured transit time.
      const Duration wall = io::read_clock(CLOCK_REALTIME);
      const Time now = io::monotonic_now();
      for (int k = 0; k < count; ++k) {
        const auto i = static_cast<std::size_t>(k);
        // Uses the kernel's arrival time, so that a delay of this program is not attributed to the network.
        refused_ = false;
        if (!in_.too_long(i)) test_.on_datagram(now - in_.details(i, wall).age, in_.bytes(i));
      }
      if (count < static_cast<int>(io::ReceiveBatch::kMax)) return;
    }
  }

  void take_error() {
    int error = 0;
    socklen_t size = sizeof error;
    getsockopt(socket_.fd.get(), SOL_SOCKET, SO_ERROR, &error, &size);
    refused_ = refused_ || error == ECONNREFUSED;
  }

  const io::UdpSocket& socket_;
  LinkTest& test_;
  Duration period_;
  int signals_;
  Time due_{};
  bool refused_ = false;  ///< ECONNREFUSED arrived, and no datagram since
  io::ReceiveBatch in_;
};

using Json = nlohmann::ordered_json;

Json milliseconds(const std::optional<double>& s) { return s ? Json(1e3 * *s) : Json(nullptr); }

Json way(const std::optional<LinkTestResult::Direction>& w) {
  if (!w) return nullptr;
  return {{"sent", w->sent},
          {"lost", w->lost},
          {"loss_percent", w->loss_percent()},
          {"reordered", w->reordered},
          {"longest_gap_ms", 1e3 * w->longest_gap}};
}

/// @param ended_by  reason of the end  @param complete  the test ran to its end and the server was present until then
std::string to_json(const LinkTestResult& f, const LinkVerdict& verdict, const std::string& server,
                    const char* ended_by, bool complete) {
  const Json j = {{"server", server},
                  {"verdict", to_text(verdict.grade)},
                  {"words", verdict.text},
                  {"advice", verdict.advice},
                  {"complete", complete},
                  {"ended_by", ended_by},
                  {"duration_s", f.seconds},
                  {"rate_hz", f.tick_hz},
                  {"rtt_min_ms", milliseconds(f.rtt_min)},
                  {"rtt_p50_ms", milliseconds(f.rtt_p50)},
                  {"rtt_p99_ms", milliseconds(f.rtt_p99)},
                  {"rtt_max_ms", milliseconds(f.rtt_max)},
                  {"jitter_p99_ms", milliseconds(f.jitter)},
                  {"up", way(f.up)},
                  {"down", way(f.down)},
                  {"duplicates", f.duplicates},
                  {"refused", f.refused},
                  {"pauses", f.pauses},
                  {"clock_step_ms", milliseconds(f.clock_step)},
                  {"transit_step_ms", milliseconds(f.transit_step)},
                  {"machine",
                   {{"ticks", f.ticks},
                    {"late_ticks", f.late_ticks},
                    {"missed_ticks", f.missed_ticks},
                    {"wake_p99_ms", 1e3 * f.wake_p99},
                    {"wake_max_ms", 1e3 * f.wake_max}}}};
  return j.dump(2) + "\n";
}

std::string why(Ended ended, const LinkTestResult& findings) {
  switch (ended) {
    case Ended::kDone:
      return "";
    case Ended::kInterrupted:
      return "ended by " + std::string(io::pending_signal()) + ": the results are those of a shorter test";
    case Ended::kServerEnded:
      return "the server ended: the results are those of a shorter test";
    case Ended::kServerLost:
      return format("the server was lost: no datagram came for the last %.1f s. The results cover the time until then",
                    findings.silent_at_end);
  }
  return "";
}

const char* to_text(Ended ended) noexcept {
  constexpr const char* kWords[] = {"done", "interrupted", "server_ended", "server_lost"};
  return kWords[static_cast<std::size_t>(ended)];
}

int link_test_trouble(const std::string& what, int code = io::kExitTrouble) {
  io::log(io::Level::kError, "link-test: " + what);
  return code;
}

/// Runs the test. @param options  without device and signals  @return exit code
int test_link(const LinkTestArguments& arguments, JoinOptions options, double duration_s) {
  const io::Fd signals = io::make_signalfd();
  io::OutputFile json;
  if (const auto problem = json.open(arguments.json, true); !problem.empty())
    return link_test_trouble("--json: " + problem, io::kExitUsage);
  // A link-test peer has no device, but Hello requires plausible capabilities.
  options.caps.joints = options.caps.tip_axes = 1;
  options.caps.simulated = true;
  options.signals = signals.get();
  const auto given = join_seat(options);
  if (!given) return link_test_trouble(given.error().reason);
  auto socket = io::connect_udp(given->udp);
  if (!socket) return link_test_trouble("--server: " + socket.error());

  const auto test = std::make_unique<LinkTest>(given->setup, given->link);
  const auto prober = std::make_unique<Prober>(*socket, *test, given->setup.tick_hz, signals.get());
  io::StatusLine line{arguments.quiet};
  const io::CpuLatencyRequest awake;
  const bool memory = io::lock_memory();
  const bool fifo = io::request_realtime(kPriority);
  Ended ended = prober->run(from_seconds(duration_s), line);
  const Time stopped = io::monotonic_now();
  test->stop_sending(stopped);
  const Duration under_way = from_seconds(std::min(1.0, 0.2 + 2 * test->findings(stopped).rtt_max.value_or(0)));
  bool patient = ended == Ended::kDone && prober->listen(under_way);
  test->leave();
  patient = prober->listen(patient ? under_way : from_seconds(4.0 / given->setup.tick_hz)) && patient;
  line.clear();

  const LinkTestResult findings = test->findings(io::monotonic_now());
  if (ended == Ended::kDone && server_lost(findings)) ended = Ended::kServerLost;
  if (ended != Ended::kDone) line.warn(why(ended, findings));
  const LinkVerdict verdict = assess_link(findings);
  if (!json.on_stdout()) {
    std::string text = summary(findings) + "\n" + to_text(verdict.grade) + ": " + verdict.text + "\n";
    for (const std::string& advice : verdict.advice) text += "- " + advice + "\n";
    if (const std::string notice = io::realtime_warning(fifo, memory, awake.granted());
        !notice.empty() && findings.late_ticks + findings.missed_ticks > 0)
      text += "- " + notice + "\n";
    std::fputs(io::wrap_for_terminal(text, stdout).c_str(), stdout);
  }
  json.write(to_json(findings, verdict, io::to_text(options.server), to_text(ended), ended == Ended::kDone));
  if (const auto problem = json.close(); !problem.empty()) return link_test_trouble(problem);
  if (ended == Ended::kInterrupted) return 0;
  return verdict.grade == LinkGrade::kBad || ended != Ended::kDone ? io::kExitTrouble : 0;
}

int link_test_command(const LinkTestArguments& arguments) {
  io::UsageErrors errors;
  JoinOptions options = connection_of(arguments.connection, errors);
  const double duration = errors.number("--duration", arguments.duration, 1, 3600, "s");
  options.timeout = timeout_of(arguments.connection.timeout, errors);
  errors.output_file("--json", arguments.json);
  if (errors.empty()) return test_link(arguments, std::move(options), duration);
  return errors.report("tandem-client link-test");
}

}  // namespace

void add_link_test_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "link-test",
      "Judges the network to a running server, without taking a seat: delay, jitter, loss, order, gaps, clocks.",
      link_test_command);
  add_server_option(command, arguments.connection, "required: address the server printed");
  add_session_option(command, arguments.connection);
  add_state_option(command, arguments.connection.state);
  command.add_option("--duration", arguments.duration, "how long [s], 1 to 3600; default 10").value_name("S");
  command.add_option("--json", arguments.json, "writes all findings; `-`: to standard output, instead of the text")
      .value_name("FILE|-");
  add_timeout_option(command, arguments.connection.timeout);
  command.add_flag("--quiet", arguments.quiet, "no status");
  command.footer(
      "Sends and receives the datagrams of a hand, at the scene's rate, beside a session that runs or waits; no "
      "participant feels it.\n"
      "Ctrl-C or SIGTERM ends it early, with what was found so far.\n"
      "GOOD: round trip up to 20 ms (99 %), jitter 2 ms, loss 0.1 %, no silence that releases a hand; USABLE: up to "
      "the age the scene\n"
      "trusts, jitter 10 ms, loss 10 %, seldom a gap of up to 50 ms; BAD: anything more.\n"
      "Exit: 0 good or usable, or ended by a signal during the test; 1 not fit for hands, refused, server not "
      "reachable or lost; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-client link-test --server 127.0.0.1:7000\n"
      "  tandem-client link-test --server lab-server:7000 --duration 30s --json link.json");
}

}  // namespace tandem::client
