#include "netsim/plot/ticks.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tandem::netsim::plot {

Ticks round_ticks(double lo, double hi, int wanted) {
  Ticks ticks;
  if (!std::isfinite(lo) || !std::isfinite(hi) || !(lo < hi) || wanted < 1) return ticks;
  const double raw = (hi - lo) / wanted;
  const double power = std::floor(std::log10(raw));
  const double unit = std::pow(10, power);
  if (!(unit > 0) || !std::isfinite(unit)) return ticks;
  const double ratio = raw / unit;  // [1, 10)
  const double step = (ratio <= 1 ? 1 : ratio <= 2 ? 2 : ratio <= 5 ? 5 : 10) * unit;
  const double first = std::ceil(lo / step - 1e-9), last = std::floor(hi / step + 1e-9);
  if (!(std::abs(first) < 1e12) || last - first > 2 * wanted + 2) return ticks;  // the span is lost in rounding
  for (double k = first; k <= last; ++k) ticks.values.push_back(k * step);
  ticks.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return ticks;
}

std::string number_text(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  char digits[400];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, std::abs(value), std::chars_format::fixed, decimals).ptr;
  const std::string_view text{digits, static_cast<std::size_t>(end - digits)};
  const bool zero = text.find_first_of("123456789") == std::string_view::npos;
  return (value < 0 && !zero ? "−" : "") + std::string(text);
}

std::string significant_text(double value, int digits) {
  if (!std::isfinite(value) || value == 0) return number_text(value, 0);
  // 9.96 with two digits is 10, not 10.0: the digits of the rounded value count.
  const double scale = std::pow(10, digits - 1 - std::floor(std::log10(std::abs(value))));
  const double rounded = std::round(value * scale) / scale;
  const int whole = static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-12)) + 1;
  return number_text(value, std::clamp(digits - whole, 0, 9));
}

}  // namespace tandem::netsim::plot
