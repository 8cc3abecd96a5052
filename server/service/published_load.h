#pragma once

#include <cmath>

namespace tandem::server {

/// Load that a server publishes [cores]: a multiple of kStep near the measured one. It stays while the measured load is
/// within kKept of it, so that a load between two multiples does not change it each second, in lists and in the
/// directory.
/// @param published  the one before
[[nodiscard]] inline double published_load(double published, double measured) noexcept {
  constexpr double kStep = 0.05;
  constexpr double kKept = 0.04;  // less than a step, so that an idle server has no load
  return std::abs(measured - published) <= kKept ? published : kStep * std::round(measured / kStep);
}

}  // namespace tandem::server
