#include "netsim/models/corruption.h"

#include <algorithm>
#include <array>

#include "common/base/rng.h"

namespace tandem::netsim {

std::size_t apply_corruption(const Corruption& damage, std::span<std::byte> bytes) noexcept {
  if (damage.kind == Corruption::Kind::kTruncated) return std::min<std::size_t>(damage.length, bytes.size());
  if (damage.kind == Corruption::Kind::kNone) return bytes.size();
  // Floyd's sampling: every set of `flips` distinct positions is equally likely, with one draw each.
  const std::uint64_t places = std::uint64_t{bytes.size()} * 8;
  const std::uint64_t flips = std::min<std::uint64_t>({damage.bits, kFlipsMax, places});
  const RandomKey key{damage.seed};
  std::array<std::uint64_t, kFlipsMax> chosen{};
  for (std::uint64_t i = 0; i < flips; ++i) {
    const std::uint64_t last = places - flips + i;
    std::uint64_t place = key.bits(i) % (last + 1);
    const auto end = chosen.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(chosen.begin(), end, place) != end) place = last;
    chosen[i] = place;
    bytes[place / 8] ^= std::byte{1} << (place % 8);
  }
  return bytes.size();
}

}  // namespace tandem::netsim
