#include "server/service/session_moves.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "proto/rpc/rpc_limits.h"

namespace tandem::server {

namespace {

/// Steps after which all that was published before the hand-over is known here.
constexpr int kStepsUntilMove = 2;
constexpr Duration kLookInterval = std::chrono::milliseconds(250);
constexpr Duration kStandbyCheck = std::chrono::seconds(1);
constexpr Duration kStandbyPause = std::chrono::seconds(2);  // between two attempts to name a standby
/// For the last snapshot of a session that moves. A directory without space stores none, and keeps the leases.
constexpr Duration kWritingMax = std::chrono::seconds(5);

std::string words(directory::PlannedMove::Why why) {
  switch (why) {
    case directory::PlannedMove::Why::kDrain:
      return "because this server drains";
    case directory::PlannedMove::Why::kSpread:
      return "because it waits for people, and that server has fewer sessions";
    case directory::PlannedMove::Why::kStrain:
      return "because this server is busier than others";
  }
  return {};
}

}  // namespace

void SessionMoves::step(Time now, const directory::ServerRecord& own) {
  follow_orders();
  if (now >= next_look_) {
    next_look_ = now + kLookInterval;
    candidates_ = candidates(own);
    balance(now, own);
  }
  for (auto& [session, entry] : sessions_.entries()) {
    if (entry.session.is_open()) choose_standby(now, session, entry, own);
    if (entry.session.phase() == MemberSession::Phase::kMoving) advance(now, session, entry);
  }
}

/// Follows the keys `move` of the catalogue. The owner answers by emptying the key.
void SessionMoves::follow_orders() {
  const ServiceCatalogue& catalogue = directory_.catalogue;
  const ServiceKeys& keys = directory_.keys;
  if (orders_seen_ == catalogue.version() || !directory_.writer.problem().empty()) return;
  orders_seen_ = catalogue.version();
  for (const auto& [session, seen] : catalogue.entries()) {
    const auto found = sessions_.entries().find(session);
    if (seen.move_to.empty() || found == sessions_.entries().end() || !found->second.session.is_open()) continue;
    Entry& entry = found->second;
    const directory::Revision revision = entry.session.revision();
    directory_.writer.set(session, keys.move(session), "", revision);
    if (seen.move_to == ServiceKeys::kAnyServer) {
      directory_.writer.set(session, keys.home(session), "", revision);
      continue;
    }
    const bool here = seen.move_to == directory_.server();
    if (!here && directory_.ownership.view().server(seen.move_to) == nullptr) continue;
    directory_.writer.set(session, keys.home(session), seen.move_to, revision);
    if (!here) begin(session, entry, seen.move_to, "by order of an operator");
  }
}

void SessionMoves::set_loads(const std::vector<SessionLoad>& loads) {
  auto& entries = sessions_.entries();
  for (const SessionLoad& load : loads)
    if (const auto found = entries.find(load.session); found != entries.end()) found->second.move.load = load;
}

/// One move at a time. A server that drains moves its sessions even if it does not balance.
void SessionMoves::balance(Time now, const directory::ServerRecord& own) {
  auto& entries = sessions_.entries();
  if (entries.empty() || !(balances_ || own.drains)) return;
  if (!directory_.ready() || !directory_.writer.problem().empty()) return;
  std::vector<directory::PlacedSession> placed;
  for (const auto& [session, entry] : entries) {
    if (entry.session.phase() == MemberSession::Phase::kMoving) return;
    const auto& load = entry.move.load;
    if (!entry.session.is_open() || !load) continue;
    const auto seen = directory_.catalogue.entries().find(session);
    const bool pinned = seen != directory_.catalogue.entries().end() && seen->second.home == directory_.server();
    placed.push_back({session, load->cost, load->expected, load->waiting, pinned, entry.opened});
  }
  std::vector<directory::Candidate> targets = candidates_;
  for (directory::Candidate& target : targets) target.closed = target.closed || !targets_.takes(now, target.server);
  const auto move = planner_.step(now, targets, directory_.server(), placed);
  if (move)
    begin(move->session, entries.find(move->session)->second, move->server, words(move->why),
          move->why == directory::PlannedMove::Why::kSpread);
}

void SessionMoves::begin(const std::string& session, Entry& entry, const std::string& server, const std::string& why,
                         bool waits) {
  entry.move.target = server;
  entry.move.steps_until_move = -1;
  entry.move.handed_over.reset();
  sessions_.hand_over(session, entry, "MOVES to server " + server + ", " + why, waits);
}

void SessionMoves::on_kept(const std::string& session) {
  const auto found = sessions_.entries().find(session);
  if (found == sessions_.entries().end() || found->second.session.phase() != MemberSession::Phase::kMoving) return;
  found->second.session.set_phase(MemberSession::Phase::kOpen);
  orders_seen_ = 0;  // one for it may have come meanwhile
}

void SessionMoves::on_released(Time now, const std::string& session) {
  const auto found = sessions_.entries().find(session);
  if (found != sessions_.entries().end() && found->second.session.phase() == MemberSession::Phase::kMoving)
    targets_.on_sent(now, session, found->second.move.target);
}

void SessionMoves::on_handed_over(Time now, const std::string& session) {
  const auto found = sessions_.entries().find(session);
  if (found == sessions_.entries().end() || found->second.session.phase() != MemberSession::Phase::kMoving) return;
  found->second.move.steps_until_move = kStepsUntilMove;
  found->second.move.handed_over = now;
  ++begun_;
}

void SessionMoves::advance(Time now, const std::string& session, Entry& entry) {
  if (entry.move.steps_until_move < 0) return;
  const bool uses = directory_.tickets.uses_wait(session);
  if (uses) {
    entry.move.steps_until_move = kStepsUntilMove;  // the ticket is restored then: its client joins elsewhere
  } else if (entry.move.steps_until_move > 0) {
    --entry.move.steps_until_move;
    return;
  }
  // The last snapshot, and the tickets of consoles.
  if (uses || directory_.writer.pending(session) || directory_.tickets.restoring(session)) {
    if (now - *entry.move.handed_over < kWritingMax) return;
    entry.move.steps_until_move = -1;
    return entry.session.open_again();
  }
  entry.move.steps_until_move = -1;
  if (!directory_.ownership.move(session, entry.move.target)) entry.session.open_again();
}

void SessionMoves::on_standby_refused(Time now, const std::string& session, const std::string& refused) {
  const auto found = sessions_.entries().find(session);
  if (found == sessions_.entries().end()) return;
  Entry& entry = found->second;
  entry.move.next_standby = now + kStandbyPause;
  if (entry.session.phase() == MemberSession::Phase::kMoving && entry.move.handed_over && refused == entry.move.target)
    entry.session.open_again();
}

void SessionMoves::choose_standby(Time now, const std::string& session, Entry& entry,
                                  const directory::ServerRecord& own) {
  if (now < entry.move.next_standby) return;
  entry.move.next_standby = now + kStandbyCheck;
  const auto* const seen = directory_.ownership.view().session(session);
  if (seen == nullptr || !seen->owner) return;
  const double cost = own.used / static_cast<double>(std::max<std::size_t>(sessions_.open(), 1));
  const std::string present = seen->standby ? seen->standby->name : "";
  if (const auto chosen = placement_.place_standby(candidates_, cost, directory_.server(), present))
    static_cast<void>(directory_.ownership.set_standby(session, *chosen));
}

std::vector<directory::Candidate> SessionMoves::candidates(const directory::ServerRecord& own) const {
  std::map<std::string_view, std::size_t> owned;
  for (const auto& [session, seen] : directory_.ownership.view().sessions())
    if (seen.owner) ++owned[seen.owner->name];
  std::vector<directory::Candidate> candidates;
  for (const auto& [name, published] : directory_.members()) {
    const directory::ServerRecord& record = name == directory_.server() ? own : published;
    candidates.push_back({name, record.zone, record.capacity, record.used, record.drains, record.expected,
                          owned[name] >= rpc::kSessionsMax});
  }
  return candidates;
}

}  // namespace tandem::server
