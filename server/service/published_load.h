#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

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

/// Load with which a server is full [cores]. A thread fills at most one processor.
/// @param busy        share of its time that a thread may work [1]
/// @param processors  that the server may use, at least 1
/// @param threads     that tick sessions; a server without one adds it with its first session
[[nodiscard]] inline double published_capacity(double busy, unsigned processors, std::size_t threads) noexcept {
  return busy * static_cast<double>(std::clamp<std::size_t>(threads, 1, processors));
}

}  // namespace tandem::server
