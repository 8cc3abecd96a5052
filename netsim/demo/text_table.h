#pragma once

#include <string>

#include "netsim/demo/comparison.h"

/// The comparison for a terminal. Pure.
namespace tandem::netsim::demo {

inline constexpr std::size_t kTextWidth = 110;       ///< characters in a line, at most
inline constexpr std::size_t kNarrowTextWidth = 79;  ///< the least: each number's name stands on a line above it

/// @param colour  ANSI colours for the marks and headings  @param width  columns that there are
[[nodiscard]] std::string to_text(const Comparison& comparison, bool colour, std::size_t width = kTextWidth);

/// Characters of UTF-8 text as a terminal counts them (all of ours are one column wide).
[[nodiscard]] std::size_t width_of(std::string_view text) noexcept;

/// Breaks at spaces into lines of at most `width`; lines after the first begin with `indent`.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t width, const std::string& indent);

/// ✓, ✗ or nothing.
[[nodiscard]] std::string_view symbol(Mark mark) noexcept;

}  // namespace tandem::netsim::demo
