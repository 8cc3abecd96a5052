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
  double expected = 0;  ///< processor time when all seats of its sessions are taken [cores]
  bool closed = false;  ///< gets no session for now, although it does not drain
};

/// The server may get a further session, if there is room for its cost.
[[nodiscard]] inline bool takes_sessions(const Candidate& server) noexcept {
  return !server.drains && !server.closed && server.capacity > 0;
}

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
  /// @param present  the standby that it has, which is replaced only if it drains, or if it is in the owner's zone and
  ///                 a server in another one has room; empty: none
  /// @return nothing: none has room, or the present one stays
  [[nodiscard]] std::optional<std::string> place_standby(std::span<const Candidate> candidates, double cost,
                                                         std::string_view owner, std::string_view present = {});
  /// Of two candidates drawn at random from those in `fitting`, returns the one that is then used less.
  /// @param fitting  indices of `candidates`  @return its index; nothing: none fits
  [[nodiscard]] std::optional<std::size_t> less_used_of_two(std::span<const Candidate> candidates,
                                                            const std::vector<std::size_t>& fitting, double cost);

 private:
  RandomStream draws_;
};

/// Use of all servers together, as a share of their capacity; 0 without capacity.
[[nodiscard]] double mean_use(std::span<const Candidate> candidates) noexcept;

}  // namespace tandem::directory
