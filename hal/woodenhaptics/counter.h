#pragma once

#include <cstdint>
#include <cstdlib>

namespace tandem::hal::woodenhaptics {

/// An int16 counter that runs on past its wrap: modular differences are added up, so a wrap is no jump (a 4096-count
/// board is preset near 27140, close to it). Ambiguous only for more than 32767 counts between two readings.
class Counter {
 public:
  /// From now on the counter is at `count`, whatever the board's says.
  void set(std::int32_t count, std::int16_t board) noexcept { total_ = count, last_ = board; }
  /// Takes a reading. @return how far it moved since the one before [counts]
  int take(std::int16_t board) noexcept {
    const int moved = difference(board, last_);
    last_ = board;
    // A counter that is spun for ever wraps the sum too, far outside any mechanism.
    total_ = static_cast<std::int32_t>(static_cast<std::uint32_t>(total_) + static_cast<std::uint32_t>(moved));
    return moved;
  }
  [[nodiscard]] std::int32_t total() const noexcept { return total_; }

  /// a - b on the circle of 2^16, -32768..32767.
  [[nodiscard]] static int difference(std::int16_t a, std::int16_t b) noexcept {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(static_cast<std::uint16_t>(a) - static_cast<std::uint16_t>(b)));
  }

 private:
  std::int32_t total_ = 0;
  std::int16_t last_ = 0;
};

}  // namespace tandem::hal::woodenhaptics
