#include "common/transport/keyed_hash.h"

#include <sodium.h>

#include <bit>

#include "common/base/raw_bytes.h"

namespace tandem::transport {

std::uint64_t keyed_hash(const HashKey& key, std::span<const std::byte> bytes) noexcept {
  static_assert(crypto_shorthash_BYTES == sizeof(std::uint64_t) && crypto_shorthash_KEYBYTES == sizeof(HashKey));
  std::array<std::byte, crypto_shorthash_BYTES> hash;
  crypto_shorthash(raw(hash.data()), raw(bytes.data()), bytes.size(), raw(key.data()));
  return std::bit_cast<std::uint64_t>(hash);
}

}  // namespace tandem::transport
