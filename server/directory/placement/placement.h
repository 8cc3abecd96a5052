#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/rng.h"

namespace tandem::directory {

/// A server as placement sees it, from its published record.
struct Candidate {
  std::string server, zone;
  double capacity = 0;  ///< [cores]
  double used = 0;      ///< [cores]
  bool drains = false;
};

/// A session of the server that plans moves.
struct PlacedSession {
  std::string session;
  double cost = 0;  ///< measured processor time of its ticks [cores]
};

struct PlannedMove {
  std::string session, server;
};

/// Places sessions by free capacity and the measured cost of their ticks. Pure.
///
/// Of two candidates drawn at random the one takes the session that is then used less, as a share of its capacity. All
/// servers decide by records that are some seconds old; if each chose the emptiest server, all would choose the same.
/// Source [Mitzenmacher 2001]: "The Power of Two Choices in Randomized Load Balancing", IEEE TPDS 12(10).
class Placement {
 public:
  explicit Placement(RandomKey key) noexcept : draws_(key) {}

  /// Returns the server for a session, or nothing if none has room.
  [[nodiscard]] std::optional<std::string> place(std::span<const Candidate> candidates, double cost);
  /// Returns the standby for a session: not its owner, and in another zone than the owner if any such has room.
  [[nodiscard]] std::optional<std::string> place_standby(std::span<const Candidate> candidates, double cost,
                                                         std::string_view owner);
  /// Plans moves away from `own`, at most `most`, while its use is more than kMoveAbove times the mean of all servers,
  /// or while it drains. No move makes the target's use higher than the mean.
  [[nodiscard]] std::vector<PlannedMove> plan_moves(std::span<const Candidate> candidates, std::string_view own,
                                                    std::span<const PlacedSession> sessions, std::size_t most);

  /// Use, as a multiple of the mean, above which a server moves sessions away.
  static constexpr double kMoveAbove = 1.08;

 private:
  [[nodiscard]] std::optional<std::size_t> choose(std::span<const Candidate> candidates,
                                                  const std::vector<std::size_t>& fitting, double cost);
  RandomStream draws_;
};

/// Use of all servers together, as a share of their capacity; 0 without capacity.
[[nodiscard]] double mean_use(std::span<const Candidate> candidates) noexcept;

}  // namespace tandem::directory
