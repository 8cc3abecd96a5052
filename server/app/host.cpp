#include "server/app/host.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "common/base/format.h"
#include "common/base/printable.h"
#include "common/base/printed_command.h"
#include "common/io/clock.h"
#include "common/io/help_text.h"
#include "common/io/own_address.h"
#include "common/io/print.h"
#include "common/io/realtime.h"
#include "common/io/service_notice.h"
#include "common/io/signals.h"
#include "common/io/terminal.h"
#include "server/app/announcement.h"
#include "server/app/checkpoint_book.h"
#include "server/app/front_door.h"
#include "server/app/notices.h"
#include "server/app/relief_news.h"
#include "server/app/shards.h"
#include "server/audit_words.h"
#include "server/report_summary.h"

namespace tandem::server {
namespace {

constexpr int kTrouble = 1;  // while running
constexpr int kLookEveryMs = 250;
constexpr Duration kDrainMax = std::chrono::seconds(3);

/// On the door's thread: what somebody who runs a server wants to know of those who could not come in.
void tell_log(Notices& notices, const ControlNews& news) {
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
  const std::string who = news.address.empty() ? "" : news.address + " " + news.workstation;  // else it is about the server itself
  if (io::logs_json()) return io::tell(trouble ? io::Level::kError : io::Level::kWarn, {.event = std::string(to_text(news.event)), .text = who + (who.empty() ? "" : ": ") + news.detail});
  const std::string what = trouble ? who + (who.empty() ? "" : ": ") : who + " " + std::string(words_of(news.event)) + (news.detail.empty() ? "" : ": ");
  notices.add(trouble ? Notices::Weight::kError : Notices::Weight::kWarning, what + printable(news.detail));
}

std::vector<double> tick_rates(const HostPlan& plan) {
  std::vector<double> rates;
  for (const SessionPlan& session : plan.sessions) rates.push_back(session.scene.tick_hz);
  return rates;
}

/// On the book's thread.
void tell_trouble(Notices& notices, const std::string& what) {
  if (io::logs_json()) return io::tell(io::Level::kError, {.event = "checkpoint_trouble", .text = what});
  notices.add(Notices::Weight::kError, "checkpoint: " + what);
}

/// One server process at work.
class Host {
 public:
  explicit Host(const HostPlan& plan) : plan_(plan), signals_(io::signals_as_file()), shards_(tick_rates(plan)), line_(plan.quiet || plan.json_log.has_value()) {
    if (plan.json_log) io::log_as_json(*plan.json_log);
  }
  ~Host() {
    shards_.join();
    if (door_) door_->stop();
    io::end_log();
  }

  int run() {
    if (const int code = open(); code != 0) return code;
    for (const auto& r : runs_) announce(*r);
    std::fprintf(people(), "Ctrl-C ends the session%s gently\n", runs_.size() == 1 ? "" : "s");
    std::fflush(people());
    io::notify_service("READY=1");
    while (!runs_.empty()) look();
    tell_notices();
    if (book_) book_->stop();
    line_.clear();
    io::tell(io::Level::kInfo, {.event = "stopped"});
    return code_;
  }

 private:
  int trouble(const std::string& what) {
    spdlog::error("{}: {}", plan_.command, what);
    return kTrouble;
  }

  /// With JSON on standard output people's lines move out of the way.
  [[nodiscard]] std::FILE* people() const {
    return std::ranges::any_of(runs_, [](const auto& r) { return r->writes_to_stdout(); }) ? stderr : stdout;
  }

  int open() {
    FrontDoor::Plan door{plan_.listen, plan_.state, [this](const ControlNews& news) { tell_log(notices_, news); }};
    door.say = [this](const std::string& line) {
      if (!io::logs_json()) notices_.add(Notices::Weight::kNote, line);
    };
    door.limits = plan_.limits;
    door.load = plan_.load;
    door.steering = shards_.steering();
    door.metrics = plan_.metrics;
    door.metrics_hosts = plan_.metrics_hosts;
    door.audit = plan_.audit;
    auto opened = FrontDoor::open(door);
    if (!opened) return trouble(opened.error());
    door_ = std::move(*opened);
    dialled_ = shell_word(io::dialable(door_->address()));
    if (const std::string problem = open_book(); !problem.empty()) return trouble(problem);
    for (std::size_t slot = 0; slot < plan_.sessions.size(); ++slot) {
      const SessionPlan& session = plan_.sessions[slot];
      const CheckpointBook::Found left = book_ ? book_->find(session.name, session.scene, trust::wall_seconds(), !plan_.fresh) : CheckpointBook::Found{};
      auto made = make(session, slot, 1, left.kept ? &*left.kept : nullptr);
      if (!made) return made.error();
      runs_.push_back(std::move(*made));
      tell_what_was_left(*runs_.back(), left);
    }
    if (book_) book_->start();
    memory_ = io::lock_memory();
    shards_.take(door_->take_sockets());
    for (const auto& r : runs_) {
      shards_.of_slot(r->hosted().slot()).host(r->hosted());
      door_->add(opening_of(*r));
    }
    for (const auto& shard : shards_.all()) door_->watch(*shard);
    if (const auto problem = door_->start(); !problem.empty()) return trouble(problem);
    shards_.run();
    began_ = io::monotonic_now();
    std::fprintf(people(), "listening on %s\n", io::to_text(door_->address()).c_str());  // scripts wait for this line
    if (const auto at = door_->metrics_address()) std::fprintf(people(), "metrics on http://%s/metrics\n", io::to_text(*at).c_str());
    return 0;
  }

