#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

#include "proto/wire/wire_messages.h"

/// The clear header of a datagram (FORMAT.md), little-endian:
///
///      0  u8   version (4 bits) = 2 | type (4 bits)
///      1  u8   key phase: number of the key, modulo 256
///      2  u16  zero
///      4  u32  connection id, chosen by the receiver of this datagram
///      8  u64  counter, starts at 0, never repeats under a key
///     16  ...  sealed plaintext, then a 128-bit tag that also authenticates bytes 0..15
namespace tandem::transport {

inline constexpr std::size_t kHeaderSize = 16;
inline constexpr std::size_t kTagSize = 16;
inline constexpr std::size_t kDatagramMax = 1200;  ///< IPv6 minimum MTU 1280 - 40 - 8 - 32 for tunnels
inline constexpr std::uint8_t kVersion = 2;

struct Header {
  wire::Type type = wire::Type::kPing;
  std::uint8_t key_phase = 0;
  std::uint32_t cid = 0;
  std::uint64_t counter = 0;
};

namespace detail {
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");
template <class T>
void put(std::byte* at, T value) noexcept {
  std::memcpy(at, &value, sizeof value);
}
template <class T>
T get(const std::byte* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}
}  // namespace detail

inline void write_header(const Header& h, std::span<std::byte, kHeaderSize> out) noexcept {
  out[0] = static_cast<std::byte>((kVersion << 4) | static_cast<std::uint8_t>(h.type));
  out[1] = static_cast<std::byte>(h.key_phase);
  out[2] = out[3] = std::byte{0};
  detail::put<std::uint32_t>(&out[4], h.cid);
  detail::put<std::uint64_t>(&out[8], h.counter);
}

/// Returns the header, or nullopt if size, version, type or the reserved zero is wrong. The header is not authenticated
/// before the datagram is opened.
[[nodiscard]] inline std::optional<Header> read_header(std::span<const std::byte> datagram) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize || datagram.size() > kDatagramMax) return std::nullopt;
  const auto first = std::to_integer<std::uint8_t>(datagram[0]);
  const auto type = static_cast<std::uint8_t>(first & 0x0f);
  if (first >> 4 != kVersion || type < wire::kFirstType || type > wire::kLastType) return std::nullopt;
  if (datagram[2] != std::byte{0} || datagram[3] != std::byte{0}) return std::nullopt;
  return Header{static_cast<wire::Type>(type), std::to_integer<std::uint8_t>(datagram[1]),
                detail::get<std::uint32_t>(&datagram[4]), detail::get<std::uint64_t>(&datagram[8])};
}

}  // namespace tandem::transport
