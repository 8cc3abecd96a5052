#include "server/app/control/session_registry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/auth/base32.h"
#include "common/auth/enrolment.h"
#include "common/auth/io/state_directory.h"
#include "common/base/format.h"
#include "common/io/clock.h"

namespace tandem::server {

using rpc::ErrorCode;
using rpc::ErrorReply;

namespace {

constexpr std::size_t kNamedSessions = 8;  // in the text of a rejection
static_assert(kNamedSessions * (rpc::kNameMax + 2) + 200 < rpc::kTextMax);

}  // namespace

// Stops, overload and the end stay visible in a session that is held: they last when the directory answers again.
rpc::SessionPhase phase_of(wire::SessionState state, bool may_act) noexcept {
  switch (state) {
    case wire::SessionState::kWaiting:
      return may_act ? rpc::SessionPhase::kWaiting : rpc::SessionPhase::kHeld;
    case wire::SessionState::kRunning:
    case wire::SessionState::kHeld:  // braked: no seat with authority is engaged, also by a server that may act
      return may_act ? rpc::SessionPhase::kRunning : rpc::SessionPhase::kHeld;
    case wire::SessionState::kPaused:
      return rpc::SessionPhase::kPaused;
    case wire::SessionState::kStopped:
      return rpc::SessionPhase::kStopped;
    case wire::SessionState::kOverloaded:
      return rpc::SessionPhase::kOverloaded;
    case wire::SessionState::kEnding:
      break;
  }
  return rpc::SessionPhase::kEnding;
}

std::string make_session_code() { return auth::session_code(auth::random_bytes<std::array<std::byte, 7>>()); }

std::string code_text(const std::string& code) { return auth::grouped(code, 5); }

void SessionRegistry::add(SessionRegistration opening) {
  entries_.emplace_back(std::move(opening), io::monotonic_now()).number = ++numbers_;
}

void SessionRegistry::add_running(SessionRegistration opening, std::function<void(bool)> done) {
  add(std::move(opening));
  ShardRequest request{.what = ShardRequest::What::kAddSession};
  request.done = [done = std::move(done)](const ShardRequest& added) { done(added.result == JoinResult::kAccepted); };
  post(entries_.back(), std::move(request));
}

void SessionRegistry::remove(const rpc::Id& id, std::function<void()> gone) {
  SessionEntry* const found = find(id);
  if (found == nullptr) return gone();
  found->closing = true;
  rejected_.add(found->session().status());
  requests_.when_idle(found->session(), [this, found, gone = std::move(gone)] {
    entries_.remove_if([&](const SessionEntry& e) { return &e == found; });
    gone();
  });
}

void SessionRegistry::end(const rpc::Id& id, wire::CloseReason why) {
  SessionEntry* const found = find(id);
  if (found == nullptr) return;
  found->given_up = why == wire::CloseReason::kServerReturns;
  post(*found, {.what = ShardRequest::What::kEndSession, .why = why});
}

void SessionRegistry::move(const rpc::Id& id, Shard& to, const io::SteeringProgram& there,
                           const io::SteeringProgram& before, std::function<void(bool)> done) {
  SessionEntry* const found = find(id);
  if (found == nullptr || !found->open()) return done(false);
  ShardRequest request{.what = ShardRequest::What::kMoveSession,
                       .session = &found->session(),
                       .target = &to,
                       .steering = &there,
                       .steering_before = &before};
  request.done = [this, found, done = std::move(done)](const ShardRequest& moved) {
    const bool served = moved.result == JoinResult::kAccepted;
    if (served) found->registration.shard = moved.target, ++moves_;
    done(served);
  };
  requests_.move(*found->registration.shard, std::move(request));
}

RejectedDatagrams SessionRegistry::rejected() const {
  RejectedDatagrams all = rejected_;
  for (const SessionEntry& entry : entries_)
    if (!entry.closing) all.add(entry.session().status());
  return all;
}

void SessionRegistry::post(const SessionEntry& entry, ShardRequest request) {
  request.session = entry.registration.session;
  requests_.post(*entry.registration.shard, std::move(request));
}

const SessionEntry* SessionRegistry::find(const rpc::Id& id) const {
  const auto found =
      std::ranges::find_if(entries_, [&](const SessionEntry& e) { return e.registration.id == id && !e.closing; });
  return found == entries_.end() ? nullptr : &*found;
}

SessionEntry* SessionRegistry::find(const rpc::Id& id) {
  return const_cast<SessionEntry*>(std::as_const(*this).find(id));
}

std::variant<SessionEntry*, ErrorReply> SessionRegistry::choose(const rpc::SessionChoice& choice) {
  const auto* const id = std::get_if<rpc::Id>(&choice);
  const auto* const code = std::get_if<std::string>(&choice);
  std::string names;  // a server may have more sessions than the text of a reply has room for
  std::size_t open = 0;
  SessionEntry* found = id == nullptr ? nullptr : find(*id);
  for (SessionEntry& e : entries_) {
    if (code != nullptr && !e.closing && !e.registration.code.empty() && e.registration.code == *code) found = &e;
    if (!e.open()) continue;
    if (open++ < kNamedSessions) names += (open == 1 ? "" : ", ") + e.registration.name;
    if (id == nullptr && code == nullptr) found = &e;
  }
  if (open > kNamedSessions) names += format(" and %zu more", open - kNamedSessions);
  if (id == nullptr && code == nullptr && open > 1)
    return ErrorReply{ErrorCode::kNoSession,
                      "this server has several sessions: " + names + "; choose one with --session", 0};
  if (found == nullptr && open == 0) return ErrorReply{ErrorCode::kNoSession, "no session is open on this server", 0};
  // A request that names a session by its code is an attempt at the code, whatever other credential it has.
  if (found == nullptr && code != nullptr)
    return ErrorReply{ErrorCode::kCode,
                      "no session on this server has this code (a restarted session has a new code: ask its operator); "
                      "open: " +
                          names,
                      0};
  if (found == nullptr) return ErrorReply{ErrorCode::kNoSession, "this server has no such session; open: " + names, 0};
  if (found->session().over()) return ErrorReply{ErrorCode::kSessionOver, "this session is over", 0};
  return found;
}

rpc::ListedSession SessionRegistry::listed(const SessionEntry& entry) {
  const Time now = io::monotonic_now();
  const SessionStatus status = entry.session().status();
  rpc::ListedSession s{entry.registration.id, entry.registration.name, phase_of(status.state, status.may_act), {}};
  for (std::size_t i = 0; i < entry.seats.size(); ++i) {
    const SeatSpec& seat = entry.scene().seats[i];
    s.seats.push_back({seat.name, access_role(seat.role),
                       status.seats[i].taken || entry.seats[i].joining() || entry.seats[i].reserved(now),
                       seat.required});
  }
  return s;
}

rpc::SessionList SessionRegistry::list(std::uint32_t after) const {
  rpc::SessionList list;
  std::uint32_t last = 0;
  for (const SessionEntry& e : entries_) {
    if (!e.open() || e.number <= after) continue;
    if (list.sessions.size() == rpc::kListedSessionsMax) {
      list.more = true;
      list.last = last;
      break;
    }
    list.sessions.push_back(listed(e));
    last = e.number;
  }
  return list;
}

ServingSpec SessionRegistry::serving() const {
  ServingSpec out;
  for (const SessionEntry& e : entries_) {
    if (e.closing) continue;
    const SessionRegistration& r = e.registration;
    const SessionStatus status = e.session().status();
    const rpc::SessionPhase phase =
        e.session().over() ? rpc::SessionPhase::kEnding : phase_of(status.state, status.may_act);
    OpenSession& session =
        out.sessions.emplace_back(r.id, r.code, r.name, r.epoch, std::vector<OpenSeat>{}, to_text(phase));
    for (std::size_t i = 0; i < e.seats.size(); ++i) {
      const SeatSpec& seat = e.scene().seats[i];
      session.seats.push_back({seat.name, access_role(seat.role), status.seats[i].taken, seat.required});
    }
  }
  return out;
}

rpc::StatusDrain SessionRegistry::drain_progress() const {
  rpc::StatusDrain drain;
  if (const auto due = drain_.due())
    drain.left_s = static_cast<std::uint32_t>(std::max(0.0, std::ceil(seconds(*due - io::monotonic_now()))));
  for (const SessionEntry& e : entries_) {
    if (!e.open()) continue;
    ++drain.sessions;
    const SessionStatus status = e.session().status();
    for (std::size_t i = 0; i < e.seats.size(); ++i) drain.participants += status.seats[i].taken ? 1 : 0;
  }
  return drain;
}

}  // namespace tandem::server