  /// With keys made on the spot a port that was chosen for us will be another one next time: nobody could come back.
  std::string open_book() {
    if (door_->throw_away() && plan_.listen.port() == 0) return {};
    auto opened = CheckpointBook::open(door_->folder(), door_->throw_away() ? io::to_text(plan_.listen) + "-" : "", [this](const std::string& what) { tell_trouble(notices_, what); });
    if (!opened) return opened.error();
    book_ = std::move(*opened);
    return {};
  }

  void tell_what_was_left(const SessionRun& r, const CheckpointBook::Found& left) {
    const std::string& name = r.plan().name;
    if (!left.unfit.empty()) {
      const std::string text = "session " + name + " starts from the beginning: its checkpoint is not used: " + left.unfit;
      if (!io::logs_json()) line_.warn(text);
      io::tell(io::Level::kWarn, {.event = "checkpoint_unfit", .session = name, .text = text});
    }
    if (!left.kept) return;
    const Checkpoint& from = left.kept->checkpoint;
    std::string text = format("session %s GOES ON where its server ended %lld s ago: at %.1f s, epoch %llu", name.c_str(),
                              static_cast<long long>(std::max<std::int64_t>(0, trust::wall_seconds() - left.kept->written_s)), from.session_tick / r.plan().scene.tick_hz,
                              static_cast<unsigned long long>(r.epoch()));
    if (from.begun) text += "; it waits until the instructors and all who led are back, or an instructor (key r) or operator (`tandem-client control" + reach(r) + " resume`) goes on without";
    if (from.stop != StopLane::Level::kNone) text += "; somebody had stopped it, and it stays so until an instructor or operator resumes";
    if (!io::logs_json()) line_.note(text + (plan_.returns ? "" : "; --fresh starts it from the beginning"));
    io::tell(io::Level::kInfo, {.event = "session_restored", .session = name, .tick = from.session_tick, .text = text});
  }

  std::expected<std::unique_ptr<SessionRun>, int> make(const SessionPlan& plan, std::size_t slot, std::uint64_t epoch, const KeptSession* kept = nullptr) {
    auto made = SessionRun::open(plan, static_cast<std::uint8_t>(slot), epoch, !door_->throw_away() && !plan.tickets_only, kept);
    if (made && book_) (*made)->hosted().keep_in(book_->begin({{}, (*made)->id(), plan.name, (*made)->code(), 0, kept != nullptr ? kept->sent_away : decltype(kept->sent_away){}}), (*made)->epoch());
    if (made) return std::move(*made);
    for (const std::string& text : made.error().texts) trouble(text);
    return std::unexpected(made.error().code);
  }

  House::Opening opening_of(SessionRun& r) {
    House::Opening o{r.plan().name, r.id(), r.code(), r.epoch(), &r.hosted(), &shards_.of_slot(r.hosted().slot()), r.kept(), {}, r.kept() != nullptr ? r.back_until() : Time{}};
    if (book_) o.sent_away = [book = book_.get(), name = r.plan().name](const auto& keys) { book->send_away(name, keys); };
    return o;
  }

  void announce(const SessionRun& r) {
    // A journal, a file or a pipe keeps what it is given, and is read by others: codes are shown on terminals only.
    const std::string folder = door_->throw_away() ? "" : door_->folder();
    const std::string read_code = ::isatty(::fileno(people())) == 1 ? "" : list_command();
    std::fputs(io::for_terminal(announcement(r, door_->address(), door_->throw_away(), plan_.sessions.size() > 1, folder, read_code), people()).c_str(), people());
    std::fflush(people());
    io::tell(io::Level::kInfo, {.event = "session_opened", .session = r.plan().name, .text = r.plan().scene.name});
  }

