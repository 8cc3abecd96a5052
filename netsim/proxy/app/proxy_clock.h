#pragma once

#include <atomic>

#include "common/base/time.h"

namespace tandem::netsim {

/// Clock of a running proxy: time since its start, and the kernel's stamps converted to that time. The packet thread
/// uses all functions, other threads only `now`.
class ProxyClock {
 public:
  /// Deadlines closer than this are busy-waited, because going to sleep takes longer.
  static constexpr Duration kShorterThanSleep{3'000};

  void start() noexcept;
  /// Returns the time since `start`. Any thread.
  [[nodiscard]] Duration now() const noexcept;
  /// Sleeps until `moment`, and busy-waits for the last `spin` of that time.
  void wait_until(Duration moment, Duration spin) const noexcept;

  /// Reads the wall clock, which may have been set. Call it before converting stamps.
  void update_wall_clock() noexcept;
  /// Returns the time of arrival of a datagram.
  /// @param stamp    kernel stamp of the datagram, CLOCK_REALTIME; zero: none
  /// @param read_at  a time after the datagram was read; no datagram arrives later
  [[nodiscard]] Time arrival(Duration stamp, Duration read_at) const noexcept;

 private:
  std::atomic<Duration> started_{};  ///< CLOCK_MONOTONIC
  Duration wall_at_start_{};         ///< CLOCK_REALTIME at the start, as the wall clock is set now
};

}  // namespace tandem::netsim
