#include "server/app/host.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/signalfd.h>

#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "common/io/clock.h"
#include "common/io/output_file.h"
#include "common/io/realtime.h"
#include "common/io/signals.h"
#include "common/io/terminal.h"
#include "server/app/attendance.h"
#include "server/app/front_door.h"
#include "server/app/recorder.h"
#include "server/app/shard.h"
#include "server/app/slaves.h"
#include "server/report_summary.h"

namespace tandem::server {
namespace {

constexpr int kFailed = 1;
constexpr int kTrouble = 1;  // while running
constexpr int kWrong = 2;    // in arguments or files
/// Two seconds of ticks at 1 kHz: how long the recorder may be kept from running before ticks are dropped and counted.
constexpr std::size_t kQueueTicks = 2048;
constexpr int kLookEveryMs = 250;

/// Why a session ended.
enum class End { kScene, kSignal, kNobodyCame, kPeersLost };

const char* to_text(End end) {
  switch (end) {
    case End::kScene:
      return "scene";
    case End::kSignal:
      return "signal";
    case End::kNobodyCame:
      return "nobody_came";
    case End::kPeersLost:
      return "peers_lost";
  }
  return "";
}

/// Clients are usually started from where the server is: with a path if this program needed one.
std::string client_command() {
  const std::string own = program_invocation_name;
  const auto slash = own.rfind('/');
  return (slash == std::string::npos ? "" : own.substr(0, slash + 1)) + "tandem-client";
}

void announce(std::FILE* people, const SceneSpec& scene, const io::SocketAddress& at, const std::string& code) {
  const std::string address = io::to_text(at);
  const std::string dialled = at.any() ? "SERVER:" + std::to_string(at.port()) : address;
  std::fprintf(people, "listening on %s\n", address.c_str());  // scripts wait for this line
  std::fprintf(people, "scene %s, %g s; %s\n", scene.name.c_str(), scene.duration,
               code.empty() ? "in other terminals type" : ("session code " + code_text(code) + "; on enrolled workstations type").c_str());
  for (const SeatSpec& seat : scene.seats)
    std::fprintf(people, "  %s join --server %s --seat %s --device sim%s%s\n", client_command().c_str(), dialled.c_str(), seat.name.c_str(),
                 code.empty() ? "" : seat.role == Role::kInstructor ? " --ticket TICKET" : (" --session " + code_text(code)).c_str(),
                 seat.required ? "" : "    # optional");
  if (!code.empty())
    std::fprintf(people, "a TICKET is written by `tandem-server ticket --session %s --seat SEAT --workstation NAME`\n", scene.name.c_str());
  std::fprintf(people, "Ctrl-C ends the session gently\n");
  std::fflush(people);
}

/// On the door's thread: what somebody who runs a server wants to know of those who could not come in.
void tell_log(const ControlNews& news) {
  switch (news.event) {
    case ControlEvent::kNotEnrolled:
    case ControlEvent::kBlocked:
    case ControlEvent::kCodeRefused:
    case ControlEvent::kRefused:
      spdlog::warn("{} {}: {} {}", news.address, news.workstation, to_text(news.event), news.detail);
      break;
    case ControlEvent::kTrouble:
      spdlog::error("{} {}: {}", news.address, news.workstation, news.detail);
      break;
    default:
      break;
  }
}

/// Waits for the end and tells people meanwhile.
End watch(Shard& shard, const HostedSession& session, const HostPlan& plan, int signals, bool memory, bool awake) {
  io::StatusLine line{plan.quiet};
  Attendance attendance;
  const Time begin = io::monotonic_now();
  Time shown = begin;
  bool told = false;
  std::optional<End> end;
  pollfd files[] = {{session.over_fd(), POLLIN, 0}, {signals, POLLIN, 0}};
  const auto finish = [&](End why) {
    if (!end) end = why;
    shard.stop();
  };
  while (true) {
    const int ready = poll(files, 2, kLookEveryMs);
    if (ready > 0 && files[0].revents != 0) break;
    if (ready > 0 && files[1].revents != 0) {
      const std::string_view by = io::signal_that_came();
      signalfd_siginfo taken;
      [[maybe_unused]] const auto got = ::read(signals, &taken, sizeof taken);
      line.note("ended by " + std::string(by.empty() ? "Ctrl-C" : by) + ": all hands are let go gently");
      finish(End::kSignal);
      continue;
    }
    const Time now = io::monotonic_now();
    const SessionStatus status = session.status();
    if (!told) {
      told = true;
      const std::string notice = io::realtime_notice(status.machine.realtime, memory, awake);
      if (!notice.empty()) line.note(notice);
    }
    const Attendance::News news = attendance.look(now, status, plan.scene);
    for (const std::string& note : news.notes) line.note(note);
    for (const std::string& warning : news.warnings) line.warn(warning);
    if (end) continue;
    if (news.all_lost) {
      line.warn("peers lost: everybody has been gone for 10 s; the session ends");
      finish(End::kPeersLost);
    } else if (plan.wait_s > 0 && status.state == wire::SessionState::kWaiting && seconds(now - begin) > plan.wait_s) {
      line.warn("nobody came for " + waiting_for(status, plan.scene) + " within " + std::to_string(plan.wait_s) +
                " s (--wait); the session ends");
      finish(End::kNobodyCame);
    } else if (now - shown >= std::chrono::milliseconds(line.interval_ms())) {
      shown = now;
      line.show(status_line(status, plan.scene));
    }
  }
  line.clear();
  return end.value_or(End::kScene);
}

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto s = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return s(used.ru_utime) + s(used.ru_stime);
}

RunReport judge(const HostPlan& plan, const HostedSession& session, const Recorder& recorder) {
  const SessionStatus& last = session.final_status();
  std::vector<LinkReport> links;
  for (std::size_t i = 0; i < plan.scene.seats.size(); ++i) links.push_back(last.seats[i].link);
  RunReport report = recorder.builder().build(links);
  report.seed = plan.seed;
  report.violations = session.violations().list();
  report.passed = session.violations().passed();
  report.trace_hash = recorder.trace_hash();
  report.cpu_s = cpu_seconds();
  for (std::size_t i = 0; i < report.seats.size(); ++i) report.seats[i].gate_trips = last.seats[i].gate_trips;
  return report;
}

/// The report of every run, and what only a live one knows.
std::string live_json(const RunReport& report, End end, const MachineStatus& machine, const TickQueue& queue) {
  auto json = nlohmann::ordered_json::parse(to_json(report));
  json["ended_by"] = to_text(end);
  json["machine"] = {{"late_ticks", machine.late_ticks},
                     {"missed_ticks", machine.missed_ticks},
                     {"recorder_dropped", queue.dropped()},
                     {"realtime", machine.realtime}};
  return json.dump(2) + "\n";
}

void summarize(std::FILE* people, const RunReport& report, const SceneSpec& scene, const SessionStatus& last) {
  std::fprintf(people, "%s: %s, %.1f s, ticks more than 1 ms late on this machine: %llu\n", report.scenario.c_str(),
               report.passed ? "pass" : "FAIL", report.duration_s,
               static_cast<unsigned long long>(last.machine.late_ticks));
  std::fputs(report_summary(report, scene).c_str(), people);
  std::fflush(people);
}

}  // namespace

