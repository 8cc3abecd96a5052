#pragma once

#include <array>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "hal/core/device.h"
#include "hal/drivers/spacemouse/spacemouse_axes.h"
#include "proto/spec/spacemouse_spec.h"

namespace tandem::hal::spacemouse {

/// Commanded velocity of a SpaceMouse: the value of the last report, held for 50 ms without a new report of these three
/// axes. It then fades to zero within another 50 ms.
/// A SpaceMouse sends nothing at rest, and nothing after its cable or battery failed. Missing reports alone therefore
/// mean neither zero nor continued motion.
class SpaceMouseMotion {
 public:
  static constexpr Duration kHold = std::chrono::milliseconds{50}, kFade = std::chrono::milliseconds{50};

  explicit SpaceMouseMotion(const SpaceMouseSpec& scaling = {}, const SpaceMouseAxes& axes = {}) noexcept
      : scaling_(scaling), axes_(axes) {}

  void reset() noexcept { shift_ = turn_ = {}; }
  void update_translation(Time at, const std::array<std::int16_t, 3>& counts) noexcept {
    shift_ = {at, scaled(counts, 0), true};
  }
  void update_rotation(Time at, const std::array<std::int16_t, 3>& counts) noexcept {
    turn_ = {at, scaled(counts, 3), true};
  }

  [[nodiscard]] Vec3 velocity(Time now) const noexcept TANDEM_REALTIME { return share(shift_, now) * shift_.value; }
  [[nodiscard]] Vec3 angular_velocity(Time now) const noexcept TANDEM_REALTIME {
    return share(turn_, now) * turn_.value;
  }
  /// Returns whether translation or rotation had no report for longer than kHold, or never one.
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
  SpaceMouseAxes axes_;
  Axes shift_, turn_;
};

}  // namespace tandem::hal::spacemouse
