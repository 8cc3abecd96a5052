#pragma once

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

/// Text for people: lines end between words, as wide as whoever reads them has room.
namespace tandem::io {

/// Columns that text for people on `file` may take: one less than its terminal has; elsewhere one less than the environment variable COLUMNS says.
/// Nothing: lines stay as they are.
[[nodiscard]] std::optional<std::size_t> text_width(std::FILE* file) noexcept;

/// Text for a person on `file`: every line is broken between words at `text_width`, commands with a backslash. Continued lines begin below the second
/// column of a table where there is one.
[[nodiscard]] std::string for_terminal(std::string_view text, std::FILE* file);
/// The same at a given width.
[[nodiscard]] std::string broken(std::string_view text, std::size_t width);

/// Prints text for a person, as `for_terminal` breaks it.
void print(std::FILE* file, std::string_view text);
/// The same, formatted as by printf.
__attribute__((format(printf, 2, 3))) void printf_for_people(std::FILE* file, const char* format, ...);

/// Whether nobody reads what is written to `file` any more, as in `tandem-netsim profiles | head -1`.
[[nodiscard]] bool reader_gone(std::FILE* file) noexcept;

}  // namespace tandem::io
