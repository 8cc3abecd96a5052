#pragma once

#include <array>
#include <cstdint>

#include "common/base/time.h"
#include "netsim/quality_bands.h"

/// What LinkQuality and LinkWatch found, as plain numbers.
namespace tandem::netsim {

/// One measure over all windows of one length.
struct MeasureSummary {
  std::array<std::uint64_t, kBands> windows{};  ///< judged ones, by band
  double worst = 0;                             ///< loss: share in [0, 1]; else [s]
  Time worst_at;                                ///< end of the first window that has it
};

/// All windows of one length. A window is judged when something was sent in it, or arrived.
struct WindowSummary {
  Duration length{};
  std::uint64_t windows = 0;                  ///< judged
  std::array<std::uint64_t, kBands> bands{};  ///< by the worst of their measures
  std::array<MeasureSummary, kMeasures> measures{};

  [[nodiscard]] const MeasureSummary& of(Measure m) const noexcept { return measures[static_cast<std::size_t>(m)]; }
  /// Share of the judged windows in this band; 0 of none.
  [[nodiscard]] double share(Band band) const noexcept {
    return windows > 0 ? static_cast<double>(bands[static_cast<std::size_t>(band)]) / static_cast<double>(windows) : 0;
  }
};
using WindowSummaries = std::array<WindowSummary, kWindows>;

/// Quantiles are true to 1 us below 1 ms, 10 us below 10 ms, 0.1 ms below 1 s, 1 % above; never above the true value.
struct DelaySummary {
  std::uint64_t count = 0;
  double mean_s = 0;
  Duration p5{}, p50{}, p95{}, p99{}, max{};

  [[nodiscard]] Duration jitter() const noexcept { return p99 - p50; }
};

/// Age of information: how long ago that was sent which is the newest the receiver has. Weighted by time.
struct AgeSummary {
  Duration watched{};  ///< time it was counted
  double mean_s = 0;
  Duration p50{}, p99{}, max{};
  Time max_at;  ///< when it was `max`
};

struct DirectionSummary {
  Time from;   ///< of the first datagram sent
  Time until;  ///< of the last datagram sent or come
  std::uint64_t sent = 0;
  std::uint64_t lost = 0;
  std::uint64_t arrived = 0;     ///< each once
  std::uint64_t duplicates = 0;  ///< came again
  /// Came after one of a higher number: below NextExp in the words of RFC 4737, section 3. Duplicates do not count.
  std::uint64_t reordered = 0;
  std::uint64_t reordered_by_max = 0;  ///< highest number before it, less its own, at most
  DelaySummary delay;                  ///< one way, of what arrived
  AgeSummary age;
  Duration longest_gap{};  ///< without an arrival while the sender talked
  Time longest_gap_at;     ///< when it began
  std::uint64_t pauses = 0;  ///< of the sender, longer than LinkQuality::kPause; not the network's
  Duration paused{};
  WindowSummaries windows;

  [[nodiscard]] double lost_share() const noexcept {
    return sent > 0 ? static_cast<double>(lost) / static_cast<double>(sent) : 0;
  }
  [[nodiscard]] double reordered_share() const noexcept {
    return arrived > 0 ? static_cast<double>(reordered) / static_cast<double>(arrived) : 0;
  }
};

/// Round trips: a datagram up, and the first one down that was sent after it had come.
struct RoundTripSummary {
  DelaySummary delay;
  WindowSummaries windows;
};

struct LinkSummary {
  DirectionSummary up, down;
  RoundTripSummary round_trip;
};

}  // namespace tandem::netsim
