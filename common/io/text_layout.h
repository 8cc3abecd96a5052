#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Text for terminals of any width: lines end between words, never inside one.
namespace tandem::io {

/// Columns that UTF-8 text takes on a terminal, one per character.
[[nodiscard]] std::size_t columns_of(std::string_view text) noexcept;

/// Breaks one line of text at spaces. A single word that is wider than `width` gets a line of its own, uncut.
/// @param indent  spaces before every line but the first  @param first  columns that are taken already on the first line
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t width, std::size_t indent = 0, std::size_t first = 0);

/// One piece of a screen, shown whole or not at all.
struct ScreenItem {
  std::string text;
  std::string brief;  ///< shown where `text` does not fit; empty: there is no shorter form
  std::size_t row = 0;
  bool stays = false;  ///< left out where its row has no room, instead of moved to the next one
};

/// Puts items into at most `rows` lines of at most `width` columns. The most important item stands first: an item that does not fit into its
/// row moves to the next one, and one that does not fit there either is left out. The very first item always stays: it is cut after a word if it must be.
[[nodiscard]] std::vector<std::string> laid_out(std::span<const ScreenItem> items, std::size_t rows, std::size_t width);

/// All items on one line, for files and pipes.
[[nodiscard]] std::string joined(std::span<const ScreenItem> items);

}  // namespace tandem::io
