#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Base 32 for text that users read aloud and type [Crockford, "Base 32"]: 0-9 and A-Z without I, L, O, U. Each
/// character has five bits, starting with the highest bit of the first byte; the last one is padded with zeros.
namespace tandem::auth {

/// Returns the number of characters for this many bytes.
[[nodiscard]] constexpr std::size_t base32_length(std::size_t bytes) noexcept { return (bytes * 8 + 4) / 5; }

/// Returns the text in upper case, without dashes.
[[nodiscard]] std::string to_base32(std::span<const std::byte> bytes);

/// Decodes text in either case, with dashes anywhere, o for 0, and i and l for 1. Returns nullopt for other characters,
/// for impossible lengths and for padding bits that are not zero. Apart from these tolerances, bytes have exactly one
/// text.
[[nodiscard]] std::optional<std::vector<std::byte>> from_base32(std::string_view text);

/// Returns `text` with a dash after every `group` characters.
[[nodiscard]] std::string grouped(std::string_view text, std::size_t group);

}  // namespace tandem::auth
