#pragma once

#include <array>
#include <cstdint>

#include "common/base/time.h"
#include "netsim/quality/bands.h"

/// Results of LinkQuality and LinkMonitor.
namespace tandem::netsim {

/// Results of one measure over all windows of one length.
struct MeasureSummary {
  std::array<std::uint64_t, kBands> windows{};  ///< number of judged windows, by band
  double worst = 0;                             ///< loss: share in [0, 1]; other measures: [s]
  Time worst_at;                                ///< end of the first window with the worst value
};

/// Results of all windows of one length. A window is judged if a datagram was sent or arrived in it.
struct WindowSummary {
  Duration length{};
  std::uint64_t windows = 0;                  ///< number of judged windows
  std::array<std::uint64_t, kBands> bands{};  ///< number of judged windows, by the worst band of their measures
  std::array<MeasureSummary, kMeasures> measures{};

  [[nodiscard]] const MeasureSummary& of(Measure m) const noexcept { return measures[static_cast<std::size_t>(m)]; }
  /// Returns the share of judged windows in this band, in [0, 1]; 0 without windows.
  [[nodiscard]] double share(Band band) const noexcept {
    return windows > 0 ? static_cast<double>(bands[static_cast<std::size_t>(band)]) / static_cast<double>(windows) : 0;
  }
};
using WindowSummaries = std::array<WindowSummary, kWindows>;

/// Summary of delays. Quantile resolution: 1 us below 1 ms, 10 us below 10 ms, 0.1 ms below 100 ms, 0.5 ms below 1 s, 1
/// % above. Quantiles never exceed the true value.
struct DelaySummary {
  std::uint64_t count = 0;
  double mean_s = 0;
  Duration p5{}, p50{}, p95{}, p99{}, max{};

  [[nodiscard]] Duration jitter() const noexcept { return p99 - p50; }
};

/// Age of information: time since the newest received datagram was sent. Statistics are weighted by time.
struct AgeSummary {
  Duration watched{};  ///< observed time
  double mean_s = 0;
  Duration p50{}, p99{}, max{};
  Time max_at;  ///< time at which the age was `max`
};

/// Results of one direction of a link.
struct DirectionSummary {
  Time from;   ///< time of sending of the first datagram
  Time until;  ///< time of the last sending or arrival
  std::uint64_t sent = 0;
  std::uint64_t lost = 0;
  std::uint64_t arrived = 0;     ///< without copies
  std::uint64_t duplicates = 0;  ///< further arrivals of the same datagram
  /// Arrivals after a datagram with a higher index: below NextExp in terms of RFC 4737, section 3. Duplicates do not
  /// count.
  std::uint64_t reordered = 0;
  std::uint64_t reordered_by_max = 0;  ///< maximum of (highest index received before - own index)
  DelaySummary delay;                  ///< one-way delay of arrived datagrams
  AgeSummary age;
  Duration longest_gap{};    ///< longest time without an arrival while the sender was sending
  Time longest_gap_at;       ///< start of the longest gap
  std::uint64_t pauses = 0;  ///< pauses of the sender longer than PauseTracker::kPause; not caused by the network
  Duration paused{};
  WindowSummaries windows;

  [[nodiscard]] double lost_share() const noexcept {
    return sent > 0 ? static_cast<double>(lost) / static_cast<double>(sent) : 0;
  }
  [[nodiscard]] double reordered_share() const noexcept {
    return arrived > 0 ? static_cast<double>(reordered) / static_cast<double>(arrived) : 0;
  }
};

/// Round trips, one per delivered datagram down, see LinkMonitor.
struct RoundTripSummary {
  DelaySummary delay;
  WindowSummaries windows;
};

/// Results of both directions and of the round trips.
struct LinkSummary {
  DirectionSummary up, down;
  RoundTripSummary round_trip;
};

}  // namespace tandem::netsim
