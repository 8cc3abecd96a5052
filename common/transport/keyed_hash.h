#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tandem::transport {

/// Key of `keyed_hash`.
using HashKey = std::array<std::byte, 16>;

/// SipHash-2-4 of some bytes [Aumasson, Bernstein 2012]. Without the key a reader of the hashes cannot find the bytes
/// by trying them. No heap.
[[nodiscard]] std::uint64_t keyed_hash(const HashKey& key, std::span<const std::byte> bytes) noexcept;

}  // namespace tandem::transport
