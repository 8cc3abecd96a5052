#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"

namespace tandem::netsim {

/// How the bytes of a datagram that is delivered were changed under way. Drawn once by the path; the same for its copy.
struct Damage {
  enum class Kind : std::uint8_t { kNone, kBitFlips, kTruncated } kind = Kind::kNone;
  std::uint32_t bits = 0;    ///< kBitFlips: so many different bits, all there are if there are fewer
  std::uint32_t length = 0;  ///< kTruncated: bytes left
  std::uint64_t seed = 0;    ///< of the places of the bits

  friend bool operator==(const Damage&, const Damage&) = default;
};

/// Most bits that are ever flipped in one datagram: the places are found without memory of the heap.
inline constexpr std::uint32_t kFlipsMax = 64;

/// Does it to the bytes.
/// @return the bytes left, from the first on
std::size_t inflict(const Damage& damage, std::span<std::byte> bytes) noexcept TANDEM_REALTIME;

}  // namespace tandem::netsim
