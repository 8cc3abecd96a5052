#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/base/time.h"
#include "netsim/capacity.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// A sender with a queue. Of a fixed rate in exact arithmetic: datagram n of a busy period of equal datagrams
/// ends at n (size + overhead) 8 / rate, rounded up to the nanosecond, without drift.
class LinkRate {
 public:
  /// No datagram ever waits longer, whatever the limits say: bounds the arithmetic.
  static constexpr Duration kWaitMax{3'600'000'000'000};

  explicit LinkRate(const RateSpec& spec);

  /// @param now   never decreasing
  /// @param size  payload [bytes]
  /// @return when the last bit is sent; empty: the queue is full and the datagram dropped
  std::optional<Time> serve(Time now, std::size_t size) noexcept {
    if (!limited_) return now;
    return serve_queued(now, size);
  }

  /// When the first bit of something would be sent that comes now, behind so many bytes that wait and that this sender
  /// does not know of yet; in whole nanoseconds. A recorded capacity: at the first opportunity that is not used up.
  [[nodiscard]] Time begins(Time now, std::uint64_t bytes_before) noexcept;
  /// What is not sent yet of those served, in whole bytes; empty: a recorded capacity cannot tell.
  [[nodiscard]] std::optional<std::uint64_t> unsent(Time now) const noexcept;
  /// Goes on where a sender of other numbers was: what it still had to send at `at` is sent at this rate, before all
  /// that comes later. (What it said about datagrams already in its queue stays said.)
  void take_over(const LinkRate& before, Time at) noexcept;

  /// How long a datagram that comes now waits before its first bit is sent, to the whole nanosecond.
  [[nodiscard]] Duration waiting(Time now) const noexcept {
    return std::max(busy_until_ - now, Duration::zero()) + others(now);
  }

 private:
  /// What the competing flow has in the queue, as waiting time: linear up to the peak, then falling with time itself.
  [[nodiscard]] Duration others(Time now) const noexcept;
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
  CapacityPlayer capacity_;
  Time not_before_{};            ///< a recorded capacity begins here
  Time busy_until_{};            ///< whole nanoseconds,
  std::uint64_t busy_rest_ = 0;  ///< plus this many 1/bits_per_s parts of one
};

}  // namespace tandem::netsim
