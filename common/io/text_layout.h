#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/wrap_words.h"

/// Text layout for terminals of any width: lines end between words, never inside one.
namespace tandem::io {

using tandem::display_width;
using tandem::wrap_words;

/// One part of a screen, shown whole or not at all.
struct ScreenItem {
  std::string text;
  std::string brief;  ///< shown where `text` does not fit; empty: no shorter form
  std::size_t row = 0;
  bool stays = false;  ///< omitted where its row is full, instead of moved to the next one
};

/// Lays out items in at most `rows` lines of at most `width` columns. The items are in order of importance. An item
/// that does not fit into its row moves to the next one; one that does not fit there either is omitted. The very first
/// item is always shown, cut after a word if necessary.
[[nodiscard]] std::vector<std::string> lay_out_items(std::span<const ScreenItem> items, std::size_t rows,
                                                     std::size_t width);

/// Returns all items on one line, for files and pipes.
[[nodiscard]] std::string join_items(std::span<const ScreenItem> items);

}  // namespace tandem::io
