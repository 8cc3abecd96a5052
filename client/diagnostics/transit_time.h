#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/histogram.h"
#include "common/base/time.h"

namespace tandem::client {

/// Transit time of datagrams from a server: arrival at the client minus the server's tick time. It contains an unknown
/// constant, so only differences have a meaning. No heap after construction.
class TransitTime {
 public:
  TransitTime() { floors_.reserve(kSecondsMax); }

  /// @param arrived  on the client's clock  @param sent  the server's tick time, on a clock with any start
  void add(Time arrived, Duration sent) noexcept;
  /// Returns the 99th percentile of the delay relative to the fastest datagram [s].
  [[nodiscard]] double jitter() const noexcept { return seconds(Duration{delay_.quantile(0.99)}); }
  /// Returns the largest lasting change of the minimum from one second to the next [s]; nullopt within two seconds.
  [[nodiscard]] std::optional<double> largest_step() const noexcept;

 private:
  static constexpr std::size_t kSecondsMax = 4096;  ///< later seconds are not recorded

  Histogram delay_;  ///< transit time minus the minimum so far [ns]
  std::int64_t floor_ = 0;
  std::vector<std::int64_t> floors_;  ///< minimum of each whole second [ns]
  std::int64_t second_floor_ = 0;
  std::optional<Time> second_began_;
};

}  // namespace tandem::client
