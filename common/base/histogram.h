#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/log_scale.h"

namespace tandem {

/// Counts durations in the bins of LogScale [ns]. A quantile is at most 1/32 (3.2 %) above the true value. Covers 0 to
/// 2^63 ns in fixed memory (15 KiB); accepts any value, no heap, real-time safe.
class Histogram {
 public:
  /// @param ns  duration [ns]; negative counts as 0
  constexpr void add(std::int64_t ns) noexcept {
    const std::int64_t value = std::max<std::int64_t>(ns, 0);
    ++bins_[LogScale::bin_of(static_cast<std::uint64_t>(value))];
    ++count_;
    max_ = std::max(max_, value);
    sum_ += static_cast<double>(value);
  }

  /// Returns the smallest bin end at or below which at least a share `q` of all values lies; never above max().
  /// @param q  share, clamped to [0, 1]; NaN counts as 0
  /// @return   [ns]; 0 when nothing was added
  [[nodiscard]] constexpr std::int64_t quantile(double q) const noexcept {
    if (count_ == 0) return 0;
    const double share = q >= 0 ? std::min(q, 1.0) : 0.0;
    const double wanted = share * static_cast<double>(count_);
    const auto reached = [&](std::uint64_t below) { return below > 0 && static_cast<double>(below) >= wanted; };
    std::uint64_t below = 0;
    std::size_t bin = 0;
    // Skips whole octaves: most bins lie below the quantile. Their sum takes a quarter of the instructions.
    for (std::uint64_t held = 0; bin < kBins; bin += kBinsPerOctave, below += held) {
      held = 0;
      const std::uint64_t* const octave = bins_.data() + bin;
#pragma GCC unroll 32
      for (std::size_t i = 0; i < kBinsPerOctave; ++i) held += octave[i];
      if (reached(below + held)) break;
    }
    for (; bin < kBins; ++bin) {
      below += bins_[bin];
      if (reached(below)) return std::min(LogScale::last_of(bin), max_);
    }
    return max_;
  }

  [[nodiscard]] constexpr std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] constexpr std::int64_t max() const noexcept { return max_; }  ///< exact [ns]
  [[nodiscard]] constexpr double mean() const noexcept {                      ///< [ns]; 0 when empty
    return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0;
  }

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

  constexpr void reset() noexcept { *this = Histogram{}; }

  /// Adds all values of `other`.
  constexpr void merge(const Histogram& other) noexcept {
    for (std::size_t bin = 0; bin < kBins; ++bin) bins_[bin] += other.bins_[bin];
    count_ += other.count_;
    max_ = std::max(max_, other.max_);
    sum_ += other.sum_;
  }

 private:
  static constexpr std::size_t kBins = LogScale::kBins;
  static constexpr std::size_t kBinsPerBucket = std::size_t{1} << (LogScale::kSubBits - 2);
  static constexpr std::size_t kBinsPerOctave = std::size_t{1} << LogScale::kSubBits;
  static_assert(kBins % kBinsPerOctave == 0 && kBins % kBinsPerBucket == 0 && LogScale::kExact % kBinsPerBucket == 0);

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ = 0;
  double sum_ = 0;
};

}  // namespace tandem
