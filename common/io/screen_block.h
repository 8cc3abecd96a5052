#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tandem::io {

/// What the environment variable COLUMNS says, if it is a width; 0: nothing.
[[nodiscard]] std::size_t columns_given() noexcept;
/// Columns and rows of the terminal behind a file descriptor, asked anew each time; where there is none what COLUMNS says, else 80, and 24.
struct ScreenSize {
  std::size_t columns = 80, rows = 24;
};
[[nodiscard]] ScreenSize screen_size(int fd) noexcept;

/// A few lines that stay in their place at the end of standard error. The cursor rests at the start of the first of them: a terminal that is
/// resized, whether it reflows lines or cuts them, keeps it there, so that erasing from the cursor on leaves nothing behind.
class ScreenBlock {
 public:
  /// Replaces what is shown. @param lines  each less wide than the terminal (see text_layout.h); a wider one is left out
  static void show(std::span<const std::string> lines);
  /// Takes the lines away, so that something else can be printed.
  static void clear();
  /// What clears the block, to be written before a line of the log; empty if none is shown. The block counts as cleared afterwards.
  [[nodiscard]] static const char* take_clearing() noexcept;
};

}  // namespace tandem::io
