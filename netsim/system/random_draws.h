#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "common/base/rng.h"

namespace tandem::netsim {

/// Random draws of one purpose, for generators of scenes, networks and faults. The same key gives the same draws.
class RandomDraws {
 public:
  explicit RandomDraws(RandomKey key) : random_(key) {}

  /// Returns true with probability `p`.
  bool chance(double p) { return random_.uniform() < p; }
  /// Draws uniformly from [lo, hi).
  double between(double lo, double hi) { return random_.uniform(lo, hi); }
  /// Draws from [lo, hi) so that the logarithm is uniform. Requires 0 < lo.
  double log_between(double lo, double hi) { return std::exp(between(std::log(lo), std::log(hi))); }
  /// Draws from 0, 1, ... n - 1.
  std::size_t below(std::size_t n) { return random_.below(n); }
  /// Draws an index with a probability proportional to its weight.
  template <std::size_t N>
  std::size_t choose(const std::array<double, N>& weight) {
    double sum = 0, drawn = random_.uniform();
    for (const double w : weight) sum += w;
    for (std::size_t i = 0; i + 1 < N; ++i) {
      drawn -= weight[i] / sum;
      if (drawn < 0) return i;
    }
    return N - 1;
  }

 private:
  RandomStream random_;
};

}  // namespace tandem::netsim
