#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "server/app/control/session_registry.h"
#include "server/app/monitor/session_status.h"
#include "server/policy/roles.h"
#include "server/session/connection_id.h"
#include "server/session/stop_text.h"

/// Control connections: consoles, link tests, commands, and what a removed or revoked participant loses.
namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;
using Result = CommandOutcome::Result;

constexpr std::size_t kLinkTestPlaces = 64;   // connection-id places behind the seats, assigned in turn
constexpr std::uint32_t kLinkTestRetryS = 3;  // a silent peer's slot is free by then

template <class... Messages>
const rpc::Id* id_in(const rpc::Body& body) {
  const rpc::Id* id = nullptr;
  ((id = std::holds_alternative<Messages>(body) ? &std::get<Messages>(body).session_id : id), ...);
  return id;
}
/// Session that a command addresses; null if it names none.
const rpc::Id* session_of(const rpc::Body& body) {
  return id_in<rpc::StopSession, rpc::PauseSession, rpc::ResumeSession, rpc::SetAuthority, rpc::RemoveParticipant,
               rpc::StatusRequest>(body);
}

const char* event_of(SessionCommand::What what) noexcept {
  switch (what) {
    case SessionCommand::What::kQueryStatus:
      break;
    case SessionCommand::What::kStop:
      return "stop";
    case SessionCommand::What::kPause:
      return "pause";
    case SessionCommand::What::kResume:
      return "resume";
    case SessionCommand::What::kSetAuthority:
      return "authority";
    case SessionCommand::What::kRemove:
      return "remove";
  }
  return "look";
}

ErrorReply ticket_error_reply(const SessionCommand& command, const CommandOutcome& outcome, const SceneSpec& scene) {
  switch (outcome.result) {
    case Result::kForbidden:
      if (command.what == SessionCommand::What::kSetAuthority)
        return {ErrorCode::kNotAllowed,
                allowed(command.role, Right::kAuthority) == Grant::kYes
                    ? "evaluators and observers get no authority"
                    : "you may only give your own authority back to an instructor",
                0};
      if (command.what == SessionCommand::What::kResume && outcome.stop_latch.latched())
        return {ErrorCode::kNotAllowed,
                "you may not end this stop; it can be ended by: " +
                    may_end_text(outcome.stop_latch, scene, outcome.connected_seats),
                0};
      return {ErrorCode::kNotAllowed, "your role may not do this", 0};
    case Result::kSeatLost:
      break;  // handled by seat_lost_text
    case Result::kOutdated:
      if (command.number > outcome.stops)
        return {ErrorCode::kOutdated,
                format("there is no stop %u; the newest is stop %u", command.number, outcome.stops), 0};
      return {ErrorCode::kOutdated,
              format("stop %u is not the newest: stop %u followed; check its reason, then resume that stop",
                     command.number, outcome.stops),
              0};
    case Result::kHeldByOthers:
      return {ErrorCode::kNotAllowed,
              "your pause is withdrawn; still paused: " +
                  may_end_text(outcome.stop_latch, scene, outcome.connected_seats) + " can end it",
              0};
    case Result::kNothingToDo:
      if (command.what == SessionCommand::What::kRemove)
        return {ErrorCode::kNoSeat, "no client is on seat " + scene.seats[command.target_seat].name, 0};
      return {ErrorCode::kOutdated, "nothing is stopped: there is nothing to resume", 0};
    case Result::kInvalid:
      return {ErrorCode::kBadFrame,
              format("this session has %u tools and %u masters; each master needs an authority; they must sum to 1",
                     outcome.tools, outcome.masters),
              0};
    case Result::kStaleLink:
      return {ErrorCode::kNotNow,
              "a seat whose authority would change is not connected, or its link is stale; the audit log names the "
              "seat. Check the status, then repeat the command",
              0};
    case Result::kDone:
      break;
  }
  return {ErrorCode::kInternal, "internal error: the server has no result of this command", 0};
}

std::vector<double> weights_of(const CommandOutcome& outcome, std::size_t tool) {
  return {outcome.alpha[tool].begin(), outcome.alpha[tool].begin() + outcome.masters};
}

}  // namespace

