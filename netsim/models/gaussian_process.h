#pragma once

#include <array>
#include <cstdint>

#include "common/base/rng.h"
#include "common/base/time.h"

namespace tandem::netsim {

/// Stationary Gaussian process N(0, 1) with autocorrelation exp(-|lag| / tau) (Ornstein-Uhlenbeck), as a function of
/// time. Queries may come in any order; the same time always gives the same value.
///
/// Blocks of 16 tau start from independent draws (true correlation e^-16). Inside a block, each interval's midpoint is
/// drawn conditionally on its two ends. The smallest step is the larger of min(1 ms, tau/8) and 2^-14 of the block.
/// Between two steps, linear interpolation is rescaled to variance 1, so the marginal is exactly normal at every time.
/// Cost: at most 15 draws per query; two per step when time advances.
class GaussianProcess {
 public:
  /// @param tau  correlation time [10 us, 10 s]
  GaussianProcess(Duration tau, RandomKey key) noexcept;

  /// @param t  Time{} or later
  [[nodiscard]] double at(Time t) noexcept;

  [[nodiscard]] Duration step() const noexcept { return step_; }

 private:
  static constexpr int kLevelsMax = 14;

  struct Level {
    double lo = 0, hi = 0;  ///< values at the ends of the interval that contains the current step
  };
  struct Midpoint {
    double weight = 0;  ///< weight of lo + hi
    double sd = 0;      ///< standard deviation of the conditional draw
  };

  [[nodiscard]] double draw(std::int64_t block, std::uint64_t node) const noexcept;
  void descend(int from, std::uint32_t leaf) noexcept;

  RandomKey key_;
  Duration step_{};
  int levels_ = 0;
  double step_correlation_ = 0;
  std::array<Midpoint, kLevelsMax> midpoint_{};
  std::int64_t block_ = -1;
  std::uint32_t leaf_ = 0;
  std::array<Level, kLevelsMax + 1> level_{};
};

}  // namespace tandem::netsim
