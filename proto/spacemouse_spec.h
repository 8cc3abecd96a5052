#pragma once

#include <array>

namespace tandem {

/// How a SpaceMouse's deflection becomes a velocity; after validation. Axes: x y z, then turns about them.
struct SpaceMouseSpec {
  double speed = 0.1;  ///< at full deflection [m/s]
  double turn = 0.5;   ///< at full deflection [rad/s]
  /// Counts of full deflection. The descriptor says 350, real units reach 400 to 500; more than full is full.
  std::array<double, 6> full{350, 350, 350, 350, 350, 350};
  /// From the maker's frame (x right, y towards the user, z down, turns right-handed about these) to the HAL's. Turning
  /// that frame half a circle about x is all it takes; a table, because units differ.
  std::array<int, 6> sign{1, -1, -1, 1, -1, -1};
};

}  // namespace tandem
