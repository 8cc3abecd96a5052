#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tandem::trust {

/// SHA-256 of the pieces, one after the other.
[[nodiscard]] std::array<std::byte, 32> sha256(std::span<const std::byte> first, std::span<const std::byte> second = {}) noexcept;

/// Lower-case hex, two characters per byte.
[[nodiscard]] std::string to_hex(std::span<const std::byte> bytes);
/// @return whether `text` is exactly the hex (either case) of out.size() bytes
[[nodiscard]] bool from_hex(std::string_view text, std::span<std::byte> out) noexcept;

/// What a public key is known by: SHA-256 of its SubjectPublicKeyInfo in DER. Public.
struct Pin {
  std::array<std::byte, 32> sha256{};

  [[nodiscard]] std::string hex() const { return to_hex(sha256); }
  [[nodiscard]] static std::optional<Pin> from_hex(std::string_view text) noexcept;
  friend auto operator<=>(const Pin&, const Pin&) = default;
};

}  // namespace tandem::trust