rpc::Status SessionRegistry::status_of(const SessionEntry& room, const rpc::Welcome& standing,
                                       const CommandOutcome& outcome) const {
  const SceneSpec& scene = room.registration.session->scene();
  rpc::Status status;
  status.session_id = standing.session_id;
  status.name = standing.session_name;
  status.phase = SessionRegistry::phase_of(outcome.state);
  status.stops = outcome.stops;
  status.authority_version = outcome.authority_version;
  status.time_s = outcome.time;
  status.draining = draining_;
  if (draining_) status.drain = drain_progress();
  static_assert(static_cast<std::uint32_t>(ShedLevel::kNewJoins) == rpc::kShedMax);
  status.shed = static_cast<std::uint32_t>(outcome.shed_level);
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    status.seats.push_back({scene.seats[i].name, access_role(scene.seats[i].role), outcome.seats[i].taken,
                            outcome.seats[i].heard, i < outcome.masters});
  for (std::size_t j = 0; j < outcome.tools; ++j) status.tools.push_back({scene.tools[j].name, weights_of(outcome, j)});
  status.events = room.notices.list;
  if (outcome.state == wire::SessionState::kHeld)
    status.held = truncate_utf8(held_reason_text(room.registration.session->status(), scene), rpc::kTextMax);
  status.stop = latest_stop(outcome.stop_latch, scene, outcome.stop_age, outcome.connected_seats);
  if (!status.stop) return status;
  if (status.stop->seat.empty() && room.stop_reason.number == status.stop->number &&
      status.stop->kind != rpc::StopKind::kFault)
    status.stop->workstation = room.stop_reason.workstation;
  if (room.stop_reason.number == status.stop->number) status.stop->why = room.stop_reason.text;
  const std::uint8_t seat =
      standing.seat.empty() ? AuditEvent::kNoSeat : static_cast<std::uint8_t>(place_of(standing.server_cid) - 1);
  status.stop->yours = outcome.stop_latch.may_be_ended_by(standing.role, seat, outcome.connected_seats);
  return status;
}

namespace {

rpc::Body command_reply(const SessionCommand& command, const CommandOutcome& outcome, const SceneSpec& scene) {
  const bool done = outcome.result == Result::kDone;
  if (command.what == SessionCommand::What::kSetAuthority && (done || outcome.result == Result::kOutdated))
    return rpc::AuthorityReply{done, command.authority.tool, outcome.authority_version,
                               weights_of(outcome, command.authority.tool)};
  if (!done) return ticket_error_reply(command, outcome, scene);
  return rpc::Ok{};
}

}  // namespace

// ---- Consoles ----

void SessionRegistry::join_console(SessionEntry& room, const JoinRequest& request,
                                   const std::function<void(JoinReply)>& answer) {
  const auto* ticket = std::get_if<rpc::TicketCredential>(&request.hello.credential);
  const std::string how = "`tandem-server ticket --session " + room.registration.name +
                          " --role operator --workstation " + request.workstation.name + "`";
  if (ticket == nullptr)
    return answer(ErrorReply{ErrorCode::kNoSeat,
                             "a join without a seat needs a ticket, such as from " + how +
                                 "; seats: " + room.registration.session->seat_catalogue().seat_names(),
                             0});
  const auto role = auth::claimed_role(ticket->bytes);
  if (role && !may_join_console(*role))
    return answer(ErrorReply{ErrorCode::kNotAllowed,
                             "the role " + std::string(to_text(*role)) +
                                 " needs a seat; a console has the role instructor, operator or recorder",
                             0});
  const auth::TicketUse use{
      room.registration.id, room.registration.epoch, "", std::nullopt, auth::KeyFingerprint{request.workstation.spki},
      auth::wall_seconds()};
  const auto redeemed = trust_.redeem(ticket->bytes, use);
  if (!redeemed) return answer(ticket_refused(redeemed.error()));
  // No seat has place 0: no datagram opens under these keys.
  rpc::Welcome w = welcome(room, 0, nullptr, 0, request.hello.has_aes, 1);
  w.role = redeemed->role;
  w.setup.clear();
  room.consoles.push_back({w.resume_secret, redeemed->ticket_id});
  answer(std::move(w));
}

