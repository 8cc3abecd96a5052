#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/drivers/spacemouse/products.h"

namespace tandem::hal::spacemouse {

/// Mapping of the counts of a report to the axes of the HAL, before the scaling of the user's device file
/// (SpaceMouseSpec).
///   most products: x right, y towards the user, z down; rotations right-handed about these.
///   c603, c606, c640 (SpaceMouse Plus XT, SpaceMouse Classic, NuLOOQ): x right, y up, z away from the user.
/// Source: spacenavd, src/dev.c. It swaps and inverts y and z, for rotations too, for all USB products except these
/// three.
struct SpaceMouseAxes {
  std::array<std::size_t, 3> from{0, 1, 2};  ///< index of the count used for HAL x, y, z
  std::array<int, 3> sign{1, -1, -1};
};

[[nodiscard]] constexpr SpaceMouseAxes axes_of(std::uint16_t vendor, std::uint16_t product) noexcept {
  const bool upright = vendor == kLogitech && (product == 0xC603 || product == 0xC606 || product == 0xC640);
  return upright ? SpaceMouseAxes{{0, 2, 1}, {1, 1, 1}} : SpaceMouseAxes{};
}

}  // namespace tandem::hal::spacemouse
