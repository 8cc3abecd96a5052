#include "common/io/option_check.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string_view>

namespace tandem::io {

OptionCheck number_in(double lo, double hi, const std::string& unit) {
  std::ostringstream range;
  range.precision(12);  // 3000000, not 3e+06
  range << "[" << lo << ", " << hi << "]" << (unit.empty() ? "" : " " + unit);
  const std::string allowed = range.str();
  const auto check = [lo, hi, allowed, unit](std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    std::string_view rest{end, static_cast<std::size_t>(text.data() + text.size() - end)};
    while (error == std::errc{} && end != text.data() && rest.starts_with(' ')) rest.remove_prefix(1);
    const bool number = error == std::errc{} && std::isfinite(value);
    const bool looks_like_unit = !rest.empty() && rest.find_first_of("0123456789.,+-") == std::string_view::npos;
    if (number && looks_like_unit && rest != unit)
      return "\"" + text + "\" has the unit " + std::string(rest) + ": must be a number in " + allowed +
             (unit.empty() ? ", without a unit" : "; the unit is " + unit + ", and may be left out");
    if (!number || (!rest.empty() && rest != unit)) return "\"" + text + "\" is not a number: must be in " + allowed;
    if (value < lo || value > hi) return "\"" + text + "\" is out of range: must be in " + allowed;
    text.resize(static_cast<std::size_t>(end - text.data()));
    return std::string{};
  };
  return {check, "in " + allowed};
}

OptionCheck whole_number() {
  const auto check = [](std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size()) return std::string{};
    return "\"" + text + "\" is not a whole number in [0, 18446744073709551615]";
  };
  return {check, "whole number"};
}

OptionCheck whole_number_in(double lo, double hi) {
  const OptionCheck range = number_in(lo, hi, ""), whole = whole_number();
  const auto check = [range, whole](std::string& text) {
    std::string error = range(text);
    if (!error.empty() || whole(text).empty()) return error;
    return "\"" + text + "\" is not a whole number " + range.allowed();
  };
  return {check, range.allowed()};
}

}  // namespace tandem::io
