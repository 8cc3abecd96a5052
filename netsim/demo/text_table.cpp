#include "netsim/demo/text_table.h"

#include <algorithm>

#include "common/base/wrap_words.h"

namespace tandem::netsim::demo {
namespace {

constexpr std::size_t kLabel = 44, kNarrowLabel = 12, kPaper = 6, kValue = 7,
                      kLimit = 9;  // a cell has 20 columns: value, limit, mark, gaps

/// Returns the spaces that widen a text to `width` columns.
std::string spaces(std::string_view text, std::size_t width) {
  return std::string(width - std::min(width, display_width(text)), ' ');
}
std::string left(std::string_view text, std::size_t width) { return std::string(text) + spaces(text, width); }
std::string right(std::string_view text, std::size_t width) { return spaces(text, width) + std::string(text); }

/// ANSI escapes; without colour the plain text.
struct Paint {
  bool on;
  [[nodiscard]] std::string operator()(const char* code, const std::string& text) const {
    return on && !text.empty() ? std::string("\x1b[") + code + "m" + text + "\x1b[0m" : text;
  }
};

void trim(std::string& line) {
  while (!line.empty() && line.back() == ' ') line.pop_back();
}

std::string row_text(const Row& row, const Paint& paint, bool narrow) {
  std::string label = "  " + row.label;
  if (!row.unit.empty()) label += " [" + row.unit + "]";
  if (!row.notes.empty()) label += " (" + row.notes + ")";
  std::string line =
      (narrow ? label + "\n" + std::string(kNarrowLabel, ' ') : left(label, kLabel)) + right(row.paper, kPaper);
  for (const Cell& cell : row.cells) {
    const std::string mark(symbol(cell.mark));
    line += right(cell.value, kValue) + " " + paint("2", left(cell.limit, kLimit)) + " ";
    line += mark.empty() ? " " : paint(cell.mark == Mark::kMet ? "32" : "31;1", mark);
    line += ' ';
  }
  trim(line);
  return line + "\n";
}

}  // namespace

std::string_view symbol(Mark mark) noexcept { return mark == Mark::kMet ? "✓" : mark == Mark::kMissed ? "✗" : ""; }

std::string to_text(const Comparison& comparison, bool colour, std::size_t width) {
  const Paint paint{colour};
  const bool narrow = width < kTextWidth;
  width = narrow ? kNarrowTextWidth : kTextWidth;
  std::string rule;
  for (std::size_t k = 0; k < width; ++k) rule += "─";
  std::string head = left("", narrow ? kNarrowLabel : kLabel) + right("paper", kPaper);
  for (const char* column : {"  the paper’s gains", "  Tandem’s defaults", "  on the bad network"})
    head += left(column, 20);
  trim(head);
  std::string out = rule + "\n" + paint("1", head) + "\n" + rule + "\n";
  for (const Section& section : comparison.sections) {
    out += paint("1", section.title) + "\n";
    for (const Row& row : section.rows) out += row_text(row, paint, narrow);
  }
  out += rule + "\n";
  char letter = 'a';
  for (const std::string& note : comparison.footnotes)
    for (const std::string& line : wrap_words(std::string("(") + letter++ + ") " + note, width, 4)) out += line + "\n";
  return out;
}

}  // namespace tandem::netsim::demo
