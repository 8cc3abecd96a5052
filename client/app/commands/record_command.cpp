#include <poll.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "client/app/telemetry_feed.h"
#include "client/app/telemetry_record.h"
#include "common/base/format.h"
#include "common/base/hex.h"
#include "common/io/clock.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/terminal.h"
#include "common/io/usage_errors.h"
#include "proto/text/scene_bytes.h"
#include "server/recording/io/recording_files.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using server::RecordingFiles;

constexpr Duration kFeedLostAfter = 3s;  // silence of the server that ends the recording
constexpr Duration kRecordFilesInterval = 250ms, kRecordEndLimit = 10s;
constexpr std::uint64_t kRecordLinksEvery = 4;  // datagrams; each has the link of another seat
constexpr int kRecordEndPollMs = 20;

struct RecordArguments {
  ConnectionArguments connection;
  std::string out;
  bool quiet = false;
};

int record_trouble(const std::string& text) {
  io::print(stderr, "tandem-client record: " + text + "\n");
  return io::kExitTrouble;
}

std::string output_problem(const std::string& path) {
  if (!path.ends_with(".mcap")) return "must end with .mcap";
  if (std::string problem = io::OutputFile::problem(path); !problem.empty()) return problem;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> there{std::fopen(path.c_str(), "re"), std::fclose};
  return there ? "exists already; choose another name" : "";
}

/// Records what a feed shows until a signal, the end of the session or the loss of the server.
class RemoteRecording {
 public:
  RemoteRecording(TelemetryFeed& feed, RecordingFiles& files, bool quiet) : feed_(feed), files_(files), line_(quiet) {}

  int run(int signals) {
    std::string why;
    while (why.empty()) {
      pollfd wait[] = {{feed_.fd(), POLLIN, 0}, {signals, POLLIN, 0}};
      poll(wait, 2, TelemetryFeed::kServeIntervalMs);
      const Time now = io::monotonic_now();
      feed_.serve(now, [this](const SessionWatch& watch) { add(watch); });
      step(now);
      if (wait[1].revents != 0) why = "ended here";
      if (feed_.watch().closed()) why = "the session is over";
      if (files_.ended()) why = "the limit of the size is reached";
      if (why.empty() && feed_.watch().silence(now) > kFeedLostAfter)
        why = feed_.watch().newest() ? "the server was lost: no datagram for 3 s"
                                     : "no datagram arrived, although the server accepted the join; a firewall may "
                                       "block UDP. `tandem-client link-test` judges the link";
    }
    const bool lost = !feed_.watch().closed() && why.find("datagram") != std::string::npos;
    feed_.leave(io::monotonic_now());
    return finish(why, lost);
  }

 private:
  void add(const SessionWatch& watch) {
    const server::TickRecord record = record_of(feed_.scene(), watch);
    if (!record.running) return;
    if (!files_.begun()) files_.begin(io::read_clock(CLOCK_REALTIME).count() - record.time_ns);
    files_.add(record);
    if (const wire::WatchedLink& link = watch.newest()->link; received_++ % kRecordLinksEvery == 0)
      files_.writer().add_link({.tick = record.tick,
                                .seat = link.seat,
                                .rtt_p50_ms = link.rtt_p50_ms,
                                .loss_up_percent = link.loss_up_percent,
                                .loss_down_percent = link.loss_down_percent,
                                .gap_up_ms = link.gap_up_ms,
                                .gap_down_ms = link.gap_down_ms,
                                .age_p99_ms = link.age_p99_ms,
                                .gate_trips = link.gate_trips,
                                .late_ticks = link.late_ticks});
  }

  void step(Time now) {
    if (now < next_files_) return;
    next_files_ = now + kRecordFilesInterval;
    files_.step(now);
    tell(now);
  }

  void tell(Time now) {
    for (const std::string& problem : files_.take_problems()) line_.note(problem);
    for (const std::string& path : files_.take_completed()) line_.note(path + " is complete");
    if (files_.trouble() != trouble_) {
      trouble_ = files_.trouble();
      line_.note(trouble_.empty() ? "the recording goes on" : "ticks are dropped: " + trouble_);
    }
    if (now < next_line_) return;
    next_line_ = now + std::chrono::milliseconds(line_.interval_ms());
    line_.show(format("%llu ticks, %llu lost or dropped, %.1f MiB", static_cast<unsigned long long>(files_.recorded()),
                      static_cast<unsigned long long>(files_.lost()), static_cast<double>(files_.bytes()) / (1 << 20)));
  }

