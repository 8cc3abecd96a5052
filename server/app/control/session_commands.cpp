#include "server/app/control/session_commands.h"

#include <algorithm>
#include <utility>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "server/app/control/audit_writer.h"
#include "server/app/control/command_text.h"
#include "server/app/control/join_replies.h"
#include "server/app/control/note_check.h"
#include "server/app/control/session_notes.h"
#include "server/app/monitor/session_status.h"
#include "server/policy/roles.h"
#include "server/session/connection_id.h"
#include "server/session/stop_text.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;
using Result = CommandOutcome::Result;

/// Session that a command addresses; null if it names none.
const rpc::Id* session_of(const rpc::Body& command) {
  return std::visit(
      [](const auto& message) -> const rpc::Id* {
        if constexpr (requires { message.session_id; }) return &message.session_id;
        return nullptr;
      },
      command);
}

/// The recording of the session by the server, and by connected recorders.
std::optional<rpc::StatusRecording> recording_of(const SessionEntry& entry) {
  auto recording = entry.registration.recording ? entry.registration.recording->status() : std::nullopt;
  const auto recorders = std::ranges::count_if(
      entry.watchers.slots(), [](const WatcherSlots::Slot& slot) { return slot.owner && slot.recorder; });
  if (recorders == 0) return recording;
  if (!recording) recording.emplace();
  recording->by_recorders = static_cast<std::uint32_t>(recorders);
  return recording;
}

std::uint8_t seat_of(const rpc::Welcome& joined) noexcept {
  return joined.seat.empty() ? AuditEvent::kNoSeat : static_cast<std::uint8_t>(place_of(joined.server_cid) - 1);
}

}  // namespace

SessionCommands::SessionCommands(SessionRegistry& registry, auth::ServerKeystore& audit,
                                 std::function<void(const std::string&)> on_message, std::function<Time()> clock)
    : registry_(registry),
      audit_(audit),
      on_message_(std::move(on_message)),
      held_(registry.requests().context(), std::move(clock)) {}

void SessionCommands::execute(const rpc::Welcome& joined, const WorkstationRow& workstation, rpc::Body command,
                              std::function<void(rpc::Body)> answer) {
  const std::string who = (joined.person.empty() ? "" : joined.person + " at ") + workstation.name + " (" +
                          std::string(to_text(joined.role)) + (joined.seat.empty() ? "" : ", seat " + joined.seat) +
                          ")";
  if (const auto* request = std::get_if<rpc::Drain>(&command)) {
    drain(request->grace_s, who);
    return answer(rpc::Ok{});
  }
  if (std::holds_alternative<rpc::CreateSession>(command) || std::holds_alternative<rpc::EndSession>(command) ||
      std::holds_alternative<rpc::SceneListRequest>(command))
    return order(std::move(command), who, answer);
  const rpc::Id* const id = session_of(command);
  if (std::holds_alternative<rpc::RecordSession>(command) && *id == joined.session_id)
    return order(std::move(command), who, answer);
  if (id == nullptr || *id != joined.session_id)
    return answer(
        ErrorReply{ErrorCode::kNotAllowed,
                   "this connection joined the session " + joined.session_name + " and cannot act for another one", 0});
  SessionEntry* const entry = registry_.find(*id);
  const ErrorReply over{ErrorCode::kSessionOver, "this session is over", 0};
  if (entry == nullptr) return answer(over);
  if (const auto* const list = std::get_if<rpc::NotesRequest>(&command))
    return answer(entry->notes.list(SessionNotes::author_of(joined, audit_.on_disk()), list->after));
  if (const auto* const note = std::get_if<rpc::Note>(&command))
    if (std::string problem = note_problem(note->json); !problem.empty())
      return answer(ErrorReply{ErrorCode::kBadFrame, std::move(problem), 0});
  if (const auto* const remove = std::get_if<rpc::RemoveParticipant>(&command))
    if (const auto seat = entry->session().seat_catalogue().seat_named(remove->seat)) entry->seats[*seat].void_join();
  ShardRequest request{.what = ShardRequest::What::kCommand};
  request.command = {.body = std::move(command),
                     .role = joined.role,
                     .seat = seat_of(joined),
                     .cid = joined.server_cid,
                     .workstation = workstation.name,
                     .person = joined.person};
  if (entry->registration.recording && !std::holds_alternative<rpc::StatusRequest>(request.command.body))
    request.command.order =
        entry->registration.recording->add_order(joined.person.empty() ? workstation.name : joined.person);
  request.done = [this, entry, joined, who, over, name = workstation.name,
                  answer = std::move(answer)](ShardRequest& executed) {
    if (executed.result == JoinResult::kBusy) return answer(shard_busy());
    if (executed.result == JoinResult::kSessionOver) return answer(over);
    reply(*entry, executed, conclude(*entry, joined, name, who, executed), answer);
  };
  registry_.post(*entry, std::move(request));
}

