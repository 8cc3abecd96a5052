#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/base/hex.h"

namespace tandem::auth {

using tandem::to_hex;
/// @return whether `text` is exactly the hex (either case) of out.size() bytes
[[nodiscard]] bool from_hex(std::string_view text, std::span<std::byte> out) noexcept;

/// Fingerprint that identifies a public key: the SHA-256 of its SubjectPublicKeyInfo in DER. Not secret.
struct KeyFingerprint {
  std::array<std::byte, 32> sha256{};

  [[nodiscard]] std::string hex() const { return to_hex(sha256); }
  [[nodiscard]] static std::optional<KeyFingerprint> from_hex(std::string_view text) noexcept;
  friend auto operator<=>(const KeyFingerprint&, const KeyFingerprint&) = default;
};

}  // namespace tandem::auth
