#include "hal/drivers/spacemouse/spacemouse_motion.h"

#include <algorithm>

namespace tandem::hal::spacemouse {

Vec3 SpaceMouseMotion::scaled(const std::array<std::int16_t, 3>& counts, std::size_t first) const noexcept {
  Vec3 out;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t axis = first + i;
    const double deflection = std::clamp(counts[axes_.from[i]] / scaling_.full[axis], -1.0, 1.0);
    out[static_cast<int>(i)] =
        axes_.sign[i] * scaling_.sign[axis] * deflection * (axis < 3 ? scaling_.speed : scaling_.turn);
  }
  return out;
}

double SpaceMouseMotion::share(const Axes& axes, Time now) noexcept {
  const Duration silent = now - axes.at;
  if (silent <= kHold) return 1.0;
  return std::max(0.0, 1.0 - seconds(silent - kHold) / seconds(kFade));
}

}  // namespace tandem::hal::spacemouse