void SessionCommands::reply(const SessionEntry& entry, const ShardRequest& executed, rpc::Body body,
                            const std::function<void(rpc::Body)>& answer) {
  const rpc::Body& command = executed.command.body;
  const bool resumes = std::holds_alternative<rpc::ResumeSession>(command);
  const bool stored = resumes || std::holds_alternative<rpc::StopSession>(command) ||
                      std::holds_alternative<rpc::PauseSession>(command);
  if (!stored || !entry.registration.stored || !std::holds_alternative<rpc::Ok>(body)) return answer(std::move(body));
  held_.hold(entry.registration.stored, executed.outcome.orders, resumes ? kResumeStoredWait : kStoredWait,
             [answer, command](const std::string& why) {
               answer(rpc::Ok{why.empty() ? std::string{} : not_stored_text(command, why)});
             });
}

rpc::Body SessionCommands::conclude(SessionEntry& entry, const rpc::Welcome& joined, const std::string& workstation,
                                    const std::string& who, const ShardRequest& executed) {
  const rpc::Body& command = executed.command.body;
  const CommandOutcome& outcome = executed.outcome;
  const std::string why = why_in(command);
  const bool done = outcome.result == Result::kDone;
  if (const auto* resume = std::get_if<rpc::ResumeSession>(&command); done && resume != nullptr)
    entry.notices.set_resume(resume->stop, who);
  if (entry.registration.stored) entry.notices.set_storage_problem(entry.registration.stored->problem());
  const std::uint8_t ended_by = outcome.stop_latch.ended().by;
  entry.notices.update(outcome.stop_latch, entry.scene(),
                       ended_by < entry.seats.size() ? entry.seats[ended_by].person() : std::string{});
  if (const auto* remove = std::get_if<rpc::RemoveParticipant>(&command); done && remove != nullptr) {
    const std::string by = who + (why.empty() ? "" : ": " + why);
    entry.notices.add(remove->seat + " is REMOVED by " + who + ", the hand is released within 0.2 s" +
                      (why.empty() ? "" : ": " + why));
    if (const auto owner = entry.seats[outcome.target_seat].remove_owner("removed by " + by))
      entry.removed.add(owner->spki);
  }
  if (const auto* note = std::get_if<rpc::Note>(&command); done && note != nullptr)
    if (auto refused = store(entry, joined, workstation, *note, outcome)) return std::move(*refused);
  if (std::holds_alternative<rpc::StatusRequest>(command) && done) return status_of(entry, joined, outcome);
  if (!std::holds_alternative<rpc::StatusRequest>(command)) record(entry, who, executed.command, outcome);
  rpc::Body reply = command_reply(command, joined.role, outcome, entry.session().seat_catalogue());
  if (outcome.result == Result::kSeatLost) {
    const std::string lost = entry.seats[seat_of(joined)].lost_reason(joined.server_cid);
    ErrorReply& error = std::get<ErrorReply>(reply);
    if (!lost.empty()) error.text = truncate_utf8(error.text + " (" + lost + ")", rpc::kTextMax);
  }
  return reply;
}

