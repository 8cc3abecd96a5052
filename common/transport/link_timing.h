#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "common/base/histogram.h"
#include "common/base/time.h"
#include "common/transport/recent_gaps.h"

namespace tandem::transport {

/// Minimum over the last 5 to 10 s. Two buckets, so that it follows a drifting clock or a changed path.
class WindowedMinimum {
 public:
  void add(Time now, std::int64_t value) noexcept {
    if (now - begin_ > kBucket) [[unlikely]] {
      previous_ = std::exchange(current_, kNone);
      begin_ = now;
    }
    current_ = std::min(current_, value);
  }
  [[nodiscard]] std::int64_t value() const noexcept { return std::min(current_, previous_); }
  [[nodiscard]] bool any() const noexcept { return value() != kNone; }

 private:
  static constexpr Duration kBucket = std::chrono::seconds(5);
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
  Time begin_{Duration::min() / 2};  ///< long ago: the first value begins a bucket
  std::int64_t current_ = kNone, previous_ = kNone;
};

/// A time of the last minutes in 5 bytes: the low 40 bits of its nanoseconds, which repeat after 18 min.
class BriefTime {
 public:
  BriefTime() = default;
  explicit BriefTime(Time at) noexcept {
    const std::int64_t ns = at.time_since_epoch().count();
    std::memcpy(low_.data(), &ns, low_.size());
  }
  /// Returns the time that is nearest to `now`: the one stored, if both are less than 9 min apart.
  [[nodiscard]] Time near(Time now) const noexcept {
    std::uint64_t low = 0;
    std::memcpy(&low, low_.data(), low_.size());
    const std::uint64_t since = static_cast<std::uint64_t>(now.time_since_epoch().count()) - low;
    return now - Duration{static_cast<std::int64_t>(since << kCut) >> kCut};
  }

 private:
  static_assert(std::endian::native == std::endian::little, "the first bytes are the low ones");
  std::array<std::byte, 5> low_{};
  static constexpr int kCut = 64 - 8 * 5;
};

/// Estimates the age of received data and the round-trip time. All times are on the own monotonic clock. The peer
/// echoes the newest counter it used, and the own send times are kept for `kMemory`. A switch that holds datagrams for
/// seconds and releases them in order is therefore detected.
class LinkTiming {
 public:
  /// Largest loop time whose echo still counts; older echoes are ignored. It is the same at every rate and longer than
  /// every `loop_age_max` (proto/schema/scene.proto: 2.5 s).
  static constexpr Duration kMemory = std::chrono::seconds(4);

  /// Allocates 5 bytes for each datagram of `kMemory`: 20 KiB at 1 kHz, 320 KiB at 10 kHz.
  /// @param tick  time between two datagrams of this end, 100 us to 100 ms
  explicit LinkTiming(Duration tick)
      : tick_(tick),
        sent_(std::bit_ceil(static_cast<std::size_t>(kMemory / std::clamp<Duration>(tick, kTickMin, kTickMax)) +
                            kOtherDatagramsMax)),
        mask_(sent_.size() - 1) {}

  /// Records a sent datagram.
  /// @param counter  one more than the last time
  void sent(Time now, std::uint64_t counter) noexcept {
    // Times before a gap are too old for an echo. They are left out, because old ones repeat.
    if (next_ == 0 || now - newest_ > kMemory) first_ = counter;
    sent_[counter & mask_] = BriefTime{now};
    newest_ = now;
    next_ = counter + 1;
  }
  /// Records that a strictly newer datagram was accepted. @param peer_tick  its sender's tick count, for the variation
  /// of the transit time.
  void accepted(Time now, std::uint64_t echo_counter, Duration echo_age, std::uint32_t peer_tick) noexcept;

