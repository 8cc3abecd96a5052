#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tandem {

/// Returns the columns that UTF-8 text takes on a terminal, one per character.
[[nodiscard]] inline std::size_t display_width(std::string_view text) noexcept {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Wraps one line of text at spaces. A single word wider than `width` gets a line of its own, uncut.
/// @param width   largest number of columns of a line
/// @param indent  spaces before every line but the first
/// @param first   columns already used on the first line
/// @return the lines without line ends; at least one
[[nodiscard]] inline std::vector<std::string> wrap_words(std::string_view text, std::size_t width,
                                                         std::size_t indent = 0, std::size_t first = 0) {
  std::vector<std::string> lines{""};
  std::size_t used = first;
  bool empty = true;  // no word on the line yet
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const std::size_t needs = display_width(word) + (empty ? 0 : 1);
    if (used + needs > width && !empty) {
      while (!lines.back().empty() && lines.back().back() == ' ') lines.back().pop_back();
      lines.emplace_back(indent, ' ');
      used = indent;
      empty = true;
    }
    if (!empty) {
      lines.back() += ' ';
      ++used;
    }
    lines.back() += word;
    used += display_width(word);
    empty = false;
    if (end == text.size()) break;
    at = end + 1;
  }
  return lines;
}

}  // namespace tandem