std::optional<ErrorReply> SessionCommands::store(SessionEntry& entry, const rpc::Welcome& joined,
                                                 const std::string& workstation, const rpc::Note& note,
                                                 const CommandOutcome& outcome) {
  const SessionNote stored{joined.session_id, joined.session_name,
                           workstation,       joined.seat,
                           joined.person,     SessionNotes::author_of(joined, audit_.on_disk()),
                           joined.role,       outcome.tick,
                           outcome.time,      note.kind,
                           note.json};
  AuthoredNote kept = authored(stored);
  if (std::string problem = entry.notes.problem(kept); !problem.empty())
    return ErrorReply{ErrorCode::kNotAllowed, std::move(problem), 0};
  if (const std::string problem = on_note_ ? on_note_(stored) : std::string{}; !problem.empty()) {
    report_failure(joined.session_name, problem);
    return ErrorReply{ErrorCode::kInternal, "the server cannot store the note; its log has the cause", 0};
  }
  entry.notes.add(std::move(kept));
  if (entry.registration.recording) entry.registration.recording->add_note(stored);
  return std::nullopt;
}

void SessionCommands::report_failure(const std::string& session, const std::string& problem) {
  if (on_message_) on_message_((session.empty() ? "" : session + ": ") + problem);  // log_event is for JSON logs only
  io::log_event(io::Level::kError, {.event = "error", .session = session, .text = problem});
}

void SessionCommands::record(SessionEntry& entry, const std::string& who, const SessionCommand& command,
                             const CommandOutcome& outcome) {
  const bool forbidden = is_forbidden(outcome);
  if (forbidden ? !entry.forbidden_events.take(io::monotonic_now()) : outcome.result != Result::kDone) return;
  const std::string& session = entry.registration.name;
  const std::string detail = audit_detail(who, command, outcome, entry.scene());
  const char* const event = forbidden ? "forbidden" : audit_word(command.body);
  io::log_event(forbidden ? io::Level::kWarn : io::Level::kInfo,
                {.event = event, .session = session, .tick = outcome.tick, .text = detail});
  audit_.audit(auth::wall_seconds(), event, session, detail);
  const std::string message = operator_message(who, command.body);
  if (!on_message_ || forbidden || message.empty()) return;
  on_message_(registry_.entries().size() == 1 ? message : session + ": " + message);
}

rpc::Status SessionCommands::status_of(const SessionEntry& entry, const rpc::Welcome& joined,
                                       const CommandOutcome& outcome) const {
  const SceneSpec& scene = entry.scene();
  const DrainSchedule& drain = registry_.drain();
  static_assert(static_cast<std::uint32_t>(ShedLevel::kNewJoins) == rpc::kShedMax);
  rpc::Status status{.session_id = joined.session_id,
                     .name = joined.session_name,
                     .phase = phase_of(outcome.state, outcome.may_act),
                     .stops = outcome.stops,
                     .authority_version = outcome.authority_version,
                     .time_s = outcome.time,
                     .draining = drain.active(),
                     .shed = static_cast<std::uint32_t>(outcome.shed_level),
                     .seats = {},
                     .tools = {},
                     .stop = latest_stop(outcome.stop_latch, scene, outcome.stop_age, outcome.connected_seats)};
  if (const auto& restores = outcome.restores)
    status.counts = {outcome.stops - restores->numbers, restores->restarts, restores->moves};
  if (drain.active()) status.drain = registry_.drain_progress();
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    status.seats.push_back({scene.seats[i].name, access_role(scene.seats[i].role), outcome.seats[i].taken,
                            outcome.seats[i].heard, i < outcome.masters,
                            outcome.seats[i].taken ? entry.seats[i].person() : std::string{}});
  for (std::size_t j = 0; j < outcome.tools; ++j)
    status.tools.push_back(
        {scene.tools[j].name, {outcome.alpha[j].begin(), outcome.alpha[j].begin() + outcome.masters}});
  status.recording = recording_of(entry);
  if (!status.recording || !status.recording->by_server) status.no_recording = entry.registration.no_recording;
  if (outcome.state == wire::SessionState::kHeld || status.phase == rpc::SessionPhase::kHeld) {
    SessionStatus seen = entry.session().status();  // perhaps of the tick before
    seen.may_act = outcome.may_act;
    status.held = truncate_utf8(held_reason_text(seen, scene), rpc::kTextMax);
  }
  if (status.stop)
    status.stop->yours = (!joined.seat.empty() || !watches_only(joined.role)) &&
                         outcome.stop_latch.may_be_ended_by(joined.role, seat_of(joined), outcome.connected_seats);
  // The session knows the seat of a stop by key or datagram; the person is the one who had it then.
  const StopLatch::Latest& latest = outcome.stop_latch.latest();
  if (status.stop && latest.by < entry.seats.size() && !latest.restored && latest.words.workstation.empty())
    status.stop->person = entry.seats[latest.by].person_at(io::monotonic_now() - from_seconds(outcome.stop_age));
  if (allowed(joined.role, Right::kScore) == Grant::kYes) status.notes = entry.notes.newest();
  if (entry.registration.stored) status.not_stored = truncate_utf8(entry.registration.stored->problem(), rpc::kTextMax);
  status.events = entry.notices.events();
  return status;
}

