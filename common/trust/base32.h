#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Bytes as text that people read aloud and type [Crockford, "Base 32"]: 0-9 and A-Z without I, L, O, U; five bits per character, the
/// first byte's highest bit first, the last character filled up with zeros.
namespace tandem::trust {

/// Characters for so many bytes.
[[nodiscard]] constexpr std::size_t base32_length(std::size_t bytes) noexcept { return (bytes * 8 + 4) / 5; }

/// Upper case, no dashes.
[[nodiscard]] std::string to_base32(std::span<const std::byte> bytes);

/// Takes either case, dashes anywhere, o for 0, i and l for 1; refuses every other character, a length that no number of bytes has, and
/// filling bits that are not zero: apart from case, dashes and those three letters, bytes have one text only.
[[nodiscard]] std::optional<std::vector<std::byte>> from_base32(std::string_view text);

/// `text` with a dash after every `group` characters.
[[nodiscard]] std::string grouped(std::string_view text, std::size_t group);

}  // namespace tandem::trust
