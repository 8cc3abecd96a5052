#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proto/text/text_format_reader.h"

/// Private to proto/text: parts that the readers and writers of registry files share.
namespace tandem::text {

/// Fills `out` from lower-case hex. @return whether the text is exactly that
[[nodiscard]] inline bool from_lower_hex(std::string_view hex, std::span<std::byte> out) {
  constexpr std::string_view kHexDigits = "0123456789abcdef";
  if (hex.size() != 2 * out.size()) return false;
  for (std::size_t i = 0; i < hex.size(); ++i) {
    const auto digit = kHexDigits.find(hex[i]);
    if (digit == std::string_view::npos) return false;
    out[i / 2] |= static_cast<std::byte>(i % 2 == 0 ? digit << 4 : digit);
  }
  return true;
}

template <std::size_t N>
std::array<std::byte, N> bytes_from(const std::string& hex, MessageValidator& validator, const std::string& key) {
  std::array<std::byte, N> out{};
  if (!from_lower_hex(hex, out) && validator.is_set(key))
    validator.error(key, "must be " + std::to_string(2 * N) + " lower-case hex digits");
  return out;
}

template <class File>
File read_registry_file(std::string_view text, MessageValidator& validator) {
  File file;
  if (text.size() > kTextMax) {
    validator.error_at({}, "", "is longer than 1 MiB");
    return file;
  }
  read_text_format(text, file, validator);
  validator.check_limits(file);
  return file;
}

inline std::string registry_header(std::string_view what) {
  return "# " + std::string(what) + " Written by Tandem: a program that runs may replace it.\n";
}

template <class T>
std::expected<T, InputErrors> registry_verdict(T&& value, MessageValidator& validator) {
  if (validator.ok()) return std::forward<T>(value);
  return std::unexpected(validator.take());
}

}  // namespace tandem::text
