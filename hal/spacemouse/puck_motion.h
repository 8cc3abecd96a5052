#pragma once

#include <array>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "hal/device.h"
#include "hal/spacemouse/puck_axes.h"
#include "proto/spacemouse_spec.h"

namespace tandem::hal::spacemouse {

/// Velocity that a puck asks for: right after a report what it said; held for 50 ms without news of these three axes, then
/// fading to zero within another 50 ms. A puck that came to rest falls silent, and so does one whose cable or battery
/// died: silence alone is neither zero nor go on.
class PuckMotion {
 public:
  static constexpr Duration kHold = std::chrono::milliseconds{50}, kFade = std::chrono::milliseconds{50};

  explicit PuckMotion(const SpaceMouseSpec& scaling = {}, const PuckAxes& axes = {}) noexcept : scaling_(scaling), axes_(axes) {}

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

  SpaceMouseSpec scaling_;
  PuckAxes axes_;
  Axes shift_, turn_;
};

}  // namespace tandem::hal::spacemouse