ErrorReply SessionRegistry::ticket_refused(const auth::ServerKeystore::RedeemFailure& trouble) const {
  if (!trouble.fault) {  // a failure of the server itself
    if (on_message_) on_message_("no ticket can be used: " + trouble.text);
    io::log_event(io::Level::kError, {.event = "error", .text = trouble.text});
  }
  return server::ticket_error_reply(trouble);
}

void SessionRegistry::restore_ticket(const auth::Id16& ticket, const SessionEntry& room) {
  const std::string problem = trust_.restore_ticket(ticket);
  trust_.audit(auth::wall_seconds(), "ticket_unused", room.registration.name,
               auth::to_hex(ticket) + (problem.empty() ? "" : ": " + problem));
}

bool SessionRegistry::is_current(const rpc::Welcome& standing) const {
  const auto found = std::ranges::find_if(
      entries_, [&](const SessionEntry& r) { return r.registration.id == standing.session_id && !r.on_closed; });
  if (found == entries_.end()) return false;
  if (!standing.seat.empty()) {
    const SeatReservation& claim = found->reservations[place_of(standing.server_cid) - std::size_t{1}];
    return claim.cid == standing.server_cid && claim.owner;
  }
  return std::ranges::any_of(found->link_tests,
                             [&](const LinkTestSlot& v) { return v.cid == standing.server_cid && v.owner; }) ||
         std::ranges::any_of(found->consoles, [&](const ConsoleTicket& s) {
           return equal_secret(s.secret.bytes, standing.resume_secret.bytes);
         });
}

/// Recorders only query status, so their ticket counts as used.
void SessionRegistry::on_disconnected(const rpc::Welcome& standing, bool in_vain) {
  SessionEntry* const found = find_entry(standing.session_id);
  if (found != nullptr)
    release_console(*found, standing, in_vain && allowed(standing.role, Right::kStopSession) != Grant::kNo);
}

void SessionRegistry::release_console(SessionEntry& room, const rpc::Welcome& standing, bool ticket_is_good_again) {
  const auto it = std::ranges::find_if(room.consoles, [&](const ConsoleTicket& s) {
    return equal_secret(s.secret.bytes, standing.resume_secret.bytes);
  });
  if (it == room.consoles.end()) return;
  if (ticket_is_good_again) restore_ticket(it->ticket, room);
  room.consoles.erase(it);
}

// ---- Link tests ----

void SessionRegistry::join_link_test(SessionEntry& room, const JoinRequest& request,
                                     std::function<void(JoinReply)> answer) {
  // Any enrolled workstation may test its link, because that touches no seat. The number of peers is limited.
  const ErrorReply full{ErrorCode::kFull,
                        format("all %zu link-test slots of this session are taken; try again in %u s",
                               LinkTestPeers::kMax, kLinkTestRetryS),
                        kLinkTestRetryS};
  if (room.link_tests_joining >= LinkTestPeers::kMax) return answer(full);
  ++room.link_tests_joining;
  ShardRequest order;
  order.what = ShardRequest::What::kQueryLinkTest;
  order.session = room.registration.session;
  order.done = [this, &room, full, has_aes = request.hello.has_aes, answer = std::move(answer)](ShardRequest& asked) {
    if (asked.result == JoinResult::kAccepted && asked.place >= room.link_tests_joining)
      return answer(welcome(room, 0, nullptr,
                            static_cast<std::uint8_t>(kSeatsMax + 1 + link_test_counter_++ % kLinkTestPlaces), has_aes,
                            1));
    --room.link_tests_joining;
    answer(asked.result == JoinResult::kAccepted ? full
                                                 : ErrorReply{ErrorCode::kSessionOver, "the session is ending", 0});
  };
  post(room, std::move(order));
}

/// Records the owner of the slot, or that the join failed.
void SessionRegistry::on_link_test_joined(SessionEntry& room, const ShardRequest& order, const WorkstationRow& by,
                                          std::uint32_t cid) {
  --room.link_tests_joining;
  if (order.result == JoinResult::kAccepted) room.link_tests[order.place] = {by, cid};
}

// ---- Commands ----

