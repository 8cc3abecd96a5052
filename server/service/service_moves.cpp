// Moves of sessions to other servers: by order of an operator, and to spread the load.
#include <algorithm>

#include "server/service/service_member.h"

namespace tandem::server {

namespace {

/// Steps after which all that was published before the hand-over is known here.
constexpr int kStepsUntilMove = 2;
constexpr Duration kBalanceInterval = std::chrono::milliseconds(250);

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

/// Follows the keys `move` of the catalogue. The owner answers by emptying the key.
void ServiceMember::begin_moves() {
  if (moves_seen_ == catalogue_.version()) return;
  moves_seen_ = catalogue_.version();
  for (const auto& [session, seen] : catalogue_.entries()) {
    const auto found = entries_.find(session);
    if (seen.move_to.empty() || found == entries_.end() || found->second.phase != Phase::kOpen) continue;
    Entry& entry = found->second;
    writer_.set(session, keys_.move(session), "", entry.revision);
    if (seen.move_to == ServiceKeys::kAnyServer) {
      writer_.set(session, keys_.home(session), "", entry.revision);
      continue;
    }
    if (seen.move_to != options_.server && ownership_.view().server(seen.move_to) == nullptr) continue;
    writer_.set(session, keys_.home(session), seen.move_to, entry.revision);
    if (seen.move_to != options_.server) begin_move(session, entry, seen.move_to, "by order of an operator");
  }
}

void ServiceMember::set_loads(const std::vector<SessionLoad>& loads) {
  for (const SessionLoad& load : loads)
    if (const auto found = entries_.find(load.session); found != entries_.end()) found->second.load = load;
}

/// One move at a time. A server that drains moves its sessions even if it does not balance.
void ServiceMember::balance(Time now) {
  if (now < next_balance_ || entries_.empty() || !(options_.balance || record_.drains)) return;
  next_balance_ = now + kBalanceInterval;
  if (!ownership_.keeper().registered() || !ownership_.view().follows() || !catalogue_.follows()) return;
  std::vector<directory::PlacedSession> placed;
  for (const auto& [session, entry] : entries_) {
    if (entry.phase == Phase::kMoving) return;
    if (entry.phase != Phase::kOpen || !entry.load) continue;
    const auto seen = catalogue_.entries().find(session);
    const bool pinned = seen != catalogue_.entries().end() && seen->second.home == options_.server;
    placed.push_back({session, entry.load->cost, entry.load->expected, entry.load->waiting, pinned, entry.opened});
  }
  const auto move = planner_.step(now, candidates(), options_.server, placed);
  if (move) begin_move(move->session, entries_.find(move->session)->second, move->server, words(move->why));
}

void ServiceMember::begin_move(const std::string& session, Entry& entry, const std::string& server, std::string why) {
  entry.phase = Phase::kMoving;
  entry.target = server;
  entry.steps_until_move = -1;
  ++moves_;
  events_.push_back({.kind = ServiceEvent::Kind::kHandOver,
                     .session = session,
                     .revision = entry.revision,
                     .text = "MOVES to server " + server + ", " + std::move(why)});
}

void ServiceMember::on_handed_over(const std::string& session) {
  const auto found = entries_.find(session);
  if (found != entries_.end() && found->second.phase == Phase::kMoving)
    found->second.steps_until_move = kStepsUntilMove;
}

void ServiceMember::advance_move(const std::string& session, Entry& entry) {
  if (entry.steps_until_move < 0) return;
  if (entry.steps_until_move > 0) {
    --entry.steps_until_move;
    return;
  }
  if (writer_.pending(session) || tickets_.restoring(session)) return;  // the last snapshot; tickets of consoles
  entry.steps_until_move = -1;
  if (!ownership_.move(session, entry.target)) entry.phase = Phase::kLoading;
}

}  // namespace tandem::server
