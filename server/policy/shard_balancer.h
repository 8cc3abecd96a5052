#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/base/time.h"
#include "proto/rpc/rpc_limits.h"

namespace tandem::server {

/// Load of a shard's thread.
struct ShardView {
  double tick_hz = 0;
  double load = 0;  ///< processor time of the last second, share of one processor [1]
};
/// A session, and its part in the load of its shard.
struct SessionView {
  std::size_t slot = 0;
  std::size_t shard = 0;
  double cost = 0;  ///< share of one processor [1]
};
/// A session that moves to another shard of its tick rate.
struct SessionMove {
  std::size_t slot = 0, from = 0, to = 0;
  friend bool operator==(const SessionMove&, const SessionMove&) = default;
};

/// Decides which session moves to another shard, when its own is strained and another has room. Sans-I/O.
///
/// A shard is strained from a load of 0.40 on, until it falls below 0.30. When it was strained for 2 s, that session
/// moves which brings the loads of the two shards closest together, without making the target the busier one. The loads
/// must differ by at least 0.10. The pool moves one session per 3 s, and one session once per minute. Each move
/// therefore lowers the greater load, and a changing measurement does not move sessions to and fro.
class ShardBalancer {
 public:
  static constexpr double kStrained = 0.40, kRelaxed = 0.30, kDifference = 0.10;
  static constexpr Duration kStrainedFor = std::chrono::seconds(2), kBetweenMoves = std::chrono::seconds(3),
                            kRest = std::chrono::minutes(1);

  /// @param shards    always in the same order; more may be added at the end
  /// @param sessions  slots below rpc::kSessionsMax; another session in a slot inherits the rest of the former one
  /// @return the move to execute now; nullopt: none
  [[nodiscard]] std::optional<SessionMove> step(Time now, std::span<const ShardView> shards,
                                                std::span<const SessionView> sessions);

 private:
  [[nodiscard]] bool strained_long(Time now, std::size_t shard) const;

  std::vector<std::optional<Time>> strained_since_;  ///< per shard
  std::array<std::optional<Time>, rpc::kSessionsMax> moved_{};
  std::optional<Time> last_move_;
};

/// Returns the shard of this tick rate with the least load; nullopt if none has the rate.
[[nodiscard]] std::optional<std::size_t> least_loaded(std::span<const ShardView> shards, double tick_hz) noexcept;

}  // namespace tandem::server
