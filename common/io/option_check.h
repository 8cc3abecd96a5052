#pragma once

#include <functional>
#include <string>
#include <utility>

namespace tandem::io {

/// Check of the text that a user gives for an option.
class OptionCheck {
 public:
  /// @param test     returns an error, or an empty string; may rewrite the text
  /// @param allowed  the allowed values, for the help
  OptionCheck(std::function<std::string(std::string&)> test, std::string allowed)
      : test_(std::move(test)), allowed_(std::move(allowed)) {}

  [[nodiscard]] std::string operator()(std::string& text) const { return test_(text); }
  [[nodiscard]] const std::string& allowed() const noexcept { return allowed_; }

 private:
  std::function<std::string(std::string&)> test_;
  std::string allowed_;
};

/// Accepts a decimal number in [lo, hi]: whole text, finite. Where the unit is fixed, it may follow the number (`20`,
/// `20ms`, `20 ms`). Another unit is an error, because nothing is converted. The text becomes the bare number.
[[nodiscard]] OptionCheck number_in(double lo, double hi, const std::string& unit);

/// Accepts a whole number from 0 to 2^64 - 1.
[[nodiscard]] OptionCheck whole_number();

/// Accepts a whole number in [lo, hi].
[[nodiscard]] OptionCheck whole_number_in(double lo, double hi);

}  // namespace tandem::io
