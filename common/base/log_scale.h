#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tandem {

/// Bins whose width grows with the value: exact below 64, then 32 bins per octave, so a bin is at most 1/32 (3.2 %)
/// wide. The idea is that of HdrHistogram [Tene 2012].
struct LogScale {
  static constexpr int kSubBits = 5;  ///< 2^5 bins per octave
  static constexpr std::uint64_t kExact = std::uint64_t{2} << kSubBits;
  static constexpr std::size_t kBins = static_cast<std::size_t>(64 - kSubBits) << kSubBits;  ///< for 0 to 2^63

  /// Returns the bin: the octave of the value, followed by its top kSubBits + 1 bits.
  [[nodiscard]] static constexpr std::size_t bin_of(std::uint64_t value) noexcept {
    if (value < kExact) return static_cast<std::size_t>(value);
    const int shift = static_cast<int>(std::bit_width(value)) - kSubBits - 1;
    return (static_cast<std::size_t>(shift) << kSubBits) + static_cast<std::size_t>(value >> shift);
  }
  /// Returns the largest value of a bin.
  [[nodiscard]] static constexpr std::int64_t last_of(std::size_t bin) noexcept {
    if (bin < kExact) return static_cast<std::int64_t>(bin);
    const int shift = static_cast<int>(bin >> kSubBits) - 1;
    const std::uint64_t top = (bin & ((std::size_t{1} << kSubBits) - 1)) | (std::uint64_t{1} << kSubBits);
    return static_cast<std::int64_t>((((top + 1) << shift) - 1) &
                                     std::uint64_t{std::numeric_limits<std::int64_t>::max()});
  }
};

}  // namespace tandem
