#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/base/time.h"
#include "netsim/models/capacity.h"
#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Sender with a queue. A fixed rate uses exact arithmetic without drift. With equal datagrams, datagram n of a busy
/// period ends at n (size + overhead) 8 / rate, rounded up to the nanosecond.
class LinkRate {
 public:
  /// Upper bound of any wait, independent of the configured limits; bounds the arithmetic.
  static constexpr Duration kWaitMax{3'600'000'000'000};

  explicit LinkRate(const RateSpec& spec);

  /// @param now   non-decreasing over calls
  /// @param size  payload [bytes]
  /// @return time at which the last bit is sent; empty if the queue is full and drops the datagram
  std::optional<Time> serve(Time now, std::size_t size) noexcept {
    if (!limited_) return now;
    return serve_queued(now, size);
  }

  /// Returns the start time of a datagram that arrives at `now` behind `bytes_before` bytes unknown to this sender.
  /// Result in whole nanoseconds. With a recorded capacity: the first opportunity with unused bytes.
  [[nodiscard]] Time begins(Time now, std::uint64_t bytes_before) noexcept;
  /// Returns the accepted but unsent bytes, in whole bytes; empty with a recorded capacity, which cannot provide the
  /// number.
  [[nodiscard]] std::optional<std::uint64_t> unsent(Time now) const noexcept;
  /// Takes over from a sender with another spec. Bytes unsent at `at` are sent at this sender's rate before later
  /// arrivals. Results already returned for queued datagrams do not change.
  void replace(const LinkRate& before, Time at) noexcept;

  /// Returns the wait of a datagram that arrives at `now` until its first bit is sent, in whole nanoseconds.
  [[nodiscard]] Duration waiting(Time now) const noexcept {
    return std::max(busy_until_ - now, Duration::zero()) + competing_wait(now);
  }

 private:
  /// Queue content of the competing flow as a waiting time: linear up to the peak, then decreasing with slope -1.
  [[nodiscard]] Duration competing_wait(Time now) const noexcept;
  std::optional<Time> serve_queued(Time now, std::size_t size) noexcept;

  [[nodiscard]] std::optional<Time> at_rate(Time now, std::uint64_t bytes) noexcept;
  [[nodiscard]] std::optional<Time> by_trace(Time now, std::uint64_t bytes) noexcept;

  bool limited_;
  std::uint64_t bits_per_s_;
  std::uint64_t overhead_;
  std::uint64_t queue_bytes_;
  Duration wait_max_;
  Duration competing_peak_, competing_period_;
  std::optional<Backlog> backlog_;
  std::optional<CoDel> codel_;
  CapacityTracePlayer capacity_;
  Time not_before_{};            ///< start time of the recorded capacity after `replace`
  Time busy_until_{};            ///< whole nanoseconds ...
  std::uint64_t busy_rest_ = 0;  ///< ... plus this many fractions 1/bits_per_s of a nanosecond
};

}  // namespace tandem::netsim
