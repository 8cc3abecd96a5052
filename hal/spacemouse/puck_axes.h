#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/spacemouse/products.h"

namespace tandem::hal::spacemouse {

/// Which count of a report moves which axis of the HAL, and which way, before what a person's file says (SpaceMouseSpec).
///   most pucks: x right, y towards the user, z down; turns right-handed about these.
///   c603, c606, c640 (SpaceMouse Plus XT, SpaceMouse Classic, NuLOOQ): x right, y up, z away from the user.
/// Source: spacenavd, src/dev.c: it swaps and inverts y and z, turns likewise, for all USB pucks but these three.
struct PuckAxes {
  std::array<std::size_t, 3> from{0, 1, 2};  ///< of the three counts of a report, for HAL x, y, z
  std::array<int, 3> sign{1, -1, -1};
};

[[nodiscard]] constexpr PuckAxes axes_of(std::uint16_t vendor, std::uint16_t product) noexcept {
  const bool upright = vendor == kLogitech && (product == 0xC603 || product == 0xC606 || product == 0xC640);
  return upright ? PuckAxes{{0, 2, 1}, {1, 1, 1}} : PuckAxes{};
}

}  // namespace tandem::hal::spacemouse
