#include "server/app/process/server_process.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "common/base/command_hints.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/clock.h"
#include "common/io/exit_code.h"
#include "common/io/help_text.h"
#include "common/io/print.h"
#include "common/io/reachable_address.h"
#include "common/io/realtime.h"
#include "common/io/signals.h"
#include "common/io/systemd_notify.h"
#include "common/io/terminal.h"
#include "server/app/control/control_server.h"
#include "server/app/monitor/load_events.h"
#include "server/app/monitor/message_queue.h"
#include "server/app/monitor/startup_banner.h"
#include "server/app/process/checkpoint_store.h"
#include "server/app/process/shard_pool.h"
#include "server/report/audit_text.h"
#include "server/report/report_summary.h"

namespace tandem::server {
namespace {

constexpr int kPollIntervalMs = 250;
constexpr Duration kDrainMax = std::chrono::seconds(3);

/// Reports rejections and errors to the operator of the server. Called on the control thread.
void report_control_event(MessageQueue& notices, const ControlEventRecord& news) {
  const bool trouble = news.event == ControlEvent::kTrouble;
  switch (news.event) {
    case ControlEvent::kNotEnrolled:
    case ControlEvent::kBlocked:
    case ControlEvent::kCodeRefused:
    case ControlEvent::kRefused:
    case ControlEvent::kTrouble:
      break;
    default:
      return;
  }
  // Without an address the event is about the server itself.
  const std::string who = news.address.empty() ? "" : news.address + " " + news.workstation;
  if (io::logs_json())
    return io::log_event(
        trouble ? io::Level::kError : io::Level::kWarn,
        {.event = std::string(to_text(news.event)), .text = who + (who.empty() ? "" : ": ") + news.detail});
  const std::string what =
      trouble ? who + (who.empty() ? "" : ": ")
              : who + " " + std::string(control_event_text(news.event)) + (news.detail.empty() ? "" : ": ");
  notices.add(trouble ? MessageQueue::Severity::kError : MessageQueue::Severity::kWarning,
              what + sanitize(news.detail));
}

std::vector<double> tick_rates(const ServerOptions& plan) {
  std::vector<double> rates;
  for (const SessionOptions& session : plan.sessions) rates.push_back(session.scene.tick_hz);
  return rates;
}

/// Called on the store's thread.
void report_checkpoint_error(MessageQueue& notices, const std::string& what) {
  if (io::logs_json()) return io::log_event(io::Level::kError, {.event = "checkpoint_trouble", .text = what});
  notices.add(MessageQueue::Severity::kError, "checkpoint: " + what);
}

/// The main loop of a server process.
class ServerProcess {
 public:
  explicit ServerProcess(const ServerOptions& plan)
      : options_(plan),
        signals_(io::make_signalfd()),
        shard_pool_(tick_rates(plan)),
        line_(plan.quiet || plan.json_log.has_value()) {
    if (plan.json_log) io::log_as_json(*plan.json_log);
  }
  ~ServerProcess() {
    shard_pool_.join();
    if (control_server_) control_server_->stop();
    io::stop_log();
  }

  int run() {
    if (const int code = open(); code != 0) return code;
    for (const auto& r : sessions_) announce(*r);
    std::fprintf(output_stream(), "Ctrl-C ends the session%s gently\n", sessions_.size() == 1 ? "" : "s");
    std::fflush(output_stream());
    io::systemd_notify("READY=1");
    while (!sessions_.empty()) run_once();
    print_messages();
    if (checkpoint_store_) checkpoint_store_->stop();
    line_.clear();
    io::log_event(io::Level::kInfo, {.event = "stopped"});
    return exit_code_;
  }

 private:
  int trouble(const std::string& what) {
    io::log(io::Level::kError, std::string(options_.command) + ": " + what);
    return io::kExitTrouble;
  }

  /// Messages go to standard error if a JSON report goes to standard output.
  [[nodiscard]] std::FILE* output_stream() const {
    return std::ranges::any_of(sessions_, [](const auto& r) { return r->writes_to_stdout(); }) ? stderr : stdout;
  }

