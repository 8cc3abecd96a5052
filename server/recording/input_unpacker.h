#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "proto/spec/lesson.h"

namespace tandem::server {

/// Restores the pieces of the input journal from the blocks of a recording (server/recording/input_block.h).
class InputUnpacker {
 public:
  /// @param lesson  rows of the recording that has the blocks; outlives this
  explicit InputUnpacker(const Lesson& lesson) : lesson_(&lesson) {}

  /// Returns a piece as InputJournal::drain gave it, valid until the next call: position (u64), then bytes. Any bytes
  /// are safe; nullopt: they are no block, or their piece would be longer than input_block::kPieceMax.
  [[nodiscard]] std::optional<std::span<const std::byte>> unpack(std::span<const std::byte> block);

 private:
  const Lesson* lesson_;
  std::vector<std::byte> piece_;
};

}  // namespace tandem::server
