#include "common/trust/limiter.h"

namespace tandem::trust {

Source Source::of_v6(const std::array<std::uint8_t, 16>& a) noexcept {
  const auto number = [&a](std::size_t from, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = from; i < from + count; ++i) value = value << 8 | a[i];
    return value;
  };
  if (number(0, 8) == 0 && number(8, 4) == 0xffff) return v4(static_cast<std::uint32_t>(number(12, 4)));
  const bool loopback = number(0, 8) == 0 && number(8, 8) == 1;
  // ::1 shares its 64 bits with nobody but itself as far as limits go.
  return {number(0, 8), true, loopback};
}

}  // namespace tandem::trust
