#include "server/app/process/server_process.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/exit_code.h"
#include "common/io/reachable_address.h"
#include "common/io/realtime.h"
#include "common/io/signals.h"
#include "common/io/systemd_notify.h"
#include "server/app/monitor/clock_watch.h"
#include "server/app/monitor/load_events.h"
#include "server/app/process/session_table.h"
#include "server/app/process/watchdog_feed.h"
#include "server/app/recording/leftover_repair.h"
#include "server/app/service/service_host.h"

namespace tandem::server {
namespace {

constexpr int kPollIntervalMs = 250;
constexpr Duration kDrainMax = std::chrono::seconds(3);
constexpr int kRecordingsIntervalMs = 20;
constexpr Duration kRecordingsMax = std::chrono::seconds(2);

ServerOutput make_output(const ServerOptions& options) {
  return {options.command, !options.quiet && !options.json_log,
          std::ranges::any_of(options.sessions, [](const SessionOptions& s) { return s.json == "-"; })};
}

/// The main loop of a server process: it waits for signals and sessions, and services the parts of the server.
class ServerProcess {
 public:
  explicit ServerProcess(const ServerOptions& options)
      : options_(options), signals_(io::make_signalfd()), output_(make_output(options)), shards_(options) {
    if (options.json_log) io::log_as_json(*options.json_log);
  }
  ~ServerProcess() {
    shards_.join();
    if (control_) control_->stop();
    io::stop_log();
  }

  int run() {
    if (const int code = open(); code != 0) return code;
    sessions_->announce_all();
    output_.print(format("Ctrl-C ends the session%s gently\n", sessions_->all().size() == 1 ? "" : "s"));
    io::systemd_notify("READY=1");
    watchdog_.emplace([this] { return shards_.punctual(); }, [] { io::systemd_notify("WATCHDOG=1"); },
                      io::monotonic_now);
    while (!sessions_->all().empty() || (options_.service && !drain_began_)) run_once();
    if (service_) service_->leave();  // first, because other servers wait for it
    complete_recordings();
    output_.print_posted();
    if (checkpoints_) checkpoints_->stop();
    output_.clear();
    io::log_event(io::Level::kInfo, {.event = "stopped"});
    return sessions_->exit_code();
  }

 private:
  int trouble(const std::string& what) {
    output_.error(what);
    return io::kExitTrouble;
  }

  int open() {
    auto opened =
        ControlServer::open(options_.control, shards_.steering(),
                            {.on_event = [this](const ControlEventRecord& news) { output_.post_control_event(news); },
                             .on_message = [this](const std::string& line) { output_.post_message(line); }});
    if (!opened) return trouble(opened.error());
    control_ = std::move(*opened);
    if (const std::string problem = open_checkpoint_store(); !problem.empty()) return trouble(problem);
    sessions_.emplace(options_, shards_, *control_, checkpoints_.get(), output_);
    if (options_.directory) {
      auto service = ServiceHost::open({options_, *sessions_, shards_, *control_, output_});
      if (!service) return trouble(service.error());
      service_ = std::move(*service);
    } else if (const auto* const membership = control_->membership(); membership != nullptr) {
      const std::string alone = "this server has the member file of a service (name " + membership->name +
                                "), and its configuration no block `directory`: it serves its sessions alone";
      output_.report(io::Level::kWarn, {.event = "service_unused", .text = alone}, alone);
    }
    leftovers_.emplace(recording_folders(), [this](const RecordingRepair& repair) { report_repair(repair); });
    if (const int code = sessions_->open(); code != 0) return code;
    if (checkpoints_) checkpoints_->start();
    memory_locked_ = io::lock_memory();
    shards_.take_sockets(control_->take_sockets());
    sessions_->begin();
    for (const auto& shard : shards_.all()) control_->registry().requests().watch(*shard);
    if (const auto problem = control_->start(); !problem.empty()) return trouble(problem);
    shards_.run();
    if (service_) service_->start();
    // Scripts wait for this line.
    output_.print("listening on " + io::to_text(control_->address()) + "\n");
    if (const std::string note = io::only_here_note(control_->address(), io::reachable_address(control_->address()));
        !note.empty())
      output_.print("note: " + note + "\n");
    if (options_.on_listening) options_.on_listening(io::to_text(control_->address()));
    if (const auto at = control_->metrics_address())
      output_.print("metrics on http://" + io::to_text(*at) + "/metrics\n");
    return 0;
  }

  /// With ephemeral keys and a chosen port the next start has another port, so no client could resume: checkpoints are
  /// not stored.
  std::string open_checkpoint_store() {
    if (control_->ephemeral_keys() && options_.control.listen.port() == 0) return {};
    auto opened = CheckpointStore::open(
        control_->folder(), control_->ephemeral_keys() ? io::to_text(options_.control.listen) + "-" : "",
        [this](const std::string& what) { output_.post_checkpoint_error(what); },
        [this](const std::string& what) { output_.post_checkpoint_recovery(what); });
    if (!opened) return opened.error();
    checkpoints_ = std::move(*opened);
    return {};
  }

  [[nodiscard]] std::vector<std::string> recording_folders() const {
    std::vector<std::string> folders;
    const auto add = [&folders](const RecordingOptions& record) {
      if (record.target.empty()) return;
      std::string folder = recording_folder(record.target);
      if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(std::move(folder));
    };
    add(options_.record);
    for (const SessionOptions& session : options_.sessions) add(session.record);
    return folders;
  }

  /// On the thread that repairs.
  void report_repair(const RecordingRepair& repair) {
    if (repair.kind == RecordingRepair::Kind::kInUse) return;  // of another server with the same folder
    const bool failed = repair.kind == RecordingRepair::Kind::kFailed;
    io::log_event(failed ? io::Level::kWarn : io::Level::kInfo, {.event = "recording_repaired", .text = repair.text});
    output_.post_message("recording of an earlier run: " + repair.text);
  }

