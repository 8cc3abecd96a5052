#include "common/mcap/crc32.h"

#include <zlib.h>

#include "common/base/raw_bytes.h"

namespace tandem::mcap {

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before) noexcept {
  return static_cast<std::uint32_t>(::crc32_z(before, raw(bytes.data()), bytes.size()));
}

}  // namespace tandem::mcap
