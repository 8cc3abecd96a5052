#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tandem::auth {

/// Returns the SHA-256 of the parts, one after the other.
[[nodiscard]] std::array<std::byte, 32> sha256(std::span<const std::byte> first,
                                               std::span<const std::byte> second = {}) noexcept;

/// Returns lower-case hex, two characters per byte.
[[nodiscard]] std::string to_hex(std::span<const std::byte> bytes);
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
