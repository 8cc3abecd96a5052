#include "server/app/process/session_table.h"

#include <algorithm>
#include <future>
#include <utility>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/exit_code.h"
#include "server/app/control/note_log.h"
#include "server/app/monitor/startup_banner.h"
#include "server/recording/lesson_notes.h"
#include "server/report/audit_text.h"
#include "server/report/report_summary.h"

namespace tandem::server {

SessionTable::SessionTable(const ServerOptions& options, ShardPool& shards, ControlServer& control,
                           CheckpointStore* checkpoints, ServerOutput& output)
    : options_(options),
      shards_(shards),
      control_(control),
      checkpoints_(checkpoints),
      output_(output),
      hints_(control.address(), control.folder(), control.ephemeral_keys(), options.sessions.size() > 1) {}

int SessionTable::open() {
  if (options_.service) return 0;  // its sessions come with `open_owned`
  for (std::size_t slot = 0; slot < options_.sessions.size(); ++slot) {
    const SessionOptions& session = options_.sessions[slot];
    CheckpointStore::Found found;
    if (checkpoints_ != nullptr)
      found = checkpoints_->find(session.name, session.scene, auth::wall_seconds(), !options_.no_restore);
    auto made = open_session(session, slot, 1, found.snapshot ? &*found.snapshot : nullptr);
    if (!made) return made.error();
    sessions_.push_back(std::move(*made));
    report_restored(*sessions_.back(), found,
                    found.snapshot ? std::optional(auth::wall_seconds() - found.snapshot->written_s) : std::nullopt);
  }
  return 0;
}

void SessionTable::begin() {
  began_ = io::monotonic_now();
  for (const auto& s : sessions_) {
    start_recording(*s);
    shards_.of_slot(s->live_session().slot()).add_session(s->live_session());
    control_.registry().add(registration_of(*s));
  }
}

std::expected<std::unique_ptr<SessionInstance>, int> SessionTable::open_session(const SessionOptions& options,
                                                                                std::size_t slot, std::uint64_t epoch,
                                                                                const SessionSnapshot* snapshot) {
  auto made = SessionInstance::open(options,
                                    {.slot = static_cast<std::uint8_t>(slot),
                                     .epoch = epoch,
                                     .with_code = !control_.ephemeral_keys() && !options.tickets_only,
                                     .kept = snapshot},
                                    inputs_);
  if (!made) {
    for (const std::string& text : made.error().texts) output_.error(text);
    return std::unexpected(made.error().code);
  }
  (*made)->set_keeper(checkpoints_);
  return std::move(*made);
}

void SessionTable::report_restored(const SessionInstance& session, const CheckpointStore::Found& found,
                                   std::optional<std::int64_t> age_s) {
  const std::string& name = session.options().name;
  if (!found.incompatibility.empty()) {
    const std::string text =
        "session " + name + " starts from the beginning: its checkpoint is not used: " + found.incompatibility;
    output_.report(io::Level::kWarn, {.event = "checkpoint_unfit", .session = name, .text = text}, text);
  }
  if (!found.snapshot) return;
  const Checkpoint& from = found.snapshot->checkpoint;
  std::string text =
      format("session %s RESTORED from its checkpoint%s: at %.1f s, epoch %llu", name.c_str(),
             age_s ? format(", %lld s old", static_cast<long long>(std::max<std::int64_t>(0, *age_s))).c_str() : "",
             from.session_tick / session.options().scene.tick_hz, static_cast<unsigned long long>(session.epoch()));
  if (from.begun)
    text +=
        "; it waits until the instructors and all seats with authority are back, or an instructor (key r) or "
        "operator (`tandem-client control" +
        hints_.client_options(name) + " resume`) resumes without them";
  if (from.stop != StopLatch::Level::kNone)
    text += "; it was stopped, and stays stopped until an instructor or operator resumes it";
  output_.report(io::Level::kInfo,
                 {.event = "session_restored", .session = name, .tick = from.session_tick, .text = text},
                 text + (options_.sessions_resume ? "" : "; --no-restore starts it from the beginning"));
}

SessionRegistration SessionTable::registration_of(SessionInstance& session) {
  SessionRegistration made{session.options().name,
                           session.id(),
                           session.code(),
                           session.epoch(),
                           &session.live_session(),
                           &shards_.of_slot(session.live_session().slot()),
                           session.snapshot(),
                           {},
                           session.snapshot() != nullptr ? session.resume_until() : Time{}};
  made.recording = session.recording_desk();
  made.no_recording = no_recording(session);
  made.consoles = session.consoles();
  if (SnapshotKeeper* const keeper = session.keeper(); keeper != nullptr) {
    made.stored = session.stored();
    made.on_removed = [keeper, name = session.options().name](const auto& keys) { keeper->set_removed(name, keys); };
    made.on_persons = [keeper, name = session.options().name](const auto& persons) {
      keeper->set_persons(name, persons);
    };
    made.on_consoles = [keeper, name = session.options().name](const auto& tickets) {
      keeper->set_consoles(name, tickets);
    };
  }
  if (session.snapshot() != nullptr)
    made.notes = NoteLog(control_.notes_folder()).load(session.options().name, session.id());
  return made;
}

void SessionTable::announce_all() {
  for (const auto& session : sessions_) announce(*session);
  for (const auto& session : sessions_) report_recordings(*session);
}

void SessionTable::announce(const SessionInstance& session) const {
  // Others may read what is stored, so codes are shown on terminals only.
  output_.print(startup_banner(session, control_.address(), control_.ephemeral_keys(), hints_.several(),
                               control_.ephemeral_keys() ? "" : control_.folder(),
                               output_.may_be_stored() ? hints_.list_command() : ""));
  io::log_event(io::Level::kInfo,
                {.event = "session_opened", .session = session.options().name, .text = session.options().scene.name});
}

std::string SessionTable::recording_words(const SessionInstance& session) {
  const auto recording = session.recording_desk()->status();
  if (!recording) return {};
  std::string text = recording->trouble.empty() ? "RECORDED" : "RECORDED WITH GAPS: " + recording->trouble;
  if (const auto dropped = static_cast<unsigned long long>(recording->dropped); dropped > 0)
    text += format(", dropped %llu %s", dropped, dropped == 1 ? "tick" : "ticks");
  return text;
}

std::vector<SessionScreenEntry> SessionTable::screen_entries() const {
  std::vector<SessionScreenEntry> entries;
  for (const auto& s : sessions_)
    entries.push_back({s->options().name, s->live_session().status(), &s->options().scene,
                       hints_.client_options(s->options().name), recording_words(*s)});
  return entries;
}

void SessionTable::service(Time now) {
  for (std::size_t i = 0; i < sessions_.size();) {
    if (!sessions_[i]->live_session().over()) {
      service_session(*sessions_[i++], now);
    } else if (!finish(sessions_[i])) {
      sessions_.erase(sessions_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

void SessionTable::service_session(SessionInstance& session, Time now) {
  write_audit_events(session);
  const SessionStatus status = session.live_session().status();
  const SceneSpec& scene = session.options().scene;
  const PresenceTracker::Events news = session.presence.update(now, status, scene);
  for (const PresenceTracker::Event& event : news.events) report(session, status, event);
  if (status.state == wire::SessionState::kWaiting) session.missing_seats = waiting_for(status, scene);
  if (session.end) return;
  const SessionEnding::Times when{now, began_, options_.start_timeout_s, session.return_until(), session.ends_at()};
  if (const auto ending = session_ending(when, news, status, scene)) {
    report(session, status, ending->event);
    session.end = ending->why;
    control_.change([&](SessionRegistry& registry, const auto& done) {
      registry.end(session.id());
      done();
    });
  }
}

void SessionTable::report(const SessionInstance& session, const SessionStatus& status,
                          const PresenceTracker::Event& event) {
  const std::string& name = session.options().name;
  const auto tick = static_cast<std::uint64_t>(status.time * session.options().scene.tick_hz + 0.5);
  output_.report(event.warning ? io::Level::kWarn : io::Level::kInfo,
                 {.event = event.event, .session = name, .seat = event.seat, .tick = tick, .text = event.text},
                 hints_.prefix(name) + with_options(event.text, "tandem-client control", hints_.client_options(name)));
}

/// Joins, leaves, authority changes, stops and resumes. Commands of consoles are logged with names by SessionCommands.
/// The control thread adds the name of the person who had the seat at that time.
void SessionTable::write_audit_events(SessionInstance& session) {
  while (const auto e = session.live_session().audit().take()) {
    if (const auto first = session.live_session().first_tick())
      session.recording_desk()->add_event(lesson_event(*e, session.options().scene, e->at - *first), e->order);
    if (e->seat == AuditEvent::kControlPlane && e->party == AuditEvent::kNoSeat) continue;
    const auto author = [&registry = control_.registry(), id = session.id(), seat = e->seat, at = e->at] {
      const SessionEntry* const entry = std::as_const(registry).find(id);
      return entry != nullptr && seat < entry->seats.size() ? entry->seats[seat].person_at(at) : std::string{};
    };
    control_.audit().post(to_text(e->what), session.options().name, audit_text(*e, session.options().scene), author);
  }
}

void SessionTable::drain() {
  draining_ = true;
  for (const auto& s : sessions_) {
    if (s->end || (s->on_over() && s->live_session().ends())) continue;  // it is over by itself, in its service too
    s->end = s->on_over() ? EndReason::kGivenUp : EndReason::kSignal;
  }
  // A created session does not return with the server, so its clients are closed before those of the shards. A session
  // of a service goes on at another server.
  control_.change([this](SessionRegistry& registry, const auto& done) {
    for (const auto& s : sessions_)
      if (s->created())
        registry.end(s->id(), s->on_over() ? wire::CloseReason::kServerReturns : wire::CloseReason::kServerStops);
    done();
  });
}

bool SessionTable::finish(std::unique_ptr<SessionInstance>& place) {
  SessionInstance& session = *place;
  const std::string& name = session.options().name;
  const auth::Id16 id = session.id();
  write_audit_events(session);  // before the names of its persons are gone
  // During a drain the shards end too and complete no requests. The session then stays registered until the control
  // server stops.
  if (!draining_)
    control_.change([&](SessionRegistry& registry, const auto& done) { registry.remove(session.id(), done); });
  const bool kept = session.on_over() ? session.end == EndReason::kGivenUp : draining_ && will_resume();
  if (session.keeper() != nullptr && !kept) session.keeper()->remove(name);
  const auto slot = session.live_session().slot();
  const SessionInstance::Verdict verdict = session.finish();
  session.end_recording();
  if (!options_.quiet && !io::logs_json()) summarize(verdict.report, session);
  io::log_event(verdict.report.passed ? io::Level::kInfo : io::Level::kError,
                {.event = "session_over", .session = name, .text = session.outcome_text(verdict.report)});
  if (!verdict.problem.empty()) output_.error(verdict.problem);
  if (session.on_over()) session.on_over()(kept);
  for (const SessionOrder& order : take_endings(id))
    reply(order, session.end == EndReason::kGivenUp ? rpc::Body(goes_on_elsewhere(session)) : rpc::Ok{});
  if (session.on_over() || !session.options().restart || draining_ || control_.registry().drain().due()) {
    if (!session.created()) exit_code_ = std::max(exit_code_, verdict.code);
    if (draining_) {
      finished_.push_back(std::move(place));
    } else if (session.recordings_busy()) {
      closing_.push_back(std::move(place));
    }
    return false;
  }
  auto next = open_session(session.options(), slot, session.epoch() + 1);
  if (session.recordings_busy()) closing_.push_back(std::move(place));
  if (!next) {
    exit_code_ = std::max(exit_code_, next.error());
    return false;
  }
  place = std::move(*next);
  bool served = false;
  control_.change([&](SessionRegistry& registry, const auto& done) {
    registry.add_running(registration_of(*place), [&served, done](bool accepted) {
      served = accepted;
      done();
    });
  });
  if (!served) {
    output_.error("session " + name + " cannot start again: its thread takes no sessions; restart the server");
    control_.change([&](SessionRegistry& registry, const auto& done) { registry.remove(place->id(), done); });
    exit_code_ = std::max(exit_code_, io::kExitTrouble);
    return false;
  }
  announce(*place);
  start_recording(*place);
  return true;
}

void SessionTable::summarize(const RunReport& report, SessionInstance& session) {
  const bool began = report.duration_s > 0;
  std::string text = hints_.prefix(session.options().name) + report.scenario + ": " + session.outcome_text(report) +
                     (began ? "," : ";") +
                     format(" ticks more than 1 ms late on this machine: %llu\n",
                            static_cast<unsigned long long>(session.live_session().final_status().machine.late_ticks));
  if (began) text += report_summary(report, session.options().scene);
  output_.clear();
  output_.print(text);
}

}  // namespace tandem::server
