#include "netsim/quality/seen_numbers.h"

#include <algorithm>

namespace tandem::netsim {

SeenNumbers::Kind SeenNumbers::insert(std::uint64_t number) noexcept {
  const auto word = [this](std::uint64_t n) -> std::uint64_t& { return words_[(n % kNumbers) / 64]; };
  const std::uint64_t bit = std::uint64_t{1} << (number % 64);
  if (!any_ || number > newest_) {
    // Numbers in between were not seen; their old marks, from one round earlier, are cleared.
    const std::uint64_t between = any_ ? std::min(number - newest_ - 1, kNumbers - 1) : 0;
    for (std::uint64_t n = number - between; n < number; ++n) word(n) &= ~(std::uint64_t{1} << (n % 64));
    word(number) |= bit;
    newest_ = number;
    any_ = true;
    return Kind::kNewest;
  }
  if (newest_ - number >= kNumbers) return Kind::kReordered;
  if ((word(number) & bit) != 0) return Kind::kAgain;
  word(number) |= bit;
  return Kind::kReordered;
}

}  // namespace tandem::netsim
