#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tandem::mcap {

/// CRC-32 of ISO-HDLC (zlib's), as MCAP records have it.
/// @param before  CRC of the bytes before these; 0 at the start
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0) noexcept;

}  // namespace tandem::mcap
