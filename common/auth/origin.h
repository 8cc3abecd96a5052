#pragma once

#include <array>
#include <compare>
#include <cstdint>

namespace tandem::auth {

/// The address of a connection and its network: the first 24 bits of an IPv4 address, the first 64 of an IPv6 one. An
/// IPv4 address inside IPv6 (::ffff:a.b.c.d) is the IPv4 one.
struct Origin {
  struct Network {
    bool v6 = false;
    std::uint64_t prefix = 0;
    friend auto operator<=>(const Network&, const Network&) = default;
  };
  Network network;
  std::uint64_t host = 0;  ///< the address within the network

  [[nodiscard]] static constexpr Origin v4(std::uint32_t address) noexcept {
    return {{false, address >> 8}, address & 0xff};
  }
  [[nodiscard]] static constexpr Origin of_v6(const std::array<std::uint8_t, 16>& address) noexcept {
    const auto number = [&address](std::size_t from, std::size_t count) {
      std::uint64_t value = 0;
      for (std::size_t i = from; i < from + count; ++i) value = value << 8 | address[i];
      return value;
    };
    if (number(0, 8) == 0 && number(8, 4) == 0xffff) return v4(static_cast<std::uint32_t>(number(12, 4)));
    return {{true, number(0, 8)}, number(8, 8)};
  }
  friend auto operator<=>(const Origin&, const Origin&) = default;
};

}  // namespace tandem::auth
