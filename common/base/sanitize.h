#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace tandem {

/// Returns at most the first `max` bytes of a text, without splitting a UTF-8 character.
[[nodiscard]] inline std::string truncate_utf8(std::string_view text, std::size_t max) {
  if (text.size() <= max) return std::string(text);
  while (max > 0 && (static_cast<unsigned char>(text[max]) & 0xc0U) == 0x80) --max;
  return std::string(text.substr(0, max));
}

/// Returns foreign text in a form that is safe on a terminal. Control characters, characters that reorder or hide text,
/// and bytes that are not UTF-8 [RFC 3629] are replaced by their number (`\x1b`, `\u202e`).
/// @param max  number of bytes of the text that are shown [bytes]; `...` follows if text was cut
[[nodiscard]] inline std::string sanitize(std::string_view text, std::size_t max = 480) {
  const std::string shown = truncate_utf8(text, max);
  const bool cut = shown.size() < text.size();
  text = shown;
  std::string out;
  const auto number = [&out](const char* form, std::uint32_t value) {
    std::array<char, 12> digits;
    std::snprintf(digits.data(), digits.size(), form, value);
    out += digits.data();
  };
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t more = lead < 0x80   ? 0
                             : lead < 0xc2 ? 4
                             : lead < 0xe0 ? 1
                             : lead < 0xf0 ? 2
                             : lead < 0xf5 ? 3
                                           : 4;
    std::uint32_t point = more == 0 ? lead : lead & (0x3fU >> (more & 3U));
    bool good = more < 4 && i + more < text.size();
    for (std::size_t k = 1; good && k <= more; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      good = (next & 0xc0U) == 0x80;
      point = point << 6 | (next & 0x3fU);
    }
    good = good && (more < 2 || point >= (more == 2 ? 0x800U : 0x10000U)) && point <= 0x10ffff &&
           !(point >= 0xd800 && point <= 0xdfff);
    const bool steers = point < 0x20 || (point >= 0x7f && point < 0xa0);
    const bool hides = point == 0xad || point == 0x61c || point == 0x180e || (point >= 0x200b && point <= 0x200f) ||
                       (point >= 0x2028 && point <= 0x202e) || (point >= 0x2060 && point <= 0x206f) ||
                       point == 0xfeff || (point >= 0xe0000 && point <= 0xe007f);
    if (!good) {
      number("\\x%02x", lead);
      ++i;
      continue;
    }
    if (steers || hides) {
      number(point < 0x80 ? "\\x%02x" : "\\u%04x", point);
    } else {
      out += text.substr(i, more + 1);
    }
    i += more + 1;
  }
  return cut ? out + "..." : out;
}

}  // namespace tandem
