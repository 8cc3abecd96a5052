#include "server/policy/shard_balancer.h"

namespace tandem::server {

std::optional<SessionMove> ShardBalancer::step(Time now, std::span<const ShardView> shards,
                                               std::span<const SessionView> sessions) {
  strained_since_.resize(shards.size());
  for (std::size_t i = 0; i < shards.size(); ++i) {
    if (shards[i].load < kRelaxed) strained_since_[i].reset();
    if (shards[i].load >= kStrained && !strained_since_[i]) strained_since_[i] = now;
  }
  if (last_move_ && now - *last_move_ < kBetweenMoves) return std::nullopt;

  std::optional<SessionMove> best;
  double strain = 0, rest = 0;  // of the best move: load of its shard before and after
  for (const SessionView& session : sessions) {
    const ShardView& from = shards[session.shard];
    if (!strained_long(now, session.shard) || from.load < kStrained || session.cost <= 0) continue;
    if (moved_[session.slot] && now - *moved_[session.slot] < kRest) continue;
    const std::size_t to = *least_loaded(shards, from.tick_hz);
    const double left = from.load - session.cost;
    if (from.load - shards[to].load < kDifference || shards[to].load + session.cost > left) continue;
    if (best && (from.load < strain || (from.load == strain && left >= rest))) continue;
    best = SessionMove{session.slot, session.shard, to};
    strain = from.load;
    rest = left;
  }
  if (!best) return std::nullopt;
  moved_[best->slot] = last_move_ = now;
  return best;
}

bool ShardBalancer::strained_long(Time now, std::size_t shard) const {
  return strained_since_[shard] && now - *strained_since_[shard] >= kStrainedFor;
}

std::optional<std::size_t> least_loaded(std::span<const ShardView> shards, double tick_hz) noexcept {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < shards.size(); ++i)
    if (shards[i].tick_hz == tick_hz && (!best || shards[i].load < shards[*best].load)) best = i;
  return best;
}

}  // namespace tandem::server
