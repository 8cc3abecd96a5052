#pragma once

#include <array>

namespace tandem {

/// How a SpaceMouse's deflection becomes a velocity; after validation. Axes: x y z, then turns about them.
struct SpaceMouseSpec {
  double speed = 0.1;  ///< at full deflection [m/s]
  double turn = 0.5;   ///< at full deflection [rad/s]
  /// Counts of full deflection. The descriptor says 350, real units reach 400 to 500; more than full is full.
  std::array<double, 6> full{350, 350, 350, 350, 350, 350};
  /// -1: this unit counts the other way round than others of its kind.
  std::array<int, 6> sign{1, 1, 1, 1, 1, 1};
};

}  // namespace tandem
