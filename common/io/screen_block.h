#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tandem::io {

/// Returns the width in the environment variable COLUMNS; 0: none.
[[nodiscard]] std::size_t columns_from_environment() noexcept;
/// Present columns and rows of the terminal behind a file descriptor. Without a terminal: the width in COLUMNS, else
/// 80, and 24 rows.
struct ScreenSize {
  std::size_t columns = 80, rows = 24;
};
[[nodiscard]] ScreenSize screen_size(int fd) noexcept;

/// A status block of a few lines that keeps its place at the end of standard error. The cursor rests at the start of
/// its first line. A resized terminal keeps the cursor there, whether it reflows or cuts lines, so erasing from the
/// cursor on leaves no remains.
class ScreenBlock {
 public:
  /// Replaces the displayed lines. @param lines  each narrower than the terminal (see text_layout.h); a wider one is
  /// omitted
  static void show(std::span<const std::string> lines);
  /// Removes the lines, so that other text can be printed.
  static void clear();
  /// Returns the sequence that clears the block, to be written before a log line; empty if no block is shown. The block
  /// counts as cleared afterwards.
  [[nodiscard]] static const char* take_clear_sequence() noexcept;
};

}  // namespace tandem::io