void SessionCommands::drain(std::uint32_t grace_s, const std::string& who) {
  registry_.drain().schedule(io::monotonic_now() + std::chrono::seconds(grace_s));
  const bool moves = registry_.drain().sessions_move();
  const std::string when = format(" are released in %u s; requested by ", grace_s) + who;
  const std::string release =
      moves ? "its sessions move to other servers, and hands that are still here" + when : "all hands" + when;
  for (SessionEntry& entry : registry_.entries()) entry.notices.add("the server DRAINS: " + release);
  const std::string detail = who + format(" in %u s", grace_s);
  if (on_message_) on_message_("DRAINING: new joins are rejected, " + std::string(moves ? "" : "and ") + release);
  io::log_event(io::Level::kInfo, {.event = "drain", .text = detail});
  audit_.audit(auth::wall_seconds(), "drain", "", detail);
}

// ---- Revocation ----

void SessionCommands::disconnect_revoked() {
  const auto workstations = audit_.registry().workstations();
  if (!workstations) return;  // an unreadable registry takes no seat
  const auto revoked = [&](const std::optional<WorkstationRow>& owner) {
    return owner && auth::find_workstation(*workstations, auth::KeyFingerprint{owner->spki}) == nullptr;
  };
  for (SessionEntry& entry : registry_.entries()) {
    if (!entry.open()) continue;
    for (std::size_t i = 0; i < entry.seats.size(); ++i)
      if (!entry.seats[i].joining() && revoked(entry.seats[i].owner())) release_seat(entry, i);
    const auto remove_peers = [&](auto& slots, ShardRequest::Peers peers) {
      for (std::size_t slot = 0; slot < slots.kMax; ++slot) {
        const auto& peer = slots.slots()[slot];
        if (!revoked(peer.owner)) continue;
        slots.remove(slot);
        registry_.post(entry,
                       {.what = ShardRequest::What::kRemovePeer, .peers = peers, .place = slot, .cid = peer.cid});
      }
    };
    remove_peers(entry.link_tests, ShardRequest::Peers::kLinkTests);
    remove_peers(entry.watchers, ShardRequest::Peers::kWatchers);
  }
}

void SessionCommands::release_seat(SessionEntry& entry, std::size_t seat) {
  SeatReservation& reservation = entry.seats[seat];
  if (!reservation.expire()) return;  // a request before this one releases it
  ShardRequest request{.what = ShardRequest::What::kRevokeSeat, .seat = seat, .cid = reservation.cid()};
  request.done = [this, &entry, &reservation](ShardRequest& executed) {
    if (executed.result == JoinResult::kSessionOver || !reservation.owned_by(executed.cid))
      return;  // the session is over, or another check has handled the seat
    if (executed.outcome.result == Result::kDone) {
      const std::string &session = entry.registration.name, &name = entry.scene().seats[executed.seat].name;
      const std::uint32_t tick = executed.outcome.tick;
      io::log_event(io::Level::kWarn, {.event = "revoked_seat", .session = session, .seat = name, .tick = tick});
      audit_.audit(auth::wall_seconds(), "revoked_seat", reservation.owner()->name,
                   session + " " + name + format(" tick %u", tick) + by_person(reservation.person()));
    }
    reservation.release();
  };
  registry_.post(entry, std::move(request));
}

}  // namespace tandem::server
