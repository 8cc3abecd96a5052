#pragma once

#include <cstddef>
#include <vector>

#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Table of an inverse distribution function without closed form. It covers the normal quantile z in [-8.25, 8.25] in
/// steps of 1/64 with linear interpolation. Relative error below 1e-3 for the allowed shapes. The constructor allocates
/// 8.5 KB.
class QuantileTable {
 public:
  /// @param spec  kGamma or kHyperExponential
  explicit QuantileTable(const BodySpec& spec);

  /// Returns the value at z [ns]. Total: z outside the table is clamped to its nearest end.
  [[nodiscard]] double at(double z) const noexcept;

 private:
  std::vector<double> values_;
};

/// Regularized incomplete gamma functions; P(a, x) = 1 - Q(a, x) for a > 0, x >= 0.
/// Source: series 6.5.29 and continued fraction 6.5.31 of Abramowitz and Stegun; modified Lentz.
[[nodiscard]] double gamma_p(double a, double x) noexcept;
[[nodiscard]] double gamma_q(double a, double x) noexcept;

}  // namespace tandem::netsim
