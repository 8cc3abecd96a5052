#pragma once

#include <array>

namespace tandem {

/// Conversion from SpaceMouse deflection to velocity, after validation. Axis order: x y z, then rotations about them.
struct SpaceMouseSpec {
  double speed = 0.1;  ///< at full deflection [m/s]
  double turn = 0.5;   ///< at full deflection [rad/s]
  /// Counts at full deflection. The descriptor says 350, real devices reach 400 to 500; larger counts are clamped.
  std::array<double, 6> full{350, 350, 350, 350, 350, 350};
  /// -1: the sign of this axis is inverted on this device.
  std::array<int, 6> sign{1, 1, 1, 1, 1, 1};
};

}  // namespace tandem