int host(const HostPlan& plan) {
  const auto trouble = [](const std::string& what, int code) {
    spdlog::error("run: {}", what);
    return code;
  };
  const io::Fd signals = io::signals_as_file();
  auto slaves = make_slaves(plan.scene, io::monotonic_now());
  if (!slaves) {
    for (const std::string& mistake : slaves.error()) spdlog::error("run: {}", mistake);
    return kWrong;
  }
  auto door = FrontDoor::open({plan.listen, plan.state, tell_log});
  if (!door) return trouble(door.error(), kTrouble);
  io::OutputFile json, trace;
  if (const auto problem = json.open(plan.json, true); !problem.empty()) return trouble("--json: " + problem, kWrong);
  if (const auto problem = trace.open(plan.trace, false); !problem.empty())
    return trouble("--trace: " + problem, kWrong);

  const io::AwakeProcessor awake;
  const bool memory = io::lock_memory();
  TickQueue queue{kQueueTicks};
  Recorder recorder{plan.scene, queue, trace};
  const auto session = std::make_unique<HostedSession>(plan.scene, std::move(*slaves), std::uint8_t{0}, queue);
  const auto shard = std::make_unique<Shard>((*door)->take_socket(), plan.scene.tick_hz);
  shard->host(*session);
  const std::string code = (*door)->throw_away() ? std::string() : draw_session_code();
  (*door)->add({plan.scene.name, trust::random_bytes<trust::Id16>(), code, 1, session.get(), shard.get()});
  (*door)->watch(*shard);
  if (const auto problem = (*door)->start(); !problem.empty()) return trouble(problem, kTrouble);
  std::thread ticks{[&] { shard->run(); }};

  // With JSON on standard output people's lines move out of the way.
  std::FILE* const people = json.on_stdout() ? stderr : stdout;
  announce(people, plan.scene, (*door)->address(), code);
  const End end = watch(*shard, *session, plan, signals.get(), memory, awake.granted());
  shard->stop();
  ticks.join();
  (*door)->stop();
  recorder.finish();

  const RunReport report = judge(plan, *session, recorder);
  if (!plan.quiet) summarize(people, report, plan.scene, session->final_status());
  json.write(live_json(report, end, session->final_status().machine, queue));
  for (io::OutputFile* file : {&json, &trace})
    if (const auto problem = file->close(); !problem.empty()) return trouble(problem, kTrouble);
  switch (end) {
    case End::kSignal:
      return 0;
    case End::kScene:
      return report.passed ? 0 : kFailed;
    case End::kNobodyCame:
    case End::kPeersLost:
      return kTrouble;
  }
  return kTrouble;
}

}  // namespace tandem::server