  int open() {
    ControlServer::Options door{options_.listen, options_.state,
                                [this](const ControlEventRecord& news) { report_control_event(messages_, news); }};
    door.on_message = [this](const std::string& line) {
      if (!io::logs_json()) messages_.add(MessageQueue::Severity::kInfo, line);
    };
    door.limits = options_.limits;
    door.load_limits = options_.load_limits;
    door.steering = shard_pool_.steering();
    door.metrics = options_.metrics;
    door.metrics_hosts = options_.metrics_hosts;
    door.audit = options_.audit;
    auto opened = ControlServer::open(door);
    if (!opened) return trouble(opened.error());
    control_server_ = std::move(*opened);
    client_address_ = shell_quote(io::reachable_address(control_server_->address()));
    if (const std::string problem = open_checkpoint_store(); !problem.empty()) return trouble(problem);
    for (std::size_t slot = 0; slot < options_.sessions.size(); ++slot) {
      const SessionOptions& session = options_.sessions[slot];
      const CheckpointStore::Found left =
          checkpoint_store_
              ? checkpoint_store_->find(session.name, session.scene, auth::wall_seconds(), !options_.no_restore)
              : CheckpointStore::Found{};
      auto made = open_session(session, slot, 1, left.snapshot ? &*left.snapshot : nullptr);
      if (!made) return made.error();
      sessions_.push_back(std::move(*made));
      report_restored_session(*sessions_.back(), left);
    }
    if (checkpoint_store_) checkpoint_store_->start();
    memory_ = io::lock_memory();
    shard_pool_.take_sockets(control_server_->take_sockets());
    for (const auto& r : sessions_) {
      shard_pool_.of_slot(r->live_session().slot()).add_session(r->live_session());
      control_server_->add_session(registration_of(*r));
    }
    for (const auto& shard : shard_pool_.all()) control_server_->watch(*shard);
    if (const auto problem = control_server_->start(); !problem.empty()) return trouble(problem);
    shard_pool_.run();
    began_ = io::monotonic_now();
    // Scripts wait for this line.
    std::fprintf(output_stream(), "listening on %s\n", io::to_text(control_server_->address()).c_str());
    if (const auto at = control_server_->metrics_address())
      std::fprintf(output_stream(), "metrics on http://%s/metrics\n", io::to_text(*at).c_str());
    return 0;
  }

  /// With ephemeral keys and a chosen port the next start has another port, so no client could resume: checkpoints are
  /// not stored.
  std::string open_checkpoint_store() {
    if (control_server_->ephemeral_keys() && options_.listen.port() == 0) return {};
    auto opened = CheckpointStore::open(control_server_->folder(),
                                        control_server_->ephemeral_keys() ? io::to_text(options_.listen) + "-" : "",
                                        [this](const std::string& what) { report_checkpoint_error(messages_, what); });
    if (!opened) return opened.error();
    checkpoint_store_ = std::move(*opened);
    return {};
  }

  void report_restored_session(const SessionInstance& r, const CheckpointStore::Found& left) {
    const std::string& name = r.options().name;
    if (!left.incompatibility.empty()) {
      const std::string text =
          "session " + name + " starts from the beginning: its checkpoint is not used: " + left.incompatibility;
      if (!io::logs_json()) line_.warn(text);
      io::log_event(io::Level::kWarn, {.event = "checkpoint_unfit", .session = name, .text = text});
    }
    if (!left.snapshot) return;
    const Checkpoint& from = left.snapshot->checkpoint;
    std::string text =
        format("session %s RESTORED from its checkpoint, %lld s old: at %.1f s, epoch %llu", name.c_str(),
               static_cast<long long>(std::max<std::int64_t>(0, auth::wall_seconds() - left.snapshot->written_s)),
               from.session_tick / r.options().scene.tick_hz, static_cast<unsigned long long>(r.epoch()));
    if (from.begun)
      text +=
          "; it waits until the instructors and all seats with authority are back, or an instructor (key r) or "
          "operator (`tandem-client control" +
          client_options(r) + " resume`) resumes without them";
    if (from.stop != StopLatch::Level::kNone)
      text += "; it was stopped, and stays stopped until an instructor or operator resumes it";
    if (!io::logs_json())
      line_.note(text + (options_.sessions_resume ? "" : "; --no-restore starts it from the beginning"));
    io::log_event(io::Level::kInfo,
                  {.event = "session_restored", .session = name, .tick = from.session_tick, .text = text});
  }

