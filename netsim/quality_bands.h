#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "common/base/time.h"

/// What haptic teleoperation asks of a network, as three bands. Limits: section 2 of the project's network notes, drawn
/// from 3GPP TR 22.847 (haptic latency 1-20 ms for high-dynamic, 20-100 ms for other remote control) and from the loss
/// and jitter (both at most 10, in % and ms) that telehaptic studies allow.
namespace tandem::netsim {

enum class Band : std::uint8_t {
  kGreen,  ///< good enough for stiff contact and fast motion
  kAmber,  ///< good enough for slow motion under a passive channel
  kRed,    ///< neither
};
inline constexpr std::size_t kBands = 3;
[[nodiscard]] constexpr const char* name(Band band) noexcept {
  return std::array{"green", "amber", "red"}[static_cast<std::size_t>(band)];
}
[[nodiscard]] constexpr Band worse(Band a, Band b) noexcept { return std::max(a, b); }

/// What is judged in every window.
enum class Measure : std::uint8_t {
  kLoss,       ///< lost of what was sent in the window, share
  kGap,        ///< longest time without an arrival that the window touches
  kJitter,     ///< p99 - p50 of the delay of what arrived in the window
  kRoundTrip,  ///< p99 of the round trips that ended in the window
};
inline constexpr std::size_t kMeasures = 4;
[[nodiscard]] constexpr const char* name(Measure measure) noexcept {
  return std::array{"loss", "gap", "jitter", "round trip"}[static_cast<std::size_t>(measure)];
}

/// Green up to `green`, amber up to `amber`, both included.
struct BandLimits {
  Duration green, amber;
};
inline constexpr BandLimits kGapLimits{std::chrono::milliseconds(5), std::chrono::milliseconds(50)};
inline constexpr BandLimits kJitterLimits{std::chrono::milliseconds(2), std::chrono::milliseconds(10)};
inline constexpr BandLimits kRoundTripLimits{std::chrono::milliseconds(20), std::chrono::milliseconds(100)};
inline constexpr std::uint64_t kLossGreenPerMille = 1, kLossAmberPerMille = 100;

[[nodiscard]] constexpr Band band_of(Duration value, const BandLimits& limits) noexcept {
  return value <= limits.green ? Band::kGreen : value <= limits.amber ? Band::kAmber : Band::kRed;
}
/// @param lost  of `sent`; nothing sent is green
[[nodiscard]] constexpr Band loss_band(std::uint64_t lost, std::uint64_t sent) noexcept {
  const std::uint64_t per_mille = lost * 1000;
  return per_mille <= sent * kLossGreenPerMille   ? Band::kGreen
         : per_mille <= sent * kLossAmberPerMille ? Band::kAmber
                                                  : Band::kRed;
}

/// Windows end every kWindowStep, from the moment one is full on: what a window hides at its edge, the next one shows.
inline constexpr Duration kWindowStep = std::chrono::milliseconds(10);
inline constexpr std::array<std::size_t, 3> kWindowSteps{10, 100, 1000};  ///< 100 ms, 1 s, 10 s
inline constexpr std::size_t kWindows = kWindowSteps.size();
[[nodiscard]] constexpr Duration window_length(std::size_t window) noexcept {
  return kWindowStep * static_cast<std::int64_t>(kWindowSteps[window]);
}

}  // namespace tandem::netsim