  /// Waits a little, then sees to everything.
  void look() {
    std::vector<pollfd> files{{signals_.get(), POLLIN, 0}};
    for (const auto& r : runs_) files.push_back({r->hosted().over_fd(), POLLIN, 0});
    if (poll(files.data(), files.size(), kLookEveryMs) > 0 && files[0].revents != 0) take_signal();
    const Time now = io::monotonic_now();
    tell_notices();
    const auto due = door_->drain_due();
    if (due && !drain_began_ && now >= *due) drain("drained by an operator");
    if (drain_began_ && now - *drain_began_ > kDrainMax) leave_at_once("the sessions did not end within 3 s");
    feed_watchdog();
    for (const ReliefNews::Note& note : relief_.look(shards_.all())) {
      io::tell(note.more ? io::Level::kWarn : io::Level::kInfo, {.event = note.more ? "shed" : "shed_less", .text = note.text});
      if (!io::logs_json()) line_.note(note.text);
    }
    for (std::size_t i = 0; i < runs_.size();) {
      if (!runs_[i]->hosted().over()) {
        attend(*runs_[i++], now);
      } else if (!follow_up(runs_[i])) {
        runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
    if (now - shown_ < std::chrono::milliseconds(line_.interval_ms()) || drain_began_) return;
    shown_ = now;
    show(due ? format("DRAINING, %.0f s left", std::max(0.0, std::ceil(seconds(*due - now)))) : "");
  }

  void show(const std::string& drain) {
    std::vector<SessionOnScreen> sessions;
    for (const auto& r : runs_) sessions.push_back({r->plan().name, r->hosted().status(), &r->plan().scene, reach(*r)});
    const std::size_t rows = line_.rows_max();
    line_.show(screen_items(sessions, drain, rows, list_command()), rows);
  }

  void tell_notices() {
    for (const Notices::Line& line : notices_.take()) {
      if (line.weight == Notices::Weight::kNote) line_.note(line.text);
      if (line.weight == Notices::Weight::kWarning) line_.warn(line.text);
      if (line.weight != Notices::Weight::kError) continue;
      line_.clear();
      spdlog::error(line.text);
    }
  }

  void take_signal() {
    const std::string_view by = io::signal_that_came();
    signalfd_siginfo taken;
    [[maybe_unused]] const auto got = ::read(signals_.get(), &taken, sizeof taken);
    if (drain_began_) leave_at_once("a second signal came");
    drain("ended by " + std::string(by.empty() ? "Ctrl-C" : by));
  }

  void drain(const std::string& why) {
    drain_began_ = io::monotonic_now();
    io::notify_service("STOPPING=1");
    const std::string text = why + ": all hands are let go gently";
    if (!io::logs_json()) line_.note(text);
    io::tell(io::Level::kInfo, {.event = "draining", .text = text});
    door_->drain();
    for (const auto& r : runs_)
      if (!r->end) r->end = End::kSignal;
    shards_.stop(comes_back() && plan_.listen.port() != 0 ? wire::CloseReason::kServerReturns : wire::CloseReason::kServerStops);
  }

  /// Whether the sessions are there again when this server is started again.
  [[nodiscard]] bool comes_back() const noexcept { return plan_.returns && book_; }

  /// Hands are safe without us: their own gates see to that.
  [[noreturn]] void leave_at_once(const char* why) {
    if (book_ && !comes_back()) book_->drop_all();
    line_.clear();
    std::fprintf(stderr, "tandem-server: %s; ends at once\n", why);
    ::_exit(kTrouble);
  }

  /// systemd's watchdog lives on ticks that met their deadline, in every shard.
  void feed_watchdog() {
    const std::uint64_t punctual = shards_.punctual();
    if (punctual != std::exchange(punctual_, punctual)) io::notify_service("WATCHDOG=1");
  }

  /// What a command for a session needs to find it.
  [[nodiscard]] std::string reach(const SessionRun& r) const {
    return " --server " + dialled_ + (plan_.sessions.size() == 1 ? "" : " --session " + r.plan().name) + (door_->throw_away() ? "" : " --ticket-file FILE");
  }
  /// The command that lists all sessions here: with keys made on the spot the `tandem-server` commands know nothing of this server.
  [[nodiscard]] std::string list_command() const {
    return door_->throw_away() ? "tandem-client sessions --server " + dialled_ : "tandem-server sessions" + trust::server_state_option(door_->folder());
  }
  [[nodiscard]] std::string prefix(const SessionRun& r) const { return plan_.sessions.size() == 1 ? "" : r.plan().name + ": "; }

  void tell(const SessionRun& r, const SessionStatus& status, const Attendance::Note& note) {
    const auto tick = static_cast<std::uint64_t>(status.time * r.plan().scene.tick_hz + 0.5);
    io::tell(note.warning ? io::Level::kWarn : io::Level::kInfo, {.event = note.event, .session = r.plan().name, .seat = note.seat, .tick = tick, .text = note.text});
    const std::string text = prefix(r) + with_options(note.text, "tandem-client control", reach(r));
    if (io::logs_json()) return;
    if (note.warning) return line_.warn(text);
    line_.note(text);
  }

  /// Who came, went, moved authority, stopped and resumed: into the audit log.
  void write_down(SessionRun& r) {
    AuditEvents& events = r.hosted().audit();
    for (const AuditEvent* e = events.front(); e != nullptr; e = events.front()) {
      if (e->seat == AuditEvent::kControlPlane && e->party == AuditEvent::kNoSeat) {  // the house wrote it down, with the name
        events.pop();
        continue;
      }
      door_->audit(to_text(e->what), r.plan().name, audit_words(*e, r.plan().scene));
      events.pop();
    }
  }

  void attend(SessionRun& r, Time now) {
    write_down(r);
    const SessionStatus status = r.hosted().status();
    if (!std::exchange(told_, true))
      if (const std::string notice = io::realtime_notice(status.machine.realtime, memory_, awake_.granted()); !notice.empty()) line_.note(notice);
    const Attendance::News news = r.attendance.look(now, status, r.plan().scene);
    for (const Attendance::Note& note : news.notes) tell(r, status, note);
    if (status.state == wire::SessionState::kWaiting) r.waited_for = waiting_for(status, r.plan().scene);
    if (r.end) return;
    const SessionEnding::When when{now, began_, plan_.wait_s, r.kept() != nullptr ? std::optional{r.back_until()} : std::nullopt};
    if (const auto ending = session_ending(when, news, status, r.plan().scene)) {
      tell(r, status, ending->note);
      end(r, ending->why);
    }
  }

  void end(SessionRun& r, End why) {
    r.end = why;
    door_->end(r.id());
  }

  /// A session is over. @return whether another one took its place
  bool follow_up(std::unique_ptr<SessionRun>& place) {
    SessionRun& r = *place;
    // While it drains, the shards end too and answer no more: then the door keeps what it knows of until it stops.
    if (!drain_began_) door_->close(r.id());
    if (book_ && !(drain_began_ && comes_back())) book_->end(r.plan().name);
    write_down(r);
    const auto slot = r.hosted().slot();
    std::FILE* const out = r.writes_to_stdout() ? stderr : stdout;  // asked before the run closes its files
    const SessionRun::Verdict verdict = r.finish();
    if (!plan_.quiet && !io::logs_json()) summarize(out, verdict.report, r);
    io::tell(verdict.report.passed ? io::Level::kInfo : io::Level::kError,
             {.event = "session_over", .session = r.plan().name, .text = r.how_it_went(verdict.report)});
    if (!verdict.problem.empty()) trouble(verdict.problem);
    if (!r.plan().restart || drain_began_ || door_->drain_due()) {
      code_ = std::max(code_, verdict.code);
      if (drain_began_) finished_.push_back(std::move(place));
      return false;
    }
    auto next = make(r.plan(), slot, r.epoch() + 1);
    if (!next) {
      code_ = std::max(code_, next.error());
      return false;
    }
    place = std::move(*next);
    door_->open_late(opening_of(*place));
    announce(*place);
    return true;
  }

  void summarize(std::FILE* out, const RunReport& report, SessionRun& r) {
    line_.clear();
    std::string text = prefix(r) + report.scenario + ": " + r.how_it_went(report) + (report.duration_s > 0 ? "," : ";") +
                       format(" ticks more than 1 ms late on this machine: %llu\n", static_cast<unsigned long long>(r.hosted().final_status().machine.late_ticks));
    if (report.duration_s > 0) text += report_summary(report, r.plan().scene);
    std::fputs(io::for_terminal(text, out).c_str(), out);
    std::fflush(out);
  }

  const HostPlan& plan_;
  io::Fd signals_;
  io::AwakeProcessor awake_;
  Shards shards_;
  Notices notices_;
  std::unique_ptr<FrontDoor> door_;
  std::string dialled_;  ///< where printed commands reach it, as a word for a shell
  std::unique_ptr<CheckpointBook> book_;  ///< null: nobody could come back anyway
  std::vector<std::unique_ptr<SessionRun>> runs_;  ///< those that are not over, or being followed up
  std::vector<std::unique_ptr<SessionRun>> finished_;  ///< that the door still knows of
  io::StatusLine line_;
  ReliefNews relief_;
  Time began_{}, shown_{};
  std::optional<Time> drain_began_;
  std::uint64_t punctual_ = 0;
  bool memory_ = false, told_ = false;
  int code_ = 0;
};

}  // namespace

int host(const HostPlan& plan) { return Host{plan}.run(); }

}  // namespace tandem::server