  std::expected<std::unique_ptr<SessionInstance>, int> open_session(const SessionOptions& plan, std::size_t slot,
                                                                    std::uint64_t epoch,
                                                                    const SessionSnapshot* kept = nullptr) {
    auto made = SessionInstance::open(plan, static_cast<std::uint8_t>(slot), epoch,
                                      !control_server_->ephemeral_keys() && !plan.tickets_only, kept);
    if (made && checkpoint_store_)
      (*made)->live_session().persist_to(
          checkpoint_store_->add(
              {{},
               (*made)->id(),
               plan.name,
               (*made)->code(),
               0,
               kept != nullptr ? kept->removed_workstations : decltype(kept->removed_workstations){}}),
          (*made)->epoch());
    if (made) return std::move(*made);
    for (const std::string& text : made.error().texts) trouble(text);
    return std::unexpected(made.error().code);
  }

  SessionRegistry::Registration registration_of(SessionInstance& r) {
    SessionRegistry::Registration o{r.options().name,
                                    r.id(),
                                    r.code(),
                                    r.epoch(),
                                    &r.live_session(),
                                    &shard_pool_.of_slot(r.live_session().slot()),
                                    r.snapshot(),
                                    {},
                                    r.snapshot() != nullptr ? r.resume_until() : Time{}};
    if (checkpoint_store_)
      o.on_removed = [book = checkpoint_store_.get(), name = r.options().name](const auto& keys) {
        book->set_removed(name, keys);
      };
    return o;
  }

  void announce(const SessionInstance& r) {
    // A journal, file or pipe stores what is printed, and other users may read it. So codes are shown on terminals
    // only.
    const std::string folder = control_server_->ephemeral_keys() ? "" : control_server_->folder();
    const std::string read_code = ::isatty(::fileno(output_stream())) == 1 ? "" : list_command();
    std::fputs(io::wrap_for_terminal(startup_banner(r, control_server_->address(), control_server_->ephemeral_keys(),
                                                    options_.sessions.size() > 1, folder, read_code),
                                     output_stream())
                   .c_str(),
               output_stream());
    std::fflush(output_stream());
    io::log_event(io::Level::kInfo,
                  {.event = "session_opened", .session = r.options().name, .text = r.options().scene.name});
  }

