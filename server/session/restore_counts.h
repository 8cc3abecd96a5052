#pragma once

#include <cstdint>

namespace tandem::server {

/// How often a session was restored from a snapshot. Numbers of stops (StopLatch::stops) count restores too, because
/// each of them needs a number that a resume can name; this tells them apart.
struct RestoreCounts {
  std::uint32_t restarts = 0;  ///< its server died, or a server that belongs to no service was started again
  std::uint32_t moves = 0;     ///< its server handed it over to another one: a move, a drain or a gentle end
  /// Numbers of stops that no stop took: of restores after the begin, and of stops that were raised again after them.
  std::uint32_t numbers = 0;
  friend bool operator==(const RestoreCounts&, const RestoreCounts&) = default;
};

}  // namespace tandem::server
