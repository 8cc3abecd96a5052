#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string>

namespace tandem::io {

/// A decimal number in [lo, hi]: whole text, finite. CLI11's own ranges let `nan` pass.
[[nodiscard]] inline CLI::Validator number_in(double lo, double hi, const std::string& unit) {
  std::ostringstream range;
  range.precision(12);  // 3000000, not 3e+06
  range << "[" << lo << ", " << hi << "]" << (unit.empty() ? "" : " " + unit);
  const std::string allowed = range.str();
  const auto check = [lo, hi, allowed](std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
    if (number && value >= lo && value <= hi) return std::string{};
    return "\"" + text + "\" " + (number ? "is out of range" : "is not a number") + ": must be in " + allowed;
  };
  return {check, "in " + allowed};
}

/// A whole number from 0 to 2^64 - 1.
[[nodiscard]] inline CLI::Validator whole_number() {
  const auto check = [](std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size()) return std::string{};
    return "\"" + text + "\" is not a whole number in [0, 18446744073709551615]";
  };
  return {check, "whole number"};
}

}  // namespace tandem::io
