#pragma once

#include <cstddef>
#include <vector>

#include "netsim/path_spec.h"

namespace tandem::netsim {

/// The inverse of a distribution without a closed inverse, tabulated over the normal quantile z in [-8.25, 8.25] in
/// steps of 1/64 and linear between: relative error below 1e-3 for the shapes allowed. Memory: 8.5 KB, taken once.
class QuantileTable {
 public:
  /// @param spec  kGamma or kHyperExponential
  explicit QuantileTable(const BodySpec& spec);

  /// [ns] Total: z outside is taken as the nearest end.
  [[nodiscard]] double at(double z) const noexcept;

 private:
  std::vector<double> values_;
};

/// Regularized incomplete gamma functions P(a, x) = 1 - Q(a, x); a > 0, x >= 0.
/// Source: series 6.5.29 and continued fraction 6.5.31 of Abramowitz and Stegun; modified Lentz.
[[nodiscard]] double gamma_p(double a, double x) noexcept;
[[nodiscard]] double gamma_q(double a, double x) noexcept;

}  // namespace tandem::netsim