void SessionRegistry::command(const rpc::Welcome& standing, const WorkstationRow& workstation, const rpc::Body& body,
                              std::function<void(rpc::Body)> answer) {
  const std::string who = workstation.name + " (" + std::string(to_text(standing.role)) +
                          (standing.seat.empty() ? "" : ", seat " + standing.seat) + ")";
  if (const auto* drain = std::get_if<rpc::Drain>(&body)) {
    drain_in(drain->grace_s, who);
    return answer(rpc::Ok{});
  }
  const rpc::Id* const id = session_of(body);
  if (id == nullptr || *id != standing.session_id)
    return answer(ErrorReply{
        ErrorCode::kNotAllowed,
        "this connection joined the session " + standing.session_name + " and cannot act for another one", 0});
  SessionEntry* const found = find_entry(*id);
  if (found == nullptr) return answer(ErrorReply{ErrorCode::kSessionOver, "this session is over", 0});
  SessionEntry& room = *found;
  const SceneSpec& scene = room.registration.session->scene();

  ShardRequest order;
  order.what = ShardRequest::What::kCommand;
  order.session = room.registration.session;
  SessionCommand& c = order.command;
  c.role = standing.role;
  if (!standing.seat.empty()) {
    c.seat = static_cast<std::uint8_t>(place_of(standing.server_cid) - 1);
    c.cid = standing.server_cid;
  }
  std::string why;
  if (const auto* stop = std::get_if<rpc::StopSession>(&body)) {
    c.what = SessionCommand::What::kStop;
    why = stop->why;
  } else if (const auto* pause = std::get_if<rpc::PauseSession>(&body)) {
    c.what = SessionCommand::What::kPause;
    why = pause->why;
  } else if (const auto* resume = std::get_if<rpc::ResumeSession>(&body)) {
    c.what = SessionCommand::What::kResume;
    c.number = resume->stop;
  } else if (const auto* wish = std::get_if<rpc::SetAuthority>(&body)) {
    c.what = SessionCommand::What::kSetAuthority;
    c.authority.tool = wish->tool;
    c.authority.version = wish->version;
    c.authority.masters = static_cast<std::uint32_t>(wish->alpha.size());
    std::ranges::copy(wish->alpha, c.authority.alpha.begin());
  } else if (const auto* remove = std::get_if<rpc::RemoveParticipant>(&body)) {
    const auto seat = room.registration.session->seat_catalogue().seat_named(remove->seat);
    if (!seat)
      return answer(
          ErrorReply{ErrorCode::kNoSeat,
                     "no seat of this name; seats: " + room.registration.session->seat_catalogue().seat_names(), 0});
    c.what = SessionCommand::What::kRemove;
    c.target_seat = static_cast<std::uint8_t>(*seat);
    why = remove->why;
  }
  order.done = [this, &room, &scene, standing, who, why, name = workstation.name,
                answer = std::move(answer)](ShardRequest& carried) {
    if (carried.result == JoinResult::kSessionOver)
      return answer(ErrorReply{ErrorCode::kSessionOver, "this session is over", 0});
    const SessionCommand& asked = carried.command;
    const bool done = carried.outcome.result == Result::kDone;
    if (done && (asked.what == SessionCommand::What::kStop || asked.what == SessionCommand::What::kPause))
      room.stop_reason = {carried.outcome.stops, name, why};
    if (done && asked.what == SessionCommand::What::kResume) {
      room.notices.resumed = asked.number;
      room.notices.resumer = who;
    }
    report_resume(room, carried.outcome);
    if (done && asked.what == SessionCommand::What::kRemove)
      add_notice(room, scene.seats[asked.target_seat].name + " is REMOVED by " + who +
                           ", the hand is released within 0.2 s" + (why.empty() ? "" : ": " + why));
    if (done && asked.what == SessionCommand::What::kRemove)
      mark_removed(room, asked.target_seat, "removed by " + who + (why.empty() ? "" : ": " + why));
    record_command(room, who, why, asked, carried.outcome);
    if (done && asked.what == SessionCommand::What::kQueryStatus)
      return answer(status_of(room, standing, carried.outcome));
    if (carried.outcome.result == Result::kSeatLost && !standing.seat.empty())
      return answer(ErrorReply{ErrorCode::kNotAllowed, seat_lost_text(room, standing), 0});
    answer(command_reply(asked, carried.outcome, scene));
  };
  post(room, std::move(order));
}

