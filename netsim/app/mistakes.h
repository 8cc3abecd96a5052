#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tandem::netsim {

/// All that is wrong with what a person typed and the files named there, told together before anything starts.
class Mistakes {
 public:
  static constexpr int kWrong = 2;  ///< exit code: wrong arguments or files

  /// @param text  one mistake per line; a line that ends in a colon belongs to the next. Empty: nothing
  void add(std::string_view text);
  [[nodiscard]] bool none() const noexcept { return lines_.empty(); }
  [[nodiscard]] std::size_t count() const noexcept;

  /// Says them on standard error, with how many there are. @return kWrong
  [[nodiscard]] int refuse(std::string_view command) const;

 private:
  std::vector<std::string> lines_;
};

/// One mistake alone.
[[nodiscard]] int refuse(std::string_view command, std::string_view text);

}  // namespace tandem::netsim
