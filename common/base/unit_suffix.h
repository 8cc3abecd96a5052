#pragma once

#include <string_view>

namespace tandem {

/// Returns a number as typed, without its fixed unit: `20ms`, `20 ms` and `20` give `20` where `unit` is `ms`. Another
/// unit stays and makes the text an invalid number.
[[nodiscard]] constexpr std::string_view strip_unit(std::string_view text, std::string_view unit) noexcept {
  if (unit.empty() || text.size() <= unit.size() || !text.ends_with(unit)) return text;
  const std::string_view number = text.substr(0, text.size() - unit.size());
  const std::size_t last = number.find_last_not_of(' ');
  const bool ends_in_digit =
      last != std::string_view::npos && (number[last] == '.' || (number[last] >= '0' && number[last] <= '9'));
  return ends_in_digit ? number.substr(0, last + 1) : text;
}

}  // namespace tandem
