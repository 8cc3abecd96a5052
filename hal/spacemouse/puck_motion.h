#pragma once

#include <array>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "hal/device.h"

namespace tandem::hal::spacemouse {

/// How a deflection becomes a velocity.
struct PuckScaling {
  double speed = 0.1;  ///< at full deflection [m/s]
  double turn = 0.5;   ///< at full deflection [rad/s]
  /// Counts of full deflection: x y z rx ry rz. The descriptor says 350, real units reach 400 to 500; more than full is full.
  std::array<double, 6> full{350, 350, 350, 350, 350, 350};
  /// From the maker's frame (x right, y towards the user, z down, turns right-handed about these) to the HAL's. Turning
  /// that frame half a circle about x is all it takes; a table, because units differ.
  std::array<int, 6> sign{1, -1, -1, 1, -1, -1};
};

/// Velocity that a puck asks for: right after a report what it said; held for 50 ms without news of these three axes, then
/// fading to zero within another 50 ms. A puck that came to rest falls silent, and so does one whose cable or battery
/// died: silence alone is neither zero nor go on.
class PuckMotion {
 public:
  static constexpr Duration kHold = std::chrono::milliseconds{50}, kFade = std::chrono::milliseconds{50};

  explicit PuckMotion(const PuckScaling& scaling = {}) noexcept : scaling_(scaling) {}

  void rest() noexcept { shift_ = turn_ = {}; }
  void take_shift(Time at, const std::array<std::int16_t, 3>& counts) noexcept { shift_ = {at, scaled(counts, 0), true}; }
  void take_turn(Time at, const std::array<std::int16_t, 3>& counts) noexcept { turn_ = {at, scaled(counts, 3), true}; }

  [[nodiscard]] Vec3 velocity(Time now) const noexcept TANDEM_REALTIME { return share(shift_, now) * shift_.value; }
  [[nodiscard]] Vec3 turning(Time now) const noexcept TANDEM_REALTIME { return share(turn_, now) * turn_.value; }
  /// No news of shift or of turn for longer than they are held, or never any.
  [[nodiscard]] bool stale(Time now) const noexcept {
    return !shift_.known || !turn_.known || now - shift_.at > kHold || now - turn_.at > kHold;
  }

 private:
  struct Axes {
    Time at{};
    Vec3 value = Vec3::Zero();
    bool known = false;
  };
  [[nodiscard]] Vec3 scaled(const std::array<std::int16_t, 3>& counts, std::size_t first) const noexcept;
  [[nodiscard]] static double share(const Axes& axes, Time now) noexcept;

  PuckScaling scaling_;
  Axes shift_, turn_;
};

}  // namespace tandem::hal::spacemouse
