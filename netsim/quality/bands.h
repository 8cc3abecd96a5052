#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "common/base/time.h"

/// Requirements of haptic teleoperation on a network, as three quality bands. Source of the limits: section 2 of the
/// project's network notes. They derive from 3GPP TR 22.847 (haptic latency 1-20 ms for high-dynamic, 20-100 ms for
/// other remote control). Loss and jitter limits (both at most 10, in % and ms) come from telehaptic studies.
namespace tandem::netsim {

/// Quality band, best first.
enum class Band : std::uint8_t {
  kGreen,  ///< sufficient for stiff contact and fast motion
  kAmber,  ///< sufficient for slow motion with a passive channel
  kRed,    ///< worse than amber
};
inline constexpr std::size_t kBands = 3;
/// Returns `green`, `amber` or `red`.
[[nodiscard]] constexpr const char* name(Band band) noexcept {
  return std::array{"green", "amber", "red"}[static_cast<std::size_t>(band)];
}
/// Returns the worse of two bands.
[[nodiscard]] constexpr Band worse(Band a, Band b) noexcept { return std::max(a, b); }

/// Measures evaluated in every window.
enum class Measure : std::uint8_t {
  kLoss,       ///< lost share of the datagrams sent in the window
  kGap,        ///< longest time without an arrival that overlaps the window
  kJitter,     ///< p99 - p50 of the delays of datagrams that arrived in the window
  kRoundTrip,  ///< p99 of the round trips that ended in the window
};
inline constexpr std::size_t kMeasures = 4;
[[nodiscard]] constexpr const char* name(Measure measure) noexcept {
  return std::array{"loss", "gap", "jitter", "round trip"}[static_cast<std::size_t>(measure)];
}

/// Limits of a measure: green up to `green`, amber up to `amber`, both inclusive.
struct BandLimits {
  Duration green, amber;
};
inline constexpr BandLimits kGapLimits{std::chrono::milliseconds(5), std::chrono::milliseconds(50)};
inline constexpr BandLimits kJitterLimits{std::chrono::milliseconds(2), std::chrono::milliseconds(10)};
inline constexpr BandLimits kRoundTripLimits{std::chrono::milliseconds(20), std::chrono::milliseconds(100)};
inline constexpr std::uint64_t kLossGreenPerMille = 1, kLossAmberPerMille = 100;

/// Returns the band of a value.
[[nodiscard]] constexpr Band band_of(Duration value, const BandLimits& limits) noexcept {
  return value <= limits.green ? Band::kGreen : value <= limits.amber ? Band::kAmber : Band::kRed;
}
/// Returns the band of a loss.
/// @param lost  number of the `sent` datagrams that were lost; sent = 0 gives green
[[nodiscard]] constexpr Band loss_band(std::uint64_t lost, std::uint64_t sent) noexcept {
  const std::uint64_t per_mille = lost * 1000;
  return per_mille <= sent * kLossGreenPerMille   ? Band::kGreen
         : per_mille <= sent * kLossAmberPerMille ? Band::kAmber
                                                  : Band::kRed;
}

/// A window ends every kWindowStep, from the time when the first one is full. Overlap prevents events at window edges
/// from being missed.
inline constexpr Duration kWindowStep = std::chrono::milliseconds(10);
inline constexpr std::array<std::size_t, 3> kWindowSteps{10, 100, 1000};  ///< 100 ms, 1 s, 10 s
inline constexpr std::size_t kWindows = kWindowSteps.size();
/// Returns the length of window number `window` in [0, kWindows).
[[nodiscard]] constexpr Duration window_length(std::size_t window) noexcept {
  return kWindowStep * static_cast<std::int64_t>(kWindowSteps[window]);
}

}  // namespace tandem::netsim
