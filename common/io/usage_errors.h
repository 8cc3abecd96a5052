#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::io {

/// Collects all errors of the arguments and of the files they name, so that a command reports them together before it
/// starts.
class UsageErrors {
 public:
  /// Adds errors. @param text  one error per line; a line that ends in a colon belongs to the next. Empty: no error
  void add(std::string_view text);
  /// Adds `OPTION: PROBLEM`. @param problem  empty: no error
  void add(std::string_view option, std::string_view problem);
  void add(const std::vector<std::string>& errors);

  /// Returns the number in `text`, in `unit` or without one. Text that is no number in [lo, hi]: adds an error, 0.
  double number(std::string_view option, std::string text, double lo, double hi, const std::string& unit);
  /// The same for an option that may be missing. @return 0 if `text` is empty
  double optional_number(std::string_view option, const std::string& text, double lo, double hi,
                         const std::string& unit);
  /// Adds an error if the file cannot be written. @param file  empty or `-`: none
  void output_file(std::string_view option, const std::string& file);

  [[nodiscard]] bool empty() const noexcept { return lines_.empty(); }
  [[nodiscard]] std::size_t count() const noexcept;

  /// Prints the errors to standard error, each after `prefix`. @return kExitUsage
  int print(std::string_view prefix) const;
  /// Prints the errors, then `COMMAND: N mistakes, OUTCOME`. @return kExitUsage
  int report(std::string_view command, std::string_view outcome = "nothing was started") const;
  /// Prints `COMMAND: ERROR` for each error, then `N mistakes; nothing was started`. @return kExitUsage
  int report_each(std::string_view command) const;

 private:
  [[nodiscard]] std::string count_text() const;

  std::vector<std::string> lines_;
};

/// Reports a single error as UsageErrors::report_each does.
int report_usage_error(std::string_view command, std::string_view text);

}  // namespace tandem::io
