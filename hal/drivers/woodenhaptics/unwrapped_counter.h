#pragma once

#include <cstdint>
#include <cstdlib>

namespace tandem::hal::woodenhaptics {

/// Unwrapped int16 counter: it sums modular differences, so a wrap is no jump. A 4096-count board is preset near 27140,
/// close to a wrap.
/// Ambiguous only for more than 32767 counts between two readings.
class UnwrappedCounter {
 public:
  /// Sets the total to `count` for the board's counter value `board`.
  void set(std::int32_t count, std::int16_t board) noexcept { total_ = count, last_ = board; }
  /// Takes a reading. @return difference to the previous reading [counts]
  int take(std::int16_t board) noexcept {
    const int moved = difference(board, last_);
    last_ = board;
    // Endless rotation in one direction wraps the sum too; this is far outside any mechanism.
    total_ = static_cast<std::int32_t>(static_cast<std::uint32_t>(total_) + static_cast<std::uint32_t>(moved));
    return moved;
  }
  [[nodiscard]] std::int32_t total() const noexcept { return total_; }

  /// Returns a - b modulo 2^16, -32768..32767.
  [[nodiscard]] static int difference(std::int16_t a, std::int16_t b) noexcept {
    return static_cast<std::int16_t>(
        static_cast<std::uint16_t>(static_cast<std::uint16_t>(a) - static_cast<std::uint16_t>(b)));
  }

 private:
  std::int32_t total_ = 0;
  std::int16_t last_ = 0;
};

}  // namespace tandem::hal::woodenhaptics
