#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/format.h"
#include "common/base/printable.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "server/app/house.h"
#include "server/app/status.h"
#include "server/connection_id.h"
#include "server/roles.h"
#include "server/stop_words.h"

/// People at control connections: those without a seat, what they order, and what is taken from those who are sent away.
namespace tandem::server {
namespace {

using control::Reason;
using control::Refused;
using Result = Outcome::Result;

constexpr std::size_t kVisitorPlaces = 64;  // ids behind the seats', in turn
constexpr std::uint32_t kVisitAgainS = 3;   // who fell silent has left his place by then

template <class... Messages>
const control::Id* id_in(const control::Body& body) {
  const control::Id* id = nullptr;
  ((id = std::holds_alternative<Messages>(body) ? &std::get<Messages>(body).session_id : id), ...);
  return id;
}
/// The session a command is for.
const control::Id* session_of(const control::Body& body) {
  return id_in<control::StopSession, control::PauseSession, control::ResumeSession, control::SetAuthority, control::RemovePerson, control::StatusRequest>(body);
}

const char* event_of(Command::What what) noexcept {
  switch (what) {
    case Command::What::kLook: break;
    case Command::What::kStop: return "stop";
    case Command::What::kPause: return "pause";
    case Command::What::kResume: return "resume";
    case Command::What::kSetAuthority: return "authority";
    case Command::What::kRemove: return "remove";
  }
  return "look";
}

Refused refusal_of(const Command& command, const Outcome& outcome, const SceneSpec& scene) {
  switch (outcome.result) {
    case Result::kForbidden:
      if (command.what == Command::What::kSetAuthority)
        return {Reason::kNotAllowed, allowed(command.who, Right::kAuthority) == Grant::kYes ? "who may never drive (evaluators, observers) gets no weight"
                                                                                             : "you may give weight of your own back to an instructor, nothing else", 0};
      if (command.what == Command::What::kResume && outcome.lane.on())
        return {Reason::kNotAllowed, "you may not end this stop; who may: " + who_ends(outcome.lane, scene, outcome.there), 0};
      return {Reason::kNotAllowed, "your role may not do this", 0};
    case Result::kGone:
      break;  // told by who knows why
    case Result::kOutdated:
      if (command.number > outcome.stops) return {Reason::kOutdated, format("there is no stop %u; the newest is stop %u", command.number, outcome.stops), 0};
      return {Reason::kOutdated, format("stop %u is not the newest: stop %u came since. Look why, then resume that one", command.number, outcome.stops), 0};
    case Result::kOthers:
      return {Reason::kNotAllowed, "your pause is taken back; still paused: " + who_ends(outcome.lane, scene, outcome.there) + " ends it", 0};
    case Result::kNothing:
      if (command.what == Command::What::kRemove) return {Reason::kNoSeat, "nobody sits on " + scene.seats[command.whom].name, 0};
      return {Reason::kOutdated, "nothing is stopped: there is nothing to resume", 0};
    case Result::kWrong:
      return {Reason::kBadFrame, format("this session has %u tools and %u masters; each master needs a weight, together 1", outcome.tools, outcome.masters), 0};
    case Result::kOutOfTouch:
      return {Reason::kNotNow, "somebody whose weight this changes is not there, or was not heard from for longer than a hand-over may wait; the audit log "
                                "names the seat. Look, then say it again", 0};
    case Result::kDone:
      break;
  }
  return {Reason::kTrouble, "the server does not know what became of this", 0};
}

std::vector<double> weights_of(const Outcome& outcome, std::size_t tool) { return {outcome.alpha[tool].begin(), outcome.alpha[tool].begin() + outcome.masters}; }

}  // namespace

control::Status House::status_of(const Room& room, const control::Welcome& standing, const Outcome& outcome) const {
  const SceneSpec& scene = room.opening.session->scene();
  control::Status status;
  status.session_id = standing.session_id;
  status.name = standing.session_name;
  status.phase = House::phase_of(outcome.state);
  status.stops = outcome.stops;
  status.authority_version = outcome.authority_version;
  status.time_s = outcome.time;
  status.draining = draining_;
  if (draining_) status.drain = drain_progress();
  static_assert(static_cast<std::uint32_t>(Rung::kNewcomers) == control::kShedMax);
  status.shed = static_cast<std::uint32_t>(outcome.shed);
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    status.seats.push_back({scene.seats[i].name, access_role(scene.seats[i].role), outcome.seats[i].taken, outcome.seats[i].heard, i < outcome.masters});
  for (std::size_t j = 0; j < outcome.tools; ++j) status.tools.push_back({scene.tools[j].name, weights_of(outcome, j)});
  status.news = room.news.list;
  if (outcome.state == wire::SessionState::kHeld) status.held = cut_to(why_held(room.opening.session->status(), scene), control::kTextMax);
  status.stop = newest_stop(outcome.lane, scene, outcome.stopped_ago, outcome.there);
  if (!status.stop) return status;
  if (status.stop->seat.empty() && room.words.number == status.stop->number && status.stop->kind != control::StopKind::kFault) status.stop->workstation = room.words.workstation;
  if (room.words.number == status.stop->number) status.stop->why = room.words.why;
  const std::uint8_t seat = standing.seat.empty() ? AuditEvent::kNoSeat : static_cast<std::uint8_t>(place_of(standing.server_cid) - 1);
  status.stop->yours = outcome.lane.awaits(standing.role, seat, outcome.there);
  return status;
}

namespace {

control::Body answer_to(const Command& command, const Outcome& outcome, const SceneSpec& scene) {
  const bool done = outcome.result == Result::kDone;
  if (command.what == Command::What::kSetAuthority && (done || outcome.result == Result::kOutdated))
    return control::AuthorityAnswer{done, command.wish.tool, outcome.authority_version, weights_of(outcome, command.wish.tool)};
  if (!done) return refusal_of(command, outcome, scene);
  return control::Done{};
}

}  // namespace

// ---- Without a seat -----------------------------------------------------------------------------------------------------------

void House::stand(Room& room, const JoinRequest& request, const std::function<void(Admission)>& answer) {
  const auto* ticket = std::get_if<control::TicketCredential>(&request.hello.credential);
  const std::string how = "`tandem-server ticket --session " + room.opening.name + " --role operator --workstation " + request.workstation.name + "`";
  if (ticket == nullptr)
    return answer(Refused{Reason::kNoSeat, "who joins without a seat needs a ticket, such as of " + how + "; seats: " + room.opening.session->reception().seat_names(), 0});
  const auto role = trust::role_named_in(ticket->bytes);
  if (role && !may_stand(*role))
    return answer(Refused{Reason::kNotAllowed, "somebody in the role " + std::string(to_text(*role)) + " sits on a seat; without one: instructor, operator, recorder", 0});
  const trust::TicketUse use{room.opening.id, room.opening.epoch, "", std::nullopt, trust::Pin{request.workstation.spki}, trust::wall_seconds()};
  const auto redeemed = trust_.redeem(ticket->bytes, use);
  if (!redeemed) return answer(ticket_refused(redeemed.error()));
  control::Welcome w = welcome(room, 0, nullptr, 0, request.hello.has_aes, 1);  // place 0 is nobody's: no datagram opens under these keys
  w.role = redeemed->role;
  w.setup.clear();
  room.standing.push_back({w.resume_secret, redeemed->ticket_id});
  answer(std::move(w));
}

Refused House::ticket_refused(const trust::ServerTrust::TicketTrouble& trouble) const {
  if (!trouble.fault) {  // the server's own
    if (say_) say_("no ticket can be used: " + trouble.text);
    io::tell(io::Level::kError, {.event = "trouble", .text = trouble.text});
  }
  return server::refusal_of(trouble);
}

void House::give_back(const trust::Id16& ticket, const Room& room) {
  const std::string problem = trust_.give_back(ticket);
  trust_.audit(trust::wall_seconds(), "ticket_unused", room.opening.name, trust::to_hex(ticket) + (problem.empty() ? "" : ": " + problem));
}

bool House::holds(const control::Welcome& standing) const {
  const auto found = std::ranges::find_if(rooms_, [&](const Room& r) { return r.opening.id == standing.session_id && !r.gone; });
  if (found == rooms_.end()) return false;
  if (!standing.seat.empty()) {
    const Claim& claim = found->claims[place_of(standing.server_cid) - std::size_t{1}];
    return claim.cid == standing.server_cid && claim.by;
  }
  return std::ranges::any_of(found->visits, [&](const Visit& v) { return v.cid == standing.server_cid && v.by; }) ||
         std::ranges::any_of(found->standing, [&](const Standing& s) { return equal_secret(s.who.bytes, standing.resume_secret.bytes); });
}

/// Who only may look got what his ticket is for.
void House::left(const control::Welcome& standing, bool in_vain) {
  Room* const found = room(standing.session_id);
  if (found != nullptr) stands_no_more(*found, standing, in_vain && allowed(standing.role, Right::kStopSession) != Grant::kNo);
}

void House::stands_no_more(Room& room, const control::Welcome& standing, bool ticket_is_good_again) {
  const auto it = std::ranges::find_if(room.standing, [&](const Standing& s) { return equal_secret(s.who.bytes, standing.resume_secret.bytes); });
  if (it == room.standing.end()) return;
  if (ticket_is_good_again) give_back(it->ticket, room);
  room.standing.erase(it);
}

// ---- Those who judge their link -----------------------------------------------------------------------------------------------

void House::visit(Room& room, const JoinRequest& request, std::function<void(Admission)> answer) {
  // Any enrolled workstation may judge its link: it touches no seat. But only so many are served.
  const Refused full{Reason::kFull, format("all %zu places for those who judge their link to this session are taken; try again in %u s", Visitors::kMax, kVisitAgainS),
                     kVisitAgainS};
  if (room.visits_being_given >= Visitors::kMax) return answer(full);
  ++room.visits_being_given;
  Order order;
  order.what = Order::What::kMayVisit;
  order.session = room.opening.session;
  order.done = [this, &room, full, has_aes = request.hello.has_aes, answer = std::move(answer)](Order& asked) {
    if (asked.result == JoinResult::kAccepted && asked.place >= room.visits_being_given)
      return answer(welcome(room, 0, nullptr, static_cast<std::uint8_t>(kSeatsMax + 1 + visitors_++ % kVisitorPlaces), has_aes, 1));
    --room.visits_being_given;
    answer(asked.result == JoinResult::kAccepted ? full : Refused{Reason::kSessionOver, "the session is ending", 0});
  };
  post(room, std::move(order));
}

/// He got his place, or nobody has it.
void House::visited(Room& room, const Order& order, const WorkstationRow& by, std::uint32_t cid) {
  --room.visits_being_given;
  if (order.result == JoinResult::kAccepted) room.visits[order.place] = {by, cid};
}

// ---- What people order --------------------------------------------------------------------------------------------------------

void House::command(const control::Welcome& standing, const WorkstationRow& workstation, const control::Body& body,
                    std::function<void(control::Body)> answer) {
  const std::string who = workstation.name + " (" + std::string(to_text(standing.role)) + (standing.seat.empty() ? "" : ", seat " + standing.seat) + ")";
  if (const auto* drain = std::get_if<control::Drain>(&body)) {
    drain_in(drain->grace_s, who);
    return answer(control::Done{});
  }
  const control::Id* const id = session_of(body);
  if (id == nullptr || *id != standing.session_id)
    return answer(Refused{Reason::kNotAllowed, "this connection joined the session " + standing.session_name + " and speaks for no other", 0});
  Room* const found = room(*id);
  if (found == nullptr) return answer(Refused{Reason::kSessionOver, "this session is over", 0});
  Room& room = *found;
  const SceneSpec& scene = room.opening.session->scene();

  Order order;
  order.what = Order::What::kCommand;
  order.session = room.opening.session;
  Command& c = order.command;
  c.who = standing.role;
  if (!standing.seat.empty()) {
    c.seat = static_cast<std::uint8_t>(place_of(standing.server_cid) - 1);
    c.cid = standing.server_cid;
  }
  std::string why;
  if (const auto* stop = std::get_if<control::StopSession>(&body)) {
    c.what = Command::What::kStop;
    why = stop->why;
  } else if (const auto* pause = std::get_if<control::PauseSession>(&body)) {
    c.what = Command::What::kPause;
    why = pause->why;
  } else if (const auto* resume = std::get_if<control::ResumeSession>(&body)) {
    c.what = Command::What::kResume;
    c.number = resume->stop;
  } else if (const auto* wish = std::get_if<control::SetAuthority>(&body)) {
    c.what = Command::What::kSetAuthority;
    c.wish.tool = wish->tool;
    c.wish.version = wish->version;
    c.wish.masters = static_cast<std::uint32_t>(wish->alpha.size());
    std::ranges::copy(wish->alpha, c.wish.alpha.begin());
  } else if (const auto* remove = std::get_if<control::RemovePerson>(&body)) {
    const auto seat = room.opening.session->reception().seat_named(remove->seat);
    if (!seat) return answer(Refused{Reason::kNoSeat, "no seat of this name; seats: " + room.opening.session->reception().seat_names(), 0});
    c.what = Command::What::kRemove;
    c.whom = static_cast<std::uint8_t>(*seat);
    why = remove->why;
  }
  order.done = [this, &room, &scene, standing, who, why, name = workstation.name, answer = std::move(answer)](Order& carried) {
    if (carried.result == JoinResult::kSessionOver) return answer(Refused{Reason::kSessionOver, "this session is over", 0});
    const Command& asked = carried.command;
    const bool done = carried.outcome.result == Result::kDone;
    if (done && (asked.what == Command::What::kStop || asked.what == Command::What::kPause)) room.words = {carried.outcome.stops, name, why};
    if (done && asked.what == Command::What::kResume) {
      room.news.resumed = asked.number;
      room.news.resumer = who;
    }
    look_for_resume(room, carried.outcome);
    if (done && asked.what == Command::What::kRemove)
      add_news(room, scene.seats[asked.whom].name + " is REMOVED by " + who + ", the hand is released within 0.2 s" + (why.empty() ? "" : ": " + why));
    if (done && asked.what == Command::What::kRemove) send_away(room, asked.whom, "removed by " + who + (why.empty() ? "" : ": " + why));
    write_down(room, who, why, asked, carried.outcome);
    if (done && asked.what == Command::What::kLook) return answer(status_of(room, standing, carried.outcome));
    if (carried.outcome.result == Result::kGone && !standing.seat.empty()) return answer(Refused{Reason::kNotAllowed, why_gone(room, standing), 0});
    answer(answer_to(asked, carried.outcome, scene));
  };
  post(room, std::move(order));
}

void House::write_down(Room& room, const std::string& who, const std::string& why, const Command& c, const Outcome& outcome) {
  if (c.what == Command::What::kLook) return;
  const bool forbidden = outcome.result == Result::kForbidden || outcome.result == Result::kGone;
  if (outcome.result != Result::kDone && !(forbidden && room.complaints.take(io::monotonic_now()))) return;
  const SceneSpec& scene = room.opening.session->scene();
  std::string detail = who;
  if (c.what == Command::What::kRemove) detail += " " + scene.seats[c.whom].name;
  if (c.what == Command::What::kStop || c.what == Command::What::kPause || c.what == Command::What::kResume) detail += format(" stop %u", outcome.stops);
  if (c.what == Command::What::kSetAuthority) detail += format(" %s version %u", c.wish.tool < scene.tools.size() ? scene.tools[c.wish.tool].name.c_str() : "?", outcome.authority_version);
  detail += format(" tick %u", outcome.tick);
  if (c.what == Command::What::kSetAuthority && !forbidden)
    for (std::size_t i = 0; i < outcome.masters; ++i)
      detail += format("%s %s %.3f to %.3f", i == 0 ? ":" : ",", scene.seats[i].name.c_str(), outcome.before[i], outcome.alpha[c.wish.tool][i]);
  if (forbidden) detail += std::string(": may not ") + event_of(c.what);
  if (!why.empty()) detail += ": " + why;
  const char* const event = forbidden ? "forbidden" : event_of(c.what);
  io::tell(forbidden ? io::Level::kWarn : io::Level::kInfo, {.event = event, .session = room.opening.name, .tick = outcome.tick, .text = detail});
  trust_.audit(trust::wall_seconds(), event, room.opening.name, detail);
  if (!say_ || forbidden || c.what == Command::What::kSetAuthority) return;
  std::string words = c.what == Command::What::kRemove ? scene.seats[c.whom].name + " REMOVED" : c.what == Command::What::kResume ? "RESUMED" : c.what == Command::What::kPause ? "PAUSED" : "STOPPED";
  words += " by " + who + (why.empty() ? "" : ": " + printable(why));
  say_(rooms_.size() == 1 ? words : room.opening.name + ": " + words);
}

void House::drain_in(std::uint32_t grace_s, const std::string& who) {
  draining_ = true;
  const std::int64_t due = (io::monotonic_now() + std::chrono::seconds(grace_s)).time_since_epoch().count();
  const std::int64_t before = drain_due_.load(std::memory_order_relaxed);
  if (before == 0 || due < before) drain_due_.store(due, std::memory_order_relaxed);
  for (Room& room : rooms_) add_news(room, format("the server DRAINS: all hands are let go in %u s; ordered by ", grace_s) + who);
  const std::string detail = who + format(" in %u s", grace_s);
  if (say_) say_(format("DRAINING: nobody new comes in, and all hands are let go in %u s; ordered by ", grace_s) + who);
  io::tell(io::Level::kInfo, {.event = "drain", .text = detail});
  trust_.audit(trust::wall_seconds(), "drain", "", detail);
}

control::StatusDrain House::drain_progress() const {
  control::StatusDrain drain;
  if (const auto due = drain_due()) drain.left_s = static_cast<std::uint32_t>(std::max(0.0, std::ceil(seconds(*due - io::monotonic_now()))));
  for (const Room& r : rooms_) {
    if (r.gone || r.opening.session->over()) continue;
    ++drain.sessions;
    const SessionStatus status = r.opening.session->status();
    for (std::size_t i = 0; i < r.opening.session->scene().seats.size(); ++i) drain.people += status.seats[i].taken ? 1 : 0;
  }
  return drain;
}

std::optional<Time> House::drain_due() const noexcept {
  const std::int64_t due = drain_due_.load(std::memory_order_relaxed);
  return due == 0 ? std::nullopt : std::optional(Time{Duration{due}});
}

// ---- Who is sent away ---------------------------------------------------------------------------------------------------------

/// His secret is good for nothing any more, and the session's code does not let this workstation in again.
void House::send_away(Room& room, std::size_t seat, std::string how) {
  Claim& claim = room.claims[seat];
  claim.lost_cid = claim.cid;
  claim.lost_why = std::move(how);
  claim.resumable = false;
  const auto by = std::exchange(claim.by, std::nullopt);
  if (!by || was_sent_away(room, *by)) return;
  room.sent_away.push_back(by->spki);
  if (room.opening.sent_away) room.opening.sent_away(room.sent_away);
}

/// Of somebody whose seat is not his any more.
std::string House::why_gone(const Room& room, const control::Welcome& standing) {
  const Claim& claim = room.claims[place_of(standing.server_cid) - std::size_t{1}];
  const std::string how = claim.lost_cid == standing.server_cid && !claim.lost_why.empty() ? " (" + claim.lost_why + ")" : "";
  return cut_to("the seat that this connection joined for is not yours any more" + how, control::kTextMax);
}

bool House::was_sent_away(const Room& room, const WorkstationRow& workstation) {
  return room.sent_away.size() >= kSentAwayMax || std::ranges::find(room.sent_away, workstation.spki) != room.sent_away.end();
}

void House::look_for_revoked() {
  const auto book = trust_.workstations();
  if (!book) return;  // a book that cannot be read takes nobody's seat
  const auto revoked = [&](const std::optional<WorkstationRow>& by) { return by && trust::find_workstation(*book, trust::Pin{by->spki}) == nullptr; };
  for (Room& room : rooms_) {
    if (room.gone || room.opening.session->over()) continue;
    for (std::size_t i = 0; i < room.claims.size(); ++i)
      if (!room.claims[i].being_given && revoked(room.claims[i].by)) let_go(room, i);
    for (std::size_t place = 0; place < room.visits.size(); ++place) {
      Visit& visit = room.visits[place];
      if (!revoked(visit.by)) continue;
      Order order;
      order.what = Order::What::kDismissVisitor;
      order.session = room.opening.session;
      order.place = place;
      order.cid = visit.cid;
      order.done = [](Order&) {};
      visit.by.reset();
      post(room, std::move(order));
    }
  }
}

void House::let_go(Room& room, std::size_t seat) {
  Claim& claim = room.claims[seat];
  claim.resumable = false;
  Order order;
  order.what = Order::What::kCommand;
  order.session = room.opening.session;
  order.command.what = Command::What::kRemove;
  order.command.who = AccessRole::kOperator;
  order.command.whom = static_cast<std::uint8_t>(seat);
  order.command.whom_cid = claim.cid;
  order.command.why = wire::CloseReason::kRevoked;
  order.done = [this, &room, &claim, seat](Order& carried) {
    if (carried.result == JoinResult::kSessionOver || claim.cid != carried.command.whom_cid || !claim.by) return;  // over, or looked at again
    const std::string detail = room.opening.session->scene().seats[seat].name + format(" tick %u", carried.outcome.tick);
    if (carried.outcome.result == Result::kDone) {
      io::tell(io::Level::kWarn, {.event = "revoked_seat", .session = room.opening.name, .seat = room.opening.session->scene().seats[seat].name, .tick = carried.outcome.tick});
      trust_.audit(trust::wall_seconds(), "revoked_seat", claim.by->name, room.opening.name + " " + detail);
    }
    claim.by.reset();
  };
  post(room, std::move(order));
}

}  // namespace tandem::server
