#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tandem::io {

/// Wraps hand-written help at `width`. Paragraphs are filled and tables keep their columns. Commands in examples are
/// continued with a backslash, so that users can copy them. A line that begins with a space belongs to a table or an
/// example. A blank line, a heading and `Exit:` begin a new paragraph.
[[nodiscard]] std::string fill_paragraphs(std::string_view text, std::size_t width);

/// Wraps one line of other text between words: a command with a backslash, a table row below its second column.
[[nodiscard]] std::string wrap_line(std::string_view line, std::size_t width);

/// Returns a row of a table of options: name and description side by side, or below each other if the name is long.
[[nodiscard]] std::string option_row(const std::string& name, const std::string& description, std::size_t width);

}  // namespace tandem::io
