#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/base/time.h"

namespace tandem::netsim {

/// Bins of delays: 1 us wide below 1 ms, 10 us below 10 ms, 0.1 ms below 100 ms, 0.5 ms below 1 s, then 1 %. The bins
/// are finer than those of tandem::Histogram around the band limits (jitter of 2 ms on a delay of 280 ms). They are
/// decimal, so that 10 ms is not reported as 9.98 ms. Bins cover 0 to 10 000 s; larger delays share the last bin.
struct DelayScale {
  struct Decade {
    std::int64_t from_us, width_us;
    std::size_t first;  ///< first bin of the decade
  };
  static constexpr std::array<Decade, 8> kDecades{{{0, 1, 0},
                                                   {1'000, 10, 1'000},
                                                   {10'000, 100, 1'900},
                                                   {100'000, 500, 2'800},
                                                   {1'000'000, 10'000, 4'600},
                                                   {10'000'000, 100'000, 5'500},
                                                   {100'000'000, 1'000'000, 6'400},
                                                   {1'000'000'000, 10'000'000, 7'300}}};
  static constexpr std::size_t kBins = 8'201;

  /// Returns the bin within decade D. It precedes its first use because clang requires that of a constant expression.
  template <std::size_t D>
  [[nodiscard]] static constexpr std::size_t in(std::int64_t us) noexcept {
    return kDecades[D].first + static_cast<std::size_t>((us - kDecades[D].from_us) / kDecades[D].width_us);
  }

  /// @param delay  negative values count as 0
  [[nodiscard]] static constexpr std::size_t bin_of(Duration delay) noexcept {
    const std::int64_t us = std::max<std::int64_t>(delay.count(), 0) / 1000;
    if (us < 1'000) return static_cast<std::size_t>(us);
    if (us < 10'000) return in<1>(us);
    if (us < 100'000) return in<2>(us);
    if (us < 1'000'000) return in<3>(us);
    if (us < 10'000'000) return in<4>(us);
    if (us < 100'000'000) return in<5>(us);
    if (us < 1'000'000'000) return in<6>(us);
    return std::min(in<7>(us), kBins - 1);
  }
  /// Returns the smallest delay of a bin; for kBins, the end of the last regular bin.
  [[nodiscard]] static constexpr Duration begin_of(std::size_t bin) noexcept {
    std::size_t d = kDecades.size() - 1;
    while (bin < kDecades[d].first) --d;
    const auto steps = static_cast<std::int64_t>(bin - kDecades[d].first);
    return Duration{1000 * (kDecades[d].from_us + steps * kDecades[d].width_us)};
  }
};

/// Histogram of delays on DelayScale. The constructor allocates all memory; all operations are total and real-time
/// safe.
template <typename Count>
class DelayHistogram {
 public:
  DelayHistogram() : bins_(DelayScale::kBins), blocks_(DelayScale::kBins / kBlock + 1) {}

  void add(std::size_t bin) noexcept {
    ++bins_[bin];
    ++blocks_[bin / kBlock];
    ++count_;
  }
  /// @param bin  bin of a delay added before
  void remove(std::size_t bin) noexcept {
    --bins_[bin];
    --blocks_[bin / kBlock];
    --count_;
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

  /// Returns the ceil(percent / 100 * count)-th smallest delay, rounded down to the begin of its bin; 0 if empty.
  [[nodiscard]] Duration quantile(unsigned percent) const noexcept {
    if (count_ == 0) return Duration::zero();
    const std::uint64_t rank = std::max<std::uint64_t>(1, (count_ * percent + 99) / 100);
    std::uint64_t below = 0;
    std::size_t block = 0;
    while (block + 1 < blocks_.size() && below + blocks_[block] < rank) below += blocks_[block++];
    std::size_t bin = block * kBlock;
    while (bin + 1 < bins_.size() && below + bins_[bin] < rank) below += bins_[bin++];
    return DelayScale::begin_of(bin);
  }

 private:
  static constexpr std::size_t kBlock = 64;
  std::vector<Count> bins_, blocks_;
  std::uint64_t count_ = 0;
};

static_assert(DelayScale::bin_of(Duration{std::numeric_limits<std::int64_t>::max()}) == DelayScale::kBins - 1);
static_assert(DelayScale::kBins <= std::numeric_limits<std::uint16_t>::max());

}  // namespace tandem::netsim
