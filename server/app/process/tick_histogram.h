#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/single_writer_counter.h"
#include "common/base/time.h"

namespace tandem::server {

/// Histogram of durations, one per tick. One thread adds, any thread reads; a reader copies plain counters.
class TickHistogram {
 public:
  /// Upper bounds [s]; one more count holds all longer durations.
  static constexpr std::array<double, 10> kBounds{20e-6,  50e-6, 100e-6, 200e-6, 400e-6,
                                                  500e-6, 1e-3,  2e-3,   5e-3,   20e-3};

  void add(Duration d) noexcept {
    std::size_t i = 0;
    while (i < kBounds.size() && seconds(d) > kBounds[i]) ++i;
    counts_[i].add(1);
    sum_ns_.add(static_cast<std::uint64_t>(d.count()));
  }
  /// Count of bin `i`, not cumulative.
  [[nodiscard]] std::uint64_t count(std::size_t i) const noexcept { return counts_[i].get(); }
  /// Sum of all durations [s].
  [[nodiscard]] double sum() const noexcept { return 1e-9 * static_cast<double>(sum_ns_.get()); }

 private:
  std::array<SingleWriterCounter<std::uint64_t>, kBounds.size() + 1> counts_{};
  SingleWriterCounter<std::uint64_t> sum_ns_;
};

}  // namespace tandem::server
