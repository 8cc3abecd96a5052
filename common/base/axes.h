#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// Marks functions that may run within a tick: no heap, no lock, no log, no clock, no exception.
#define TANDEM_REALTIME

namespace tandem {

/// Bounds of a scene. All per-tick data are arrays of these sizes, used up to the scene's own count.
inline constexpr std::size_t kAxesMax = 7;
/// Largest number of MASTER seats.
inline constexpr std::size_t kMastersMax = 16;
/// Largest number of tools.
inline constexpr std::size_t kToolsMax = 8;
/// Masters plus the slaves that have seats of their own.
inline constexpr std::size_t kSeatsMax = kMastersMax + kToolsMax;

/// One number per axis of a port: joint space [rad, rad/s, N m] or tip space [m, m/s, N].
using AxisArray = std::array<double, kAxesMax>;
/// One energy per axis [nJ]. Unsigned and cumulative, so loss, duplication and reordering only make it older.
using EnergyArray = std::array<std::uint64_t, kAxesMax>;

/// Calls `work` with each axis in use, in ascending order. The loop over three axes, the usual number, is written out
/// by the compiler: without counter and branch it takes a third fewer instructions.
template <class Work>
[[gnu::always_inline]] constexpr void each_axis(std::size_t axes, Work&& work) noexcept {
  if (axes == 3) [[likely]] {
#pragma GCC unroll 3
    for (std::size_t a = 0; a < 3; ++a) work(a);
  } else {
    for (std::size_t a = 0; a < axes; ++a) work(a);
  }
}

}  // namespace tandem
