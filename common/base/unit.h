#pragma once

#include <string_view>

namespace tandem {

/// A number as typed, without the unit that is fixed for it: `20ms`, `20 ms` and `20` are `20` where `unit` is `ms`. Another unit stays, and is then no
/// number.
[[nodiscard]] constexpr std::string_view without_unit(std::string_view text, std::string_view unit) noexcept {
  if (unit.empty() || text.size() <= unit.size() || !text.ends_with(unit)) return text;
  const std::string_view number = text.substr(0, text.size() - unit.size());
  const std::size_t last = number.find_last_not_of(' ');
  const bool ends_in_digit = last != std::string_view::npos && (number[last] == '.' || (number[last] >= '0' && number[last] <= '9'));
  return ends_in_digit ? number.substr(0, last + 1) : text;
}

}  // namespace tandem