  /// Waits for at most 250 ms, then services signals, messages, sessions and the status line.
  void run_once() {
    std::vector<pollfd> files{{signals_.get(), POLLIN, 0}};
    files.push_back({control_->orders().fd(), POLLIN, 0});
    if (service_) files.push_back({service_->fd(), POLLIN, 0});
    for (const auto& session : sessions_->all()) files.push_back({session->live_session().over_fd(), POLLIN, 0});
    if (poll(files.data(), files.size(), kPollIntervalMs) > 0 && files[0].revents != 0) take_signal();
    const Time now = io::monotonic_now();
    output_.print_posted();
    const auto due = control_->registry().drain().due();
    if (due && !drain_began_ && now >= *due) drain("ended by a drain command");
    if (due && !drain_began_ && service_ && service_->left_by_all())
      drain("ended by a drain command, after all sessions have moved to other servers");
    if (drain_began_ && now - *drain_began_ > kDrainMax) exit_now("the sessions did not end within 3 s");
    watchdog_->main_loop_ran();
    report_machine();
    while (auto order = control_->orders().take())
      if (!service_ || !service_->take(*order)) sessions_->execute(std::move(*order));
    if (service_) service_->step(now);
    check_start();
    sessions_->service(now);
    sessions_->balance(now);
    sessions_->service_recordings();
    if (!output_.due(now) || drain_began_) return;
    output_.show(now, sessions_->screen_entries(),
                 due ? format("DRAINING, %.0f s left", std::max(0.0, std::ceil(seconds(*due - now)))) : "",
                 sessions_->hints().list_command());
  }

  void check_start() {
    if (!options_.start_problem || drain_began_ || sessions_->all().empty()) return;
    if (sessions_->all().front()->live_session().status().state != wire::SessionState::kWaiting) return;
    if (const std::string why = options_.start_problem(); !why.empty()) drain(why);
  }

  /// Reports changes of the load and steps of the wall clock, and once whether the ticks have real-time priority.
  void report_machine() {
    if (const std::string step = clock_watch_.update(auth::wall_seconds(), io::boottime_now()); !step.empty())
      output_.report(io::Level::kWarn, {.event = "clock_set", .text = step}, step);
    for (const LoadEvents::Event& event : load_events_.update(shards_.all())) {
      io::log_event(event.more ? io::Level::kWarn : io::Level::kInfo,
                    {.event = event.more ? "shed" : "shed_less", .text = event.text});
      if (!io::logs_json()) output_.note(event.text);
    }
    if (realtime_reported_ || sessions_->all().empty()) return;
    const MachineStatus machine = sessions_->all().front()->live_session().status().machine;
    if (!machine.started) return;
    realtime_reported_ = true;
    if (const std::string notice = io::realtime_warning(machine.realtime, memory_locked_, awake_.granted());
        !notice.empty())
      output_.note(notice);
  }

  /// Waits for the last files of recordings, at most kRecordingsMax.
  void complete_recordings() {
    const Time until = io::monotonic_now() + kRecordingsMax;
    sessions_->service_recordings();
    while (sessions_->recordings_busy() && io::monotonic_now() < until) {
      poll(nullptr, 0, kRecordingsIntervalMs);
      sessions_->service_recordings();
    }
  }

  void take_signal() {
    const std::string_view by = io::pending_signal();
    signalfd_siginfo taken;
    [[maybe_unused]] const auto got = ::read(signals_.get(), &taken, sizeof taken);
    if (drain_began_) exit_now("received a second signal");
    drain("ended by " + std::string(by.empty() ? "Ctrl-C" : by));
  }

  void drain(const std::string& why) {
    drain_began_ = io::monotonic_now();
    io::systemd_notify("STOPPING=1");
    const std::string text = why + ": all hands are released";
    output_.report(io::Level::kInfo, {.event = "draining", .text = text}, text);
    control_->change([](SessionRegistry& registry, const auto& done) {
      registry.drain().begin();
      done();
    });
    if (service_) service_->release_consoles();
    sessions_->drain();
    shards_.stop(sessions_->will_resume() && options_.control.listen.port() != 0 ? wire::CloseReason::kServerReturns
                                                                                 : wire::CloseReason::kServerStops);
  }

  /// Ends the process without a close-out. The clients' own gates release the hands.
  [[noreturn]] void exit_now(const char* why) {
    if (checkpoints_ && !sessions_->will_resume()) checkpoints_->remove_all();
    output_.clear();
    std::fprintf(stderr, "tandem-server: %s; ends at once\n", why);
    ::_exit(io::kExitTrouble);
  }

  const ServerOptions& options_;
  io::Fd signals_;
  io::CpuLatencyRequest awake_;
  ServerOutput output_;
  ShardPool shards_;
  std::unique_ptr<ControlServer> control_;
  std::unique_ptr<CheckpointStore> checkpoints_;  ///< null: no client could resume after a restart
  std::unique_ptr<ServiceHost> service_;          ///< null: the server is alone; it outlives the sessions
  std::optional<SessionTable> sessions_;
  LoadEvents load_events_;
  ClockWatch clock_watch_;
  std::optional<LeftoverRepair> leftovers_;
  std::optional<Time> drain_began_;
  bool memory_locked_ = false, realtime_reported_ = false;
  std::optional<WatchdogFeed> watchdog_;  ///< last: its thread reads the shards
};

}  // namespace

int run_server(const ServerOptions& options) { return ServerProcess{options}.run(); }

}  // namespace tandem::server