  int finish(const std::string& why, bool lost) {
    files_.begin_close();
    const Time until = io::monotonic_now() + kRecordEndLimit;
    while (!files_.closed() && io::monotonic_now() < until) poll(nullptr, 0, kRecordEndPollMs);
    files_.abandon();
    line_.clear();
    const auto problems = files_.take_problems();
    for (const std::string& path : files_.take_completed()) io::print(stdout, path + " is complete\n");
    for (const std::string& path : files_.take_removed()) io::print(stdout, path + " was removed: no tick arrived\n");
    for (const std::string& problem : problems) record_trouble(problem);
    io::print(stdout, format("%s: %llu ticks recorded, %llu lost or dropped\n", why.c_str(),
                             static_cast<unsigned long long>(files_.recorded()),
                             static_cast<unsigned long long>(files_.lost())));
    return lost || !problems.empty() ? io::kExitTrouble : io::kExitDone;
  }

  TelemetryFeed& feed_;
  RecordingFiles& files_;
  io::StatusLine line_;
  Time next_files_{}, next_line_{};
  std::string trouble_;
  std::uint64_t received_ = 0;
};

server::RecordingInfo recording_info(const TelemetryFeed& feed) {
  const rpc::Welcome& welcome = feed.console().welcome;
  return {.session = welcome.session_name,
          .scene_text = scene_file_text(feed.scene()),
          .metadata = {{"session_id", to_hex(welcome.session_id)},
                       {"epoch", std::to_string(welcome.epoch)},
                       {"program", "tandem-client record: single precision, no inputs, no energies"}},
          .start_unix_ns = 0,
          .persons = {}};
}

int record_command(const RecordArguments& arguments) {
  io::UsageErrors errors;
  JoinOptions asking = connection_of(arguments.connection, errors);
  asking.timeout = timeout_of(arguments.connection.timeout, errors);
  asking.watch = true;
  asking.console = AccessRole::kRecorder;
  asking.ticket = ticket_of(arguments.connection.ticket, errors);
  if (const std::string problem = output_problem(arguments.out); !problem.empty())
    errors.add("--out " + arguments.out, problem);
  if (!errors.empty()) return errors.print("tandem-client record: ");
  const io::Fd signals = io::make_signalfd();
  asking.signals = signals.get();
  auto feed = TelemetryFeed::open(asking);
  if (!feed) return record_trouble(feed.error().reason);
  auto files = RecordingFiles::open(arguments.out, feed->scene(), recording_info(*feed), {}, io::monotonic_now());
  if (!files) return record_trouble(files.error());
  return RemoteRecording(*feed, **files, arguments.quiet).run(signals.get());
}

}  // namespace

void add_record_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "record", "Records a session from anywhere without taking a seat: every tick that arrives.", record_command);
  add_server_option(command, arguments.connection);
  command
      .add_option("--out", arguments.out,
                  "file to write, MCAP for Foxglove, Rerun, PlotJuggler and tandem-netsim; it must not exist")
      .value_name("FILE.mcap")
      .required();
  add_session_option(command, arguments.connection,
                     "name, code or id of the session; default: the ticket's, or the only one there");
  add_ticket_options(command, arguments.connection.ticket,
                     "ticket printed by `tandem-server ticket --role recorder`; not needed with a loopback server with "
                     "ephemeral keys");
  add_state_option(command, arguments.connection.state);
  add_timeout_option(command, arguments.connection.timeout);
  command.add_flag("--quiet", arguments.quiet, "no status line");
  command.footer(
      "Records until Ctrl-C or the end of the session; all participants see that a recording runs. Values have single\n"
      "precision; inputs, joints, energies and commanded forces are in recordings of the server only (tandem-server\n"
      "run --record). Ticks that the network lost are counted in the file. The file is NAME.mcap.part until it is "
      "complete;\n"
      "`tandem-server repair` closes one that was cut.\n"
      "Exit: 0 done; 1 refused, with the reason, server lost, or file not complete; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-client record --server 127.0.0.1:7000 --out lesson.mcap\n"
      "  tandem-client record --server lab-server:7000 --ticket-file recorder.ticket --out lesson.mcap");
}

}  // namespace tandem::client
