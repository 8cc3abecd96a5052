#include "common/io/text_layout.h"

#include <algorithm>

namespace tandem::io {
namespace {

constexpr std::string_view kBetween = " | ";

/// Returns the leading words that fit into `width` columns, then `...`.
std::string cut_after_word(const std::string& text, std::size_t width) {
  if (display_width(text) <= width) return text;
  const std::vector<std::string> lines = wrap_words(text, width > 4 ? width - 4 : 1);
  return lines.empty() || display_width(lines.front()) + 4 > width ? std::string() : lines.front() + " ...";
}

/// An item of a line, in the form that is shown.
struct Placed {
  const ScreenItem* item;
  std::string text;
};

}  // namespace

std::vector<std::string> lay_out_items(std::span<const ScreenItem> items, std::size_t rows, std::size_t width) {
  std::vector<std::string> lines;
  std::vector<const ScreenItem*> waiting;
  for (std::size_t row = 0; row < rows; ++row) {
    // Items that did not fit above are more important than the items of this row.
    std::vector<const ScreenItem*> here = std::move(waiting);
    waiting.clear();
    for (const ScreenItem& item : items)
      if (item.row == row && !item.text.empty()) here.push_back(&item);
    // Shortest forms first, so that no item displaces another by its details; then longer forms as far as space allows.
    std::vector<Placed> placed;
    std::size_t used = 0;
    for (const ScreenItem* item : here) {
      const std::string& shortest = item->brief.empty() ? item->text : item->brief;
      const std::size_t needs = display_width(shortest) + (placed.empty() ? 0 : kBetween.size());
      if (used + needs <= width) {
        placed.push_back({item, shortest});
        used += needs;
      } else if (lines.empty() && placed.empty()) {
        placed.push_back({item, cut_after_word(shortest, width)});
        used = display_width(placed.back().text);
      } else if (!item->stays) {
        waiting.push_back(item);
      }
    }
    std::string line;
    for (Placed& p : placed) {
      const std::size_t more =
          display_width(p.item->text) - std::min(display_width(p.item->text), display_width(p.text));
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

std::string join_items(std::span<const ScreenItem> items) {
  std::string line;
  for (const ScreenItem& item : items)
    if (!item.text.empty()) line += (line.empty() ? "" : std::string(kBetween)) + item.text;
  return line;
}

}  // namespace tandem::io
