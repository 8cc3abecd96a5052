#pragma once

#include <cstdint>

namespace tandem::server {

/// Turn that recurs every `interval` ticks. Turns of different phases with the same interval begin at different ticks,
/// so that no tick carries the work of all sessions of a shard.
class StaggeredTurn {
 public:
  /// Sets the phase [ticks]: turns begin at ticks t with (t + phase) divisible by the interval.
  void set_phase(std::uint32_t phase) noexcept {
    phase_ = phase;
    interval_ = 0;
  }
  /// Whether a turn begins at this tick. After missed ticks it begins late, once.
  /// @param tick      number of the tick; grows, may skip numbers
  /// @param interval  [ticks], at least 1; another one than at the last call takes effect at once
  [[nodiscard]] bool begins(std::uint32_t tick, std::uint32_t interval) noexcept {
    if (interval != interval_) {
      interval_ = interval;
      next_ = tick + (interval - (tick + phase_) % interval) % interval;
    }
    if (next_ - tick - 1 < interval) return false;  // also right after any number of ticks without a call
    next_ = tick + interval - (tick + phase_) % interval;
    return true;
  }

 private:
  std::uint32_t phase_ = 0, interval_ = 0, next_ = 0;
};

}  // namespace tandem::server
