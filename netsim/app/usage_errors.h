#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tandem::netsim {

/// Collects all errors of the arguments and of the files they name, so that a command reports them together before it
/// starts.
class UsageErrors {
 public:
  static constexpr int kUsageError = 2;  ///< exit code: wrong arguments or files

  /// Adds errors. @param text  one error per line; a line that ends in a colon belongs to the next. Empty: no error
  void add(std::string_view text);
  [[nodiscard]] bool empty() const noexcept { return lines_.empty(); }
  [[nodiscard]] std::size_t count() const noexcept;

  /// Prints the errors and their number to standard error. @return kUsageError
  [[nodiscard]] int report(std::string_view command) const;

 private:
  std::vector<std::string> lines_;
};

/// Reports a single error. @return UsageErrors::kUsageError
[[nodiscard]] int report_usage_error(std::string_view command, std::string_view text);

}  // namespace tandem::netsim
