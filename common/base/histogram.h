#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "common/base/log_scale.h"

namespace tandem {

/// Counts durations in the bins of LogScale [ns], in fixed memory. A quantile is at most 1/32 (3.2 %) above the true
/// value. Accepts any value, no heap, real-time safe.
/// @tparam Count  of a bin, unsigned. When one is full, all bins are halved: quantiles stay as they are, but for values
///                that came less often than once in 2^16 (16 bits) or 2^32 (32 bits) of them
/// @tparam kBits  values from 2^kBits on share the last bin, whose quantile is the greatest value [1, 63]
template <class Count, int kBits>
class BasicHistogram {
 public:
  /// @param ns  duration [ns]; negative counts as 0
  constexpr void add(std::int64_t ns) noexcept {
    const std::int64_t value = std::max<std::int64_t>(ns, 0);
    Count& bin = bins_[LogScale::bin_of(std::min(static_cast<std::uint64_t>(value), kMost))];
    ++bin;
    ++binned_;
    if (bin == std::numeric_limits<Count>::max()) [[unlikely]]
      halve();
    max_ = std::max(max_, value);
  }

  /// Returns the smallest bin end at or below which at least a share `q` of all values lies; never above max().
  /// @param q  share, clamped to [0, 1]; NaN counts as 0
  /// @return   [ns]; 0 when nothing was added
  [[nodiscard]] constexpr std::int64_t quantile(double q) const noexcept {
    if (binned_ == 0) return 0;
    const double share = q >= 0 ? std::min(q, 1.0) : 0.0;
    const double wanted = share * static_cast<double>(binned_);
    const auto reached = [&](std::uint64_t below) { return below > 0 && static_cast<double>(below) >= wanted; };
    std::uint64_t below = 0;
    std::size_t bin = 0;
    // Skips whole octaves: most bins lie below the quantile. Their sum takes a quarter of the instructions.
    for (std::uint64_t held = 0; bin < kBins; bin += kBinsPerOctave, below += held) {
      held = 0;
      const Count* const octave = bins_.data() + bin;
#pragma GCC unroll 32
      for (std::size_t i = 0; i < kBinsPerOctave; ++i) held += octave[i];
      if (reached(below + held)) break;
    }
    for (; bin < kBins; ++bin) {
      below += bins_[bin];
      if (reached(below)) return bin + 1 < kBins ? std::min(LogScale::last_of(bin), max_) : max_;
    }
    return max_;
  }

  [[nodiscard]] constexpr std::uint64_t count() const noexcept { return binned_ + halved_; }
  [[nodiscard]] constexpr std::int64_t max() const noexcept { return max_; }  ///< exact [ns]

  /// Calls `bucket(first, last, count)` for every non-empty bucket, in ascending order; a bucket contains the values v
  /// [ns] with first <= v <= last. There are four buckets per octave, so the width of a bucket is at most a quarter of
  /// its values.
  template <class Bucket>
  constexpr void each_bucket(Bucket&& bucket) const {
    for (std::size_t bin = 0; bin < kBins; bin += kBinsPerBucket) {
      std::uint64_t held = 0;
      for (std::size_t i = bin; i < bin + kBinsPerBucket; ++i) held += bins_[i];
      if (held > 0)
        bucket(bin == 0 ? std::int64_t{0} : LogScale::last_of(bin - 1) + 1, LogScale::last_of(bin + kBinsPerBucket - 1),
               held);
    }
  }

  constexpr void reset() noexcept { *this = BasicHistogram{}; }

  /// Adds all values of `other`.
  constexpr void merge(const BasicHistogram& other) noexcept {
    const bool halves = binned_ + other.binned_ >= std::numeric_limits<Count>::max();
    const std::uint64_t all = count() + other.count();
    binned_ = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      const std::uint64_t sum = std::uint64_t{bins_[bin]} + other.bins_[bin];
      binned_ += bins_[bin] = static_cast<Count>(halves ? sum / 2 : sum);
    }
    halved_ = all - binned_;
    max_ = std::max(max_, other.max_);
  }

 private:
  static constexpr std::uint64_t kMost = (std::uint64_t{1} << kBits) - 1;
  static constexpr std::size_t kBins = LogScale::bin_of(kMost) + 1;
  static constexpr std::size_t kBinsPerBucket = std::size_t{1} << (LogScale::kSubBits - 2);
  static constexpr std::size_t kBinsPerOctave = std::size_t{1} << LogScale::kSubBits;
  static_assert(kBits > LogScale::kSubBits && kBits <= 63 && kBins % kBinsPerOctave == 0 &&
                kBins % kBinsPerBucket == 0 && LogScale::kExact % kBinsPerBucket == 0);

  constexpr void halve() noexcept {
    const std::uint64_t all = count();
    binned_ = 0;
    for (Count& bin : bins_) binned_ += bin = static_cast<Count>(bin / 2);
    halved_ = all - binned_;
  }

  std::array<Count, kBins> bins_{};
  std::uint64_t binned_ = 0, halved_ = 0;  ///< values: sum of the bins, and those that were lost as bins were halved
  std::int64_t max_ = 0;
};

/// All durations up to 2^63 ns: 15 KiB.
using Histogram = BasicHistogram<std::uint64_t, 63>;
/// Of a link: up to 18 min, 4.4 KiB. A server has two for each client.
using LinkHistogram = BasicHistogram<std::uint32_t, 40>;
/// The same for short windows: 2.2 KiB.
using ShortLinkHistogram = BasicHistogram<std::uint16_t, 40>;

}  // namespace tandem
