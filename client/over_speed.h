#pragma once

#include <cmath>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::client {

/// A hand that is faster than any meant motion is let go (design notes, security 2.3 and 2.4): damping takes the place of force, and
/// after the third time only the person at the device lets it be engaged again. The driver's guard has a limit of its own above this.
class OverSpeed {
 public:
  static constexpr double kSpeedMax = 1.5;  ///< of the tip [m/s]
  static constexpr unsigned kSamples = 3;   ///< on end: one alone may be a glitch of a differentiated encoder
  static constexpr Duration kCalm = std::chrono::milliseconds(200);  ///< below the limit before the hand may be engaged again
  static constexpr unsigned kTripsMax = 3;

  /// @param speed  of the tip [m/s]; what is no number counts as too fast  @param active  force may reach the hand
  void look(Time now, double speed, bool active) noexcept TANDEM_REALTIME {
    const bool fast = !(speed <= kSpeedMax);
    fast_ = fast ? fast_ + 1 : 0;
    if (fast) last_fast_ = now;
    if (tripped_ && !fast && now - last_fast_ >= kCalm) tripped_ = false;
    if (tripped_ || !active || fast_ < kSamples) return;
    tripped_ = true;
    ++trips_;
  }
  /// The person pressed the button that clears what is latched.
  void reset() noexcept { trips_ = 0; }

  /// This hand may not be engaged.
  [[nodiscard]] bool holds_off() const noexcept { return tripped_ || latched(); }
  [[nodiscard]] bool latched() const noexcept { return trips_ >= kTripsMax; }
  [[nodiscard]] unsigned trips() const noexcept { return trips_; }  ///< since the last reset

 private:
  unsigned fast_ = 0, trips_ = 0;
  Time last_fast_{};
  bool tripped_ = false;
};

}  // namespace tandem::client
