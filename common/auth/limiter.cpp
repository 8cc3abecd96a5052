#include "common/auth/limiter.h"

namespace tandem::auth {

Source Source::of_v6(const std::array<std::uint8_t, 16>& a) noexcept {
  const auto number = [&a](std::size_t from, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = from; i < from + count; ++i) value = value << 8 | a[i];
    return value;
  };
  if (number(0, 8) == 0 && number(8, 4) == 0xffff) return v4(static_cast<std::uint32_t>(number(12, 4)));
  const bool loopback = number(0, 8) == 0 && number(8, 8) == 1;
  // For these limits ::1 is alone in its 64-bit prefix.
  return {number(0, 8), true, loopback};
}

}  // namespace tandem::auth