void SessionRegistry::record_command(SessionEntry& room, const std::string& who, const std::string& why,
                                     const SessionCommand& c, const CommandOutcome& outcome) {
  if (c.what == SessionCommand::What::kQueryStatus) return;
  const bool forbidden = outcome.result == Result::kForbidden || outcome.result == Result::kSeatLost;
  if (outcome.result != Result::kDone && !(forbidden && room.forbidden_events.take(io::monotonic_now()))) return;
  const SceneSpec& scene = room.registration.session->scene();
  std::string detail = who;
  if (c.what == SessionCommand::What::kRemove) detail += " " + scene.seats[c.target_seat].name;
  if (c.what == SessionCommand::What::kStop || c.what == SessionCommand::What::kPause ||
      c.what == SessionCommand::What::kResume)
    detail += format(" stop %u", outcome.stops);
  if (c.what == SessionCommand::What::kSetAuthority)
    detail += format(" %s version %u",
                     c.authority.tool < scene.tools.size() ? scene.tools[c.authority.tool].name.c_str() : "?",
                     outcome.authority_version);
  detail += format(" tick %u", outcome.tick);
  if (c.what == SessionCommand::What::kSetAuthority && !forbidden)
    for (std::size_t i = 0; i < outcome.masters; ++i)
      detail += format("%s %s %.3f to %.3f", i == 0 ? ":" : ",", scene.seats[i].name.c_str(), outcome.before[i],
                       outcome.alpha[c.authority.tool][i]);
  if (forbidden) detail += std::string(": may not ") + event_of(c.what);
  if (!why.empty()) detail += ": " + why;
  const char* const event = forbidden ? "forbidden" : event_of(c.what);
  io::log_event(forbidden ? io::Level::kWarn : io::Level::kInfo,
                {.event = event, .session = room.registration.name, .tick = outcome.tick, .text = detail});
  trust_.audit(auth::wall_seconds(), event, room.registration.name, detail);
  if (!on_message_ || forbidden || c.what == SessionCommand::What::kSetAuthority) return;
  std::string words = c.what == SessionCommand::What::kRemove   ? scene.seats[c.target_seat].name + " REMOVED"
                      : c.what == SessionCommand::What::kResume ? "RESUMED"
                      : c.what == SessionCommand::What::kPause  ? "PAUSED"
                                                                : "STOPPED";
  words += " by " + who + (why.empty() ? "" : ": " + sanitize(why));
  on_message_(entries_.size() == 1 ? words : room.registration.name + ": " + words);
}

void SessionRegistry::drain_in(std::uint32_t grace_s, const std::string& who) {
  draining_ = true;
  const std::int64_t due = (io::monotonic_now() + std::chrono::seconds(grace_s)).time_since_epoch().count();
  const std::int64_t before = drain_due_.load(std::memory_order_relaxed);
  if (before == 0 || due < before) drain_due_.store(due, std::memory_order_relaxed);
  for (SessionEntry& room : entries_)
    add_notice(room, format("the server DRAINS: all hands are released in %u s; requested by ", grace_s) + who);
  const std::string detail = who + format(" in %u s", grace_s);
  if (on_message_)
    on_message_(format("DRAINING: new joins are rejected, and all hands are released in %u s; requested by ", grace_s) +
                who);
  io::log_event(io::Level::kInfo, {.event = "drain", .text = detail});
  trust_.audit(auth::wall_seconds(), "drain", "", detail);
}

rpc::StatusDrain SessionRegistry::drain_progress() const {
  rpc::StatusDrain drain;
  if (const auto due = drain_due())
    drain.left_s = static_cast<std::uint32_t>(std::max(0.0, std::ceil(seconds(*due - io::monotonic_now()))));
  for (const SessionEntry& r : entries_) {
    if (r.on_closed || r.registration.session->over()) continue;
    ++drain.sessions;
    const SessionStatus status = r.registration.session->status();
    for (std::size_t i = 0; i < r.registration.session->scene().seats.size(); ++i)
      drain.participants += status.seats[i].taken ? 1 : 0;
  }
  return drain;
}

