#pragma once

#include <string>
#include <vector>

/// Round numbers for axes. Pure.
namespace tandem::netsim::plot {

/// Values to write at an axis: multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  std::vector<double> values;
  int decimals = 0;  ///< enough to write every value exactly
};

/// Round numbers within [lo, hi], about `wanted` of them and never more than 2 * wanted + 2.
/// Bounds that are not finite or not in order give no ticks.
[[nodiscard]] Ticks round_ticks(double lo, double hi, int wanted);

/// `value` with so many decimals, the minus sign as U+2212; "-0.0" is written "0.0". Not finite: an en dash.
[[nodiscard]] std::string number_text(double value, int decimals);

/// `value` with so many significant digits (at least the whole part), as number_text writes it: 8.2, 0.35, 250.
[[nodiscard]] std::string significant_text(double value, int digits);

}  // namespace tandem::netsim::plot
