#pragma once

#include <cmath>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::control {

/// Releases a hand that moves faster than any intended motion (ARCHITECTURE.md, invariant 48). Damping replaces force.
/// After the third trip only the participant at the device can enable it again. The driver's guard has its own, higher
/// limit.
class OverspeedGuard {
 public:
  static constexpr double kSpeedMax = 1.5;  ///< of the tip [m/s]
  static constexpr unsigned kSamples = 3;   ///< consecutive; a single one may be a glitch of a differentiated encoder
  static constexpr Duration kCalm =
      std::chrono::milliseconds(200);       ///< time below the limit before the hand may engage again
  static constexpr unsigned kTripsMax = 3;  ///< trips until the guard latches

  /// @param speed  of the tip [m/s]; NaN counts as too fast  @param active  force may reach the hand
  void update(Time now, double speed, bool active) noexcept TANDEM_REALTIME {
    const bool fast = !(speed <= kSpeedMax);
    fast_ = fast ? fast_ + 1 : 0;
    if (fast) last_fast_ = now;
    if (tripped_ && !fast && now - last_fast_ >= kCalm) tripped_ = false;
    if (tripped_ || !active || fast_ < kSamples) return;
    tripped_ = true;
    ++trips_;
  }
  /// The participant pressed the button that clears latched states.
  void reset() noexcept { trips_ = 0; }

  /// True if this hand must not engage.
  [[nodiscard]] bool inhibits() const noexcept { return tripped_ || latched(); }
  /// True after kTripsMax trips, until `reset`.
  [[nodiscard]] bool latched() const noexcept { return trips_ >= kTripsMax; }
  [[nodiscard]] unsigned trips() const noexcept { return trips_; }  ///< since the last reset

 private:
  unsigned fast_ = 0, trips_ = 0;
  Time last_fast_{};
  bool tripped_ = false;
};

}  // namespace tandem::control
