#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/core/device.h"

namespace tandem::hal {

/// Parsed device specification `--device BACKEND[:NAME][,KEY=VALUE]...`, for all devices except simulated ones.
struct DeviceSpec {
  struct Option {
    std::string key, value;
  };
  std::string backend;
  std::string name;  ///< device name as printed by `doctor`; empty: the only device
  std::vector<Option> options;
  /// Words that are neither NAME nor KEY=VALUE, and duplicates; OptionParser reports them.
  std::vector<std::string> errors;

  [[nodiscard]] std::optional<std::string> find(std::string_view key) const;
};

/// Parses a device specification. Error: the backend is missing.
/// All other errors are kept in `errors`, so that the backend, which knows its options, reports everything together.
[[nodiscard]] Result<DeviceSpec> parse_device_spec(std::string_view spec);

/// Validates the options of one device specification and collects all errors, so that the user sees them together.
class OptionParser {
 public:
  /// An option that is not in `known` is an error: it names the option, its value, the nearest and all known ones.
  OptionParser(const DeviceSpec& choice, const std::vector<std::string>& known);

  /// Returns the value of `key` if it is present and one of `allowed`, else the first of them.
  [[nodiscard]] std::string one_of(std::string_view key, std::initializer_list<std::string_view> allowed);
  [[nodiscard]] bool yes_or_no(std::string_view key, bool otherwise);
  /// Returns a finite decimal number in [lo, hi]; nullopt: missing or invalid.
  [[nodiscard]] std::optional<double> number(std::string_view key, double lo, double hi, std::string_view unit);

  /// Adds an error about the specification. @param what  such as "needs preset=NAME"
  void add_error(std::string what);
  /// Adds an error text unchanged, for example of a file with its line. May have several lines.
  void add_lines(std::string lines);

  [[nodiscard]] bool valid() const noexcept { return mistakes_.empty(); }
  /// Returns success, or error kUnsupported with one line per error.
  [[nodiscard]] Result<> result() const;
  /// Returns `value`, or the error of `result()`.
  template <class T>
  [[nodiscard]] Result<T> result_with(T value) const {
    if (auto fine = result(); !fine) return std::unexpected(std::move(fine.error()));
    return value;
  }

 private:
  const DeviceSpec* choice_;
  std::vector<std::string> mistakes_;
};

/// Returns the error of parsed options, if any, without their value.
template <class T>
[[nodiscard]] Result<> without_value(const Result<T>& parsed) {
  return parsed ? Result<>{} : std::unexpected(parsed.error());
}

}  // namespace tandem::hal
