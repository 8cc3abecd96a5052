#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Round numbers for axes. Pure functions.
namespace tandem::netsim::plot {

/// Values to print at an axis: multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  std::vector<double> values;
  int decimals = 0;  ///< decimals that print every value exactly
};

/// Returns round numbers within [lo, hi], about `wanted` of them and never more than 2 * wanted + 2. Bounds that are
/// not finite or not in order give no ticks.
[[nodiscard]] Ticks round_ticks(double lo, double hi, int wanted);

/// Returns `value` with this number of decimals and the minus sign U+2212; "-0.0" is printed as "0.0". A value that is
/// not finite gives an en dash.
[[nodiscard]] std::string number_text(double value, int decimals);

/// Returns `value` with this number of significant digits (at least the integer part), in the form of number_text: 8.2,
/// 0.35, 250.
[[nodiscard]] std::string significant_text(double value, int digits);

}  // namespace tandem::netsim::plot