  /// Waits for at most 250 ms, then services signals, messages, sessions and the status line.
  void run_once() {
    std::vector<pollfd> files{{signals_.get(), POLLIN, 0}};
    for (const auto& r : sessions_) files.push_back({r->live_session().over_fd(), POLLIN, 0});
    if (poll(files.data(), files.size(), kPollIntervalMs) > 0 && files[0].revents != 0) take_signal();
    const Time now = io::monotonic_now();
    print_messages();
    const auto due = control_server_->drain_due();
    if (due && !drain_began_ && now >= *due) drain("drained by an operator");
    if (drain_began_ && now - *drain_began_ > kDrainMax) exit_now("the sessions did not end within 3 s");
    feed_watchdog();
    for (const LoadEvents::Event& note : load_events_.update(shard_pool_.all())) {
      io::log_event(note.more ? io::Level::kWarn : io::Level::kInfo,
                    {.event = note.more ? "shed" : "shed_less", .text = note.text});
      if (!io::logs_json()) line_.note(note.text);
    }
    for (std::size_t i = 0; i < sessions_.size();) {
      if (!sessions_[i]->live_session().over()) {
        service_session(*sessions_[i++], now);
      } else if (!finish_session(sessions_[i])) {
        sessions_.erase(sessions_.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
    if (now - last_shown_ < std::chrono::milliseconds(line_.interval_ms()) || drain_began_) return;
    last_shown_ = now;
    show(due ? format("DRAINING, %.0f s left", std::max(0.0, std::ceil(seconds(*due - now)))) : "");
  }

  void show(const std::string& drain) {
    std::vector<SessionScreenEntry> sessions;
    for (const auto& r : sessions_)
      sessions.push_back({r->options().name, r->live_session().status(), &r->options().scene, client_options(*r)});
    const std::size_t rows = line_.rows_max();
    line_.show(screen_items(sessions, drain, rows, list_command()), rows);
  }

  void print_messages() {
    for (const MessageQueue::Line& line : messages_.take()) {
      if (line.severity == MessageQueue::Severity::kInfo) line_.note(line.text);
      if (line.severity == MessageQueue::Severity::kWarning) line_.warn(line.text);
      if (line.severity != MessageQueue::Severity::kError) continue;
      line_.clear();
      io::log(io::Level::kError, line.text);
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
    if (!io::logs_json()) line_.note(text);
    io::log_event(io::Level::kInfo, {.event = "draining", .text = text});
    control_server_->drain();
    for (const auto& r : sessions_)
      if (!r->end) r->end = EndReason::kSignal;
    shard_pool_.stop(sessions_will_resume() && options_.listen.port() != 0 ? wire::CloseReason::kServerReturns
                                                                           : wire::CloseReason::kServerStops);
  }

  /// Whether the next start of this server restores the sessions.
  [[nodiscard]] bool sessions_will_resume() const noexcept { return options_.sessions_resume && checkpoint_store_; }

  /// Ends the process without a close-out. The clients' own gates release the hands.
  [[noreturn]] void exit_now(const char* why) {
    if (checkpoint_store_ && !sessions_will_resume()) checkpoint_store_->remove_all();
    line_.clear();
    std::fprintf(stderr, "tandem-server: %s; ends at once\n", why);
    ::_exit(io::kExitTrouble);
  }

  /// Sends the systemd watchdog signal if the shard with the fewest punctual ticks has new ones.
  void feed_watchdog() {
    const std::uint64_t punctual = shard_pool_.punctual();
    if (punctual != std::exchange(punctual_, punctual)) io::systemd_notify("WATCHDOG=1");
  }

  /// Options with which a client command finds a session.
  [[nodiscard]] std::string client_options(const SessionInstance& r) const {
    return " --server " + client_address_ + (options_.sessions.size() == 1 ? "" : " --session " + r.options().name) +
           (control_server_->ephemeral_keys() ? "" : " --ticket-file FILE");
  }
  /// Command that lists all sessions of this server. With ephemeral keys the `tandem-server` commands do not know this
  /// server.
  [[nodiscard]] std::string list_command() const {
    return control_server_->ephemeral_keys()
               ? "tandem-client sessions --server " + client_address_
               : "tandem-server sessions" + auth::server_state_option(control_server_->folder());
  }
  [[nodiscard]] std::string prefix(const SessionInstance& r) const {
    return options_.sessions.size() == 1 ? "" : r.options().name + ": ";
  }

  void tell(const SessionInstance& r, const SessionStatus& status, const PresenceTracker::Event& note) {
    const auto tick = static_cast<std::uint64_t>(status.time * r.options().scene.tick_hz + 0.5);
    io::log_event(
        note.warning ? io::Level::kWarn : io::Level::kInfo,
        {.event = note.event, .session = r.options().name, .seat = note.seat, .tick = tick, .text = note.text});
    const std::string text = prefix(r) + with_options(note.text, "tandem-client control", client_options(r));
    if (io::logs_json()) return;
    if (note.warning) return line_.warn(text);
    line_.note(text);
  }

  /// Writes the session's audit events to the audit log: joins, leaves, authority changes, stops and resumes.
  void write_audit_events(SessionInstance& r) {
    AuditEventQueue& events = r.live_session().audit();
    // The session registry recorded it with the name.
    for (const AuditEvent* e = events.front(); e != nullptr; e = events.front()) {
      if (e->seat == AuditEvent::kControlPlane && e->party == AuditEvent::kNoSeat) {
        events.pop();
        continue;
      }
      control_server_->audit(to_text(e->what), r.options().name, audit_text(*e, r.options().scene));
      events.pop();
    }
  }

  void service_session(SessionInstance& r, Time now) {
    write_audit_events(r);
    const SessionStatus status = r.live_session().status();
    if (!std::exchange(realtime_reported_, true))
      if (const std::string notice = io::realtime_warning(status.machine.realtime, memory_, awake_.granted());
          !notice.empty())
        line_.note(notice);
    const PresenceTracker::Events news = r.presence.update(now, status, r.options().scene);
    for (const PresenceTracker::Event& note : news.events) tell(r, status, note);
    if (status.state == wire::SessionState::kWaiting) r.missing_seats = waiting_for(status, r.options().scene);
    if (r.end) return;
    const SessionEnding::Times when{now, began_, options_.start_timeout_s,
                                    r.snapshot() != nullptr ? std::optional{r.resume_until()} : std::nullopt};
    if (const auto ending = session_ending(when, news, status, r.options().scene)) {
      tell(r, status, ending->event);
      end(r, ending->why);
    }
  }

  void end(SessionInstance& r, EndReason why) {
    r.end = why;
    control_server_->end_session(r.id());
  }

  /// Completes a session that is over. @return true if another one replaced it
  bool finish_session(std::unique_ptr<SessionInstance>& place) {
    SessionInstance& r = *place;
    // During a drain the shards end too and complete no requests. The session then stays registered until the control
    // server stops.
    if (!drain_began_) control_server_->close_session(r.id());
    if (checkpoint_store_ && !(drain_began_ && sessions_will_resume())) checkpoint_store_->remove(r.options().name);
    write_audit_events(r);
    const auto slot = r.live_session().slot();
    std::FILE* const out = r.writes_to_stdout() ? stderr : stdout;  // read before `finish` closes the files
    const SessionInstance::Verdict verdict = r.finish();
    if (!options_.quiet && !io::logs_json()) summarize(out, verdict.report, r);
    io::log_event(verdict.report.passed ? io::Level::kInfo : io::Level::kError,
                  {.event = "session_over", .session = r.options().name, .text = r.outcome_text(verdict.report)});
    if (!verdict.problem.empty()) trouble(verdict.problem);
    if (!r.options().restart || drain_began_ || control_server_->drain_due()) {
      exit_code_ = std::max(exit_code_, verdict.code);
      if (drain_began_) finished_sessions_.push_back(std::move(place));
      return false;
    }
    auto next = open_session(r.options(), slot, r.epoch() + 1);
    if (!next) {
      exit_code_ = std::max(exit_code_, next.error());
      return false;
    }
    place = std::move(*next);
    control_server_->add_running_session(registration_of(*place));
    announce(*place);
    return true;
  }

  void summarize(std::FILE* out, const RunReport& report, SessionInstance& r) {
    line_.clear();
    std::string text = prefix(r) + report.scenario + ": " + r.outcome_text(report) +
                       (report.duration_s > 0 ? "," : ";") +
                       format(" ticks more than 1 ms late on this machine: %llu\n",
                              static_cast<unsigned long long>(r.live_session().final_status().machine.late_ticks));
    if (report.duration_s > 0) text += report_summary(report, r.options().scene);
    std::fputs(io::wrap_for_terminal(text, out).c_str(), out);
    std::fflush(out);
  }

  const ServerOptions& options_;
  io::Fd signals_;
  io::CpuLatencyRequest awake_;
  ShardPool shard_pool_;
  MessageQueue messages_;
  std::unique_ptr<ControlServer> control_server_;
  std::string client_address_;                         ///< address for printed commands, quoted for a shell
  std::unique_ptr<CheckpointStore> checkpoint_store_;  ///< null: no client could resume after a restart
  /// Sessions that are running, or over but not yet completed.
  std::vector<std::unique_ptr<SessionInstance>> sessions_;
  /// Completed, but still registered at the control server.
  std::vector<std::unique_ptr<SessionInstance>> finished_sessions_;
  io::StatusLine line_;
  LoadEvents load_events_;
  Time began_{}, last_shown_{};
  std::optional<Time> drain_began_;
  std::uint64_t punctual_ = 0;
  bool memory_ = false, realtime_reported_ = false;
  int exit_code_ = 0;
};

}  // namespace

int run_server(const ServerOptions& plan) { return ServerProcess{plan}.run(); }

}  // namespace tandem::server
