#include "common/io/text_layout.h"

#include <algorithm>

namespace tandem::io {
namespace {

constexpr std::string_view kBetween = " | ";

/// The words from the front that fit into `width` columns, then `...`.
std::string cut_after_word(const std::string& text, std::size_t width) {
  if (columns_of(text) <= width) return text;
  const std::vector<std::string> lines = wrapped(text, width > 4 ? width - 4 : 1);
  return lines.empty() || columns_of(lines.front()) + 4 > width ? std::string() : lines.front() + " ...";
}

/// An item of a line, in the form that is shown.
struct Placed {
  const ScreenItem* item;
  std::string text;
};

}  // namespace

std::size_t columns_of(std::string_view text) noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width, std::size_t indent, std::size_t first) {
  std::vector<std::string> lines{""};
  std::size_t used = first;
  bool empty = true;  // no word stands on the line yet
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const std::size_t needs = columns_of(word) + (empty ? 0 : 1);
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
    used += columns_of(word);
    empty = false;
    if (end == text.size()) break;
    at = end + 1;
  }
  return lines;
}

std::vector<std::string> laid_out(std::span<const ScreenItem> items, std::size_t rows, std::size_t width) {
  std::vector<std::string> lines;
  std::vector<const ScreenItem*> waiting;
  for (std::size_t row = 0; row < rows; ++row) {
    // What did not fit above is more important than what belongs here.
    std::vector<const ScreenItem*> here = std::move(waiting);
    waiting.clear();
    for (const ScreenItem& item : items)
      if (item.row == row && !item.text.empty()) here.push_back(&item);
    // In their shortest forms first, so that no item is crowded out by another's details; then the longer forms as far as there is room.
    std::vector<Placed> placed;
    std::size_t used = 0;
    for (const ScreenItem* item : here) {
      const std::string& shortest = item->brief.empty() ? item->text : item->brief;
      const std::size_t needs = columns_of(shortest) + (placed.empty() ? 0 : kBetween.size());
      if (used + needs <= width) {
        placed.push_back({item, shortest});
        used += needs;
      } else if (lines.empty() && placed.empty()) {
        placed.push_back({item, cut_after_word(shortest, width)});
        used = columns_of(placed.back().text);
      } else if (!item->stays) {
        waiting.push_back(item);
      }
    }
    std::string line;
    for (Placed& p : placed) {
      const std::size_t more = columns_of(p.item->text) - std::min(columns_of(p.item->text), columns_of(p.text));
      if (used + more <= width) {
        p.text = p.item->text;
        used += more;
      }
      line += (line.empty() ? "" : std::string(kBetween)) + p.text;
    }
    if (!line.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::string joined(std::span<const ScreenItem> items) {
  std::string line;
  for (const ScreenItem& item : items)
    if (!item.text.empty()) line += (line.empty() ? "" : std::string(kBetween)) + item.text;
  return line;
}

}  // namespace tandem::io
