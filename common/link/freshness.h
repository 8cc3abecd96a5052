#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/base/histogram.h"
#include "common/base/time.h"
#include "common/link/recent_gaps.h"

namespace tandem::link {

/// Smallest value of the last 5-10 s: two buckets, so that a clock that drifts or a path that changes is followed.
class WindowedMinimum {
 public:
  void add(Time now, std::int64_t value) noexcept {
    if (!any_ || now - begin_ > kBucket) {
      previous_ = any_ ? current_ : value;
      current_ = value;
      begin_ = now;
      any_ = true;
    }
    current_ = std::min(current_, value);
  }
  [[nodiscard]] std::int64_t value() const noexcept { return std::min(current_, previous_); }
  [[nodiscard]] bool any() const noexcept { return any_; }

 private:
  static constexpr Duration kBucket = std::chrono::seconds(5);
  Time begin_{};
  std::int64_t current_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t previous_ = std::numeric_limits<std::int64_t>::max();
  bool any_ = false;
};

/// How old is what I know? Everything on the own monotonic clock: the peer echoes the newest counter it used, and the own send
/// times are remembered for `kMemory`, so a switch that holds datagrams for seconds and releases them in order is found out.
class Freshness {
 public:
  /// How long ago a datagram may have been sent whose echo still counts; longer loops count as not echoed. The same at every rate, and
  /// more than every `loop_age_max` (proto/scene.proto: 2.5 s).
  static constexpr Duration kMemory = std::chrono::seconds(4);

  /// Takes the memory it needs: 8 bytes for each datagram of `kMemory`, 32 KiB at 1 kHz, 512 KiB at 10 kHz.
  /// @param tick  between two datagrams of this end, 100 us to 100 ms
  explicit Freshness(Duration tick)
      : tick_(tick),
        sent_(std::bit_ceil(static_cast<std::size_t>(kMemory / std::clamp<Duration>(tick, kTickMin, kTickMax)) + kOthers)),
        mask_(sent_.size() - 1) {}

  /// @param counter  one more than the last time
  void sent(Time now, std::uint64_t counter) noexcept {
    if (next_ == 0) first_ = counter;
    sent_[counter & mask_] = now;
    next_ = counter + 1;
  }
  /// A strictly newer datagram was accepted. @param peer_tick its sender's tick count, for the variation of transit.
  void accepted(Time now, std::uint64_t echo_counter, Duration echo_age, std::uint32_t peer_tick) noexcept;

  /// Now minus when the newest echoed counter was sent; huge while nothing was echoed.
  [[nodiscard]] Duration loop_age(Time now) const noexcept {
    return echoed_ ? now - echo_sent_ : std::chrono::hours(24);
  }
  /// One-way age of the newest datagram [RTT/2 of the best case, plus how much later than the best it came, plus the wait since].
  [[nodiscard]] Duration age(Time now) const noexcept { return heard_ ? one_way_ + (now - arrived_) : std::chrono::hours(24); }
  [[nodiscard]] Duration silence(Time now) const noexcept { return heard_ ? now - arrived_ : std::chrono::hours(24); }
  /// Time since the peer last said something new about what this end sent: a datagram with a newer echo or, before the first echo, its
  /// first datagram. At least `silence`: it also grows while the peer speaks and hears nothing of this end; a long way alone does not
  /// make it grow.
  [[nodiscard]] Duration unanswered(Time now) const noexcept { return heard_ ? now - echo_moved_ : std::chrono::hours(24); }
  [[nodiscard]] Duration rtt() const noexcept { return rtt_; }
  [[nodiscard]] Duration rtt_p50() const noexcept { return Duration{rtts_.quantile(0.50)}; }
  /// Of the last full thousand; before there was one, of all: whoever asks then has it counted.
  [[nodiscard]] Duration rtt_p99() const noexcept {
    return Duration{rtts_.count() < kLearnEvery ? rtts_.quantile(0.99) : recent_p99_};
  }
  [[nodiscard]] std::uint64_t rtt_samples() const noexcept { return rtts_.count(); }
  [[nodiscard]] const Histogram& rtts() const noexcept { return rtts_; }
  /// How long the peer had heard nothing of us when it sent its newest datagram, by its own clock; and how long, by ours, its
  /// datagrams have come without an echo that is newer. The second counts from the first
  /// datagram on also while nothing was ever echoed.
  [[nodiscard]] Duration peer_silence() const noexcept { return peer_silence_; }
  [[nodiscard]] Duration echo_stall() const noexcept { return arrived_ - echo_moved_; }
  [[nodiscard]] bool heard() const noexcept { return heard_; }
  [[nodiscard]] Time arrived() const noexcept { return arrived_; }
  [[nodiscard]] const RecentGaps& gaps() const noexcept { return gaps_; }

 private:
  static constexpr Duration kTickMin = std::chrono::microseconds(100), kTickMax = std::chrono::milliseconds(100);
  static constexpr std::size_t kOthers = 64;  ///< datagrams beside the one of each tick: challenges, wishes, farewells
  static constexpr std::uint64_t kLearnEvery = 1000;
  [[nodiscard]] bool remembers(Time now, std::uint64_t counter) const noexcept {
    return counter >= first_ && counter < next_ && next_ - counter <= mask_ + 1 && now - sent_[counter & mask_] <= kMemory;
  }

  Duration tick_;
  std::vector<Time> sent_;  ///< when a counter was sent, at its remainder: one number each, for caches; a power of two of them
  std::uint64_t mask_;
  std::uint64_t first_ = 0, next_ = 0;
  bool heard_ = false, echoed_ = false;
  Time arrived_{}, echo_sent_{}, echo_moved_{};
  Duration peer_silence_{};
  std::uint64_t echo_counter_ = 0;
  Duration rtt_{}, one_way_{};
  WindowedMinimum rtt_floor_, transit_floor_;
  Histogram rtts_, recent_;
  std::int64_t recent_p99_ = 0;
  RecentGaps gaps_;
};

}  // namespace tandem::link
