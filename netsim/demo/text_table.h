#pragma once

#include <string>

#include "netsim/demo/comparison.h"

/// The comparison as text for a terminal. Pure functions.
namespace tandem::netsim::demo {

inline constexpr std::size_t kTextWidth = 110;       ///< largest number of characters in a line
inline constexpr std::size_t kNarrowTextWidth = 79;  ///< the smallest: each number has its name on a line above

/// Returns the table as text.
/// @param colour  whether marks and headings use ANSI colours
/// @param width   columns of the terminal
[[nodiscard]] std::string to_text(const Comparison& comparison, bool colour, std::size_t width = kTextWidth);

/// Returns ✓, ✗ or nothing.
[[nodiscard]] std::string_view symbol(Mark mark) noexcept;

}  // namespace tandem::netsim::demo
