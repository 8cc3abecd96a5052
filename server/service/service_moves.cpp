// Moves of sessions to other servers, by order of an operator.
#include "server/service/service_member.h"

namespace tandem::server {

namespace {

/// Steps after which all that was published before the hand-over is known here.
constexpr int kStepsUntilMove = 2;

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
    if (seen.move_to == options_.server || ownership_.view().server(seen.move_to) == nullptr) continue;
    entry.phase = Phase::kMoving;
    entry.target = seen.move_to;
    entry.steps_until_move = -1;
    events_.push_back({.kind = ServiceEvent::Kind::kHandOver, .session = session, .revision = entry.revision});
  }
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
  if (writer_.pending(session)) return;  // the last snapshot
  entry.steps_until_move = -1;
  if (!ownership_.move(session, entry.target)) entry.phase = Phase::kLoading;
}

}  // namespace tandem::server