std::optional<Time> SessionRegistry::drain_due() const noexcept {
  const std::int64_t due = drain_due_.load(std::memory_order_relaxed);
  return due == 0 ? std::nullopt : std::optional(Time{Duration{due}});
}

// ---- Removal and revocation ----

/// Marks the owner of a seat as removed: the resume secret expires and the session's code does not admit the
/// workstation again.
void SessionRegistry::mark_removed(SessionEntry& room, std::size_t seat, std::string how) {
  SeatReservation& claim = room.reservations[seat];
  claim.lost_cid = claim.cid;
  claim.lost_why = std::move(how);
  claim.resumable = false;
  const auto by = std::exchange(claim.owner, std::nullopt);
  if (!by || is_removed(room, *by)) return;
  room.removed_workstations.push_back(by->spki);
  if (room.registration.on_removed) room.registration.on_removed(room.removed_workstations);
}

/// Reply to a client whose seat was taken away.
std::string SessionRegistry::seat_lost_text(const SessionEntry& room, const rpc::Welcome& standing) {
  const SeatReservation& claim = room.reservations[place_of(standing.server_cid) - std::size_t{1}];
  const std::string how =
      claim.lost_cid == standing.server_cid && !claim.lost_why.empty() ? " (" + claim.lost_why + ")" : "";
  return truncate_utf8("this connection no longer holds its seat" + how, rpc::kTextMax);
}

bool SessionRegistry::is_removed(const SessionEntry& room, const WorkstationRow& workstation) {
  return room.removed_workstations.size() >= kRemovedWorkstationsMax ||
         std::ranges::find(room.removed_workstations, workstation.spki) != room.removed_workstations.end();
}

void SessionRegistry::disconnect_revoked() {
  const auto book = trust_.workstations();
  if (!book) return;  // an unreadable registry takes no seat
  const auto revoked = [&](const std::optional<WorkstationRow>& by) {
    return by && auth::find_workstation(*book, auth::KeyFingerprint{by->spki}) == nullptr;
  };
  for (SessionEntry& room : entries_) {
    if (room.on_closed || room.registration.session->over()) continue;
    for (std::size_t i = 0; i < room.reservations.size(); ++i)
      if (!room.reservations[i].joining && revoked(room.reservations[i].owner)) release_seat(room, i);
    for (std::size_t place = 0; place < room.link_tests.size(); ++place) {
      LinkTestSlot& visit = room.link_tests[place];
      if (!revoked(visit.owner)) continue;
      ShardRequest order;
      order.what = ShardRequest::What::kRemoveLinkTest;
      order.session = room.registration.session;
      order.place = place;
      order.cid = visit.cid;
      order.done = [](ShardRequest&) {};
      visit.owner.reset();
      post(room, std::move(order));
    }
  }
}

void SessionRegistry::release_seat(SessionEntry& room, std::size_t seat) {
  SeatReservation& claim = room.reservations[seat];
  claim.resumable = false;
  ShardRequest order;
  order.what = ShardRequest::What::kCommand;
  order.session = room.registration.session;
  order.command.what = SessionCommand::What::kRemove;
  order.command.role = AccessRole::kOperator;
  order.command.target_seat = static_cast<std::uint8_t>(seat);
  order.command.target_cid = claim.cid;
  order.command.close_reason = wire::CloseReason::kRevoked;
  order.done = [this, &room, &claim, seat](ShardRequest& carried) {
    if (carried.result == JoinResult::kSessionOver || claim.cid != carried.command.target_cid || !claim.owner)
      return;  // the session is over, or another check has handled the seat
    const std::string detail =
        room.registration.session->scene().seats[seat].name + format(" tick %u", carried.outcome.tick);
    if (carried.outcome.result == Result::kDone) {
      io::log_event(io::Level::kWarn, {.event = "revoked_seat",
                                       .session = room.registration.name,
                                       .seat = room.registration.session->scene().seats[seat].name,
                                       .tick = carried.outcome.tick});
      trust_.audit(auth::wall_seconds(), "revoked_seat", claim.owner->name, room.registration.name + " " + detail);
    }
    claim.owner.reset();
  };
  post(room, std::move(order));
}

}  // namespace tandem::server