  /// Returns the time since the newest echoed counter was sent; 24 h while nothing was echoed.
  [[nodiscard]] Duration loop_age(Time now) const noexcept {
    return echoed_ ? now - echo_sent_ : std::chrono::hours(24);
  }
  /// Called once per tick, after the datagrams that have arrived were accepted, before `age`.
  void tick(Time now) noexcept {
    if (std::exchange(in_use_, true)) return;
    one_way_ -= half_wait(now - arrived_);
  }
  /// Returns the one-way age of the newest datagram: RTT/2 of the best case, plus its delay beyond the best transit,
  /// plus the time since its arrival; 24 h before the first datagram. The waits for the ticks of both ends, which the
  /// phase between their clocks divides at random, count half at each end. So the age is half of the loop where both
  /// ways are equal. With the true ages, where a server uses a STATE at once and a client a FORCE a tick later, a tool
  /// follows a hand worse (ARCHITECTURE.md, "Order within a tick").
  [[nodiscard]] Duration age(Time now) const noexcept {
    return heard_ ? one_way_ + (now - arrived_) : std::chrono::hours(24);
  }
  /// Returns the time at which the peer sent the newest datagram, on the own clock, without these waits.
  [[nodiscard]] Time peer_sent() const noexcept { return arrived_ - transit_; }
  [[nodiscard]] Duration silence(Time now) const noexcept { return heard_ ? now - arrived_ : std::chrono::hours(24); }
  /// Returns the time since the peer last confirmed new data of this end. A datagram with a newer echo confirms, or,
  /// before the first echo, the first datagram. It is at least `silence`. It also grows while the peer sends but
  /// receives nothing; a long delay alone does not make it grow.
  [[nodiscard]] Duration unanswered_for(Time now) const noexcept {
    return heard_ ? now - echo_moved_ : std::chrono::hours(24);
  }
  [[nodiscard]] Duration rtt() const noexcept { return rtt_; }
  [[nodiscard]] Duration rtt_p50() const noexcept { return Duration{rtts_.quantile(0.50)}; }
  /// Returns the p99 of the last full thousand samples; before there is one, of all samples (computed on each call).
  [[nodiscard]] Duration rtt_p99() const noexcept {
    return Duration{rtts_.count() < kLearnEvery ? rtts_.quantile(0.99) : recent_p99_};
  }
  [[nodiscard]] std::uint64_t rtt_samples() const noexcept { return rtts_.count(); }
  [[nodiscard]] const LinkHistogram& rtts() const noexcept { return rtts_; }
  /// `peer_silence` is the time that the peer had received nothing from this end when it sent its newest datagram, on
  /// its clock. `echo_stall` is the time for which datagrams have arrived without a newer echo, on the own clock. It
  /// counts from the first datagram even if nothing was ever echoed.
  [[nodiscard]] Duration peer_silence() const noexcept { return peer_silence_; }
  [[nodiscard]] Duration echo_stall() const noexcept { return arrived_ - echo_moved_; }
  [[nodiscard]] bool heard() const noexcept { return heard_; }
  [[nodiscard]] Time arrived() const noexcept { return arrived_; }
  [[nodiscard]] const RecentGaps& gaps() const noexcept { return gaps_; }

 private:
  /// Returns half of a wait for a tick, which is at most one tick.
  [[nodiscard]] Duration half_wait(Duration wait) const noexcept {
    return Duration{std::clamp(wait, Duration{}, tick_).count() >> 1};
  }
  static constexpr Duration kTickMin = std::chrono::microseconds(100), kTickMax = std::chrono::milliseconds(100);
  static constexpr std::size_t kOtherDatagramsMax =
      64;  ///< datagrams in addition to the one per tick: challenges, requests, CLOSE
  static constexpr std::uint64_t kLearnEvery = 1000;
  /// @param sent  time in the place of this counter, which may be that of another one
  [[nodiscard]] bool remembers(Time now, std::uint64_t counter, Time sent) const noexcept {
    return counter >= first_ && counter < next_ && next_ - counter <= mask_ + 1 && now - newest_ <= kMemory &&
           now - sent <= kMemory;
  }

  Duration tick_;
  std::vector<BriefTime> sent_;  ///< send time of a counter, at its remainder; a power of two of entries
  std::uint64_t mask_;
  std::uint64_t first_ = 0, next_ = 0;
  Time newest_{};  ///< of the sent ones
  bool heard_ = false, echoed_ = false;
  Time arrived_{}, echo_sent_{}, echo_moved_{};
  bool in_use_ = true;  ///< a tick has used the newest datagram
  Duration peer_silence_{}, half_peer_wait_{};
  std::uint64_t echo_counter_ = 0;
  Duration rtt_{}, transit_{}, one_way_{};
  WindowedMinimum rtt_floor_, transit_floor_;
  LinkHistogram rtts_;
  ShortLinkHistogram recent_;  ///< of at most kLearnEvery samples
  std::int64_t recent_p99_ = 0;
  RecentGaps gaps_;
};

}  // namespace tandem::transport
