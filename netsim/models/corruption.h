#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"

namespace tandem::netsim {

/// Change of the bytes of a delivered datagram. The path draws it once; original and copy share it.
struct Corruption {
  enum class Kind : std::uint8_t { kNone, kBitFlips, kTruncated } kind = Kind::kNone;
  std::uint32_t bits = 0;    ///< kBitFlips: number of distinct bits to flip; all bits if the datagram has fewer
  std::uint32_t length = 0;  ///< kTruncated: remaining bytes
  std::uint64_t seed = 0;    ///< seed of the bit positions

  friend bool operator==(const Corruption&, const Corruption&) = default;
};

/// Maximum number of bits flipped in one datagram. The bound lets `apply_corruption` choose positions without heap.
inline constexpr std::uint32_t kFlipsMax = 64;

/// Applies `damage` to `bytes` in place.
/// @return number of remaining bytes, counted from the first
std::size_t apply_corruption(const Corruption& damage, std::span<std::byte> bytes) noexcept TANDEM_REALTIME;

}  // namespace tandem::netsim
