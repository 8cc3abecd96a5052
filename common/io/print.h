#pragma once

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

/// Text output for users: lines are wrapped between words at the width of the display.
namespace tandem::io {

/// Returns the columns for text on `file`: the width of its terminal minus one, else the environment variable COLUMNS
/// minus one. nullopt: lines stay as they are.
[[nodiscard]] std::optional<std::size_t> text_width(std::FILE* file) noexcept;

/// Wraps every line of text for `file` between words at `text_width`, commands with a backslash. In tables, continued
/// lines begin below the second column.
[[nodiscard]] std::string wrap_for_terminal(std::string_view text, std::FILE* file);
/// The same at a given width.
[[nodiscard]] std::string wrap_text(std::string_view text, std::size_t width);

/// Prints text for users, wrapped by `wrap_for_terminal`.
void print(std::FILE* file, std::string_view text);
/// The same, formatted as by printf.
__attribute__((format(printf, 2, 3))) void print_formatted(std::FILE* file, const char* format, ...);

/// Returns whether the reader of `file` has closed its end, as in `tandem-netsim profiles | head -1`.
[[nodiscard]] bool reader_closed(std::FILE* file) noexcept;

}  // namespace tandem::io
