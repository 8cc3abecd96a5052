#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "common/base/log_scale.h"
#include "common/base/single_writer_counter.h"
#include "common/base/time.h"
#include "netsim/proxy/client_table.h"

namespace tandem::netsim {

/// Histogram of delays of one direction of one client. The packet thread writes; other threads read without a lock.
/// Each number is consistent, but a snapshot may miss the newest delays. Bins are those of LogScale in units of
/// 1.024 us.
class LiveDelayHistogram {
 public:
  static constexpr std::size_t kBins = std::size_t{36} * 32;  ///< the last one also holds all longer delays
  /// Copy of the histogram. The difference of two copies gives the delays in between.
  struct Snapshot {
    std::array<std::uint32_t, kBins> bins{};
    std::int64_t sum_ns = 0;
    std::uint64_t count = 0;

    /// Mean and quantile of the delays since `before`; zero if there are none.
    [[nodiscard]] Duration mean_since(const Snapshot& before) const noexcept {
      const std::uint64_t n = count - before.count;
      return n == 0 ? Duration{} : Duration{(sum_ns - before.sum_ns) / static_cast<std::int64_t>(n)};
    }
    [[nodiscard]] Duration quantile_since(const Snapshot& before, double q) const noexcept {
      std::uint64_t all = 0;
      for (std::size_t i = 0; i < kBins; ++i) all += bins[i] - before.bins[i];
      if (all == 0) return {};
      std::uint64_t below = 0;
      for (std::size_t i = 0; i < kBins; ++i) {
        below += bins[i] - before.bins[i];
        if (static_cast<double>(below) >= q * static_cast<double>(all)) return end_of(i);
      }
      return end_of(kBins - 1);
    }
  };

  /// Adds a delay. Only for the one writing thread.
  void add(Duration delay) noexcept {
    const std::int64_t ns = std::max<std::int64_t>(delay.count(), 0);
    bins_[bin_of(static_cast<std::uint64_t>(ns) >> kUnitBits)].add(1);
    sum_ns_.add(ns);
    count_.add(1);
  }
  void clear() noexcept {
    for (auto& bin : bins_) bin.reset();
    sum_ns_.reset();
    count_.reset();
  }
  /// Copies the histogram. Any thread.
  void read(Snapshot& picture) const noexcept {
    for (std::size_t i = 0; i < kBins; ++i) picture.bins[i] = bins_[i].get();
    picture.sum_ns = sum_ns_.get();
    picture.count = count_.get();
  }

 private:
  static constexpr int kUnitBits = 10;  ///< 1.024 us

  static constexpr std::size_t bin_of(std::uint64_t units) noexcept {
    return std::min(LogScale::bin_of(units), kBins - 1);
  }
  static constexpr Duration end_of(std::size_t bin) noexcept {
    return Duration{((LogScale::last_of(bin) + 1) << kUnitBits) - 1};
  }

  std::array<SingleWriterCounter<std::uint32_t>, kBins> bins_{};
  SingleWriterCounter<std::int64_t> sum_ns_;
  SingleWriterCounter<std::uint64_t> count_;
};

/// Measured (not scheduled) delays of all clients of a proxy, by place and direction. The constructor allocates all
/// memory.
class ClientDelays {
 public:
  ClientDelays() : delays_(std::make_unique<std::array<LiveDelayHistogram, kDirections>[]>(ClientTable::kMax)) {}

  [[nodiscard]] LiveDelayHistogram& of(std::uint32_t place, Direction direction) noexcept {
    return delays_[place][static_cast<std::size_t>(direction)];
  }
  [[nodiscard]] const LiveDelayHistogram& of(std::uint32_t place, Direction direction) const noexcept {
    return delays_[place][static_cast<std::size_t>(direction)];
  }
  /// Clears the delays of a place, for its next client.
  void clear(std::uint32_t place) noexcept {
    for (LiveDelayHistogram& delays : delays_[place]) delays.clear();
  }

 private:
  std::unique_ptr<std::array<LiveDelayHistogram, kDirections>[]> delays_;
};

}  // namespace tandem::netsim
