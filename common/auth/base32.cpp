#include "common/auth/base32.h"

#include <cstdint>

namespace tandem::auth {
namespace {

constexpr std::string_view kAlphabet = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";

/// Returns 0 ... 31, or 32 for a character outside the alphabet.
std::uint32_t value_of(char c) noexcept {
  if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  if (c == 'O') c = '0';
  if (c == 'I' || c == 'L') c = '1';
  const auto at = kAlphabet.find(c);
  return at == std::string_view::npos ? 32U : static_cast<std::uint32_t>(at);
}

}  // namespace

std::string to_base32(std::span<const std::byte> bytes) {
  std::string text;
  text.reserve(base32_length(bytes.size()));
  std::uint32_t held = 0;
  unsigned bits = 0;
  for (const std::byte b : bytes) {
    held = (held << 8 | std::to_integer<std::uint32_t>(b)) & 0xfffU;
    for (bits += 8; bits >= 5; bits -= 5) text += kAlphabet[held >> (bits - 5) & 31U];
  }
  if (bits > 0) text += kAlphabet[held << (5 - bits) & 31U];
  return text;
}

std::optional<std::vector<std::byte>> from_base32(std::string_view text) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() * 5 / 8);
  std::uint32_t held = 0;
  unsigned bits = 0;
  std::size_t characters = 0;
  for (const char c : text) {
    if (c == '-') continue;
    const std::uint32_t value = value_of(c);
    if (value > 31) return std::nullopt;
    ++characters;
    held = (held << 5 | value) & 0xfffU;
    bits += 5;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<std::byte>(held >> bits & 0xffU));
    }
  }
  const bool filled_with_zeros = (held & ((1U << bits) - 1)) == 0;
  if (!filled_with_zeros || characters != base32_length(bytes.size())) return std::nullopt;
  return bytes;
}

std::string grouped(std::string_view text, std::size_t group) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > 0 && i % group == 0) out += '-';
    out += text[i];
  }
  return out;
}

}  // namespace tandem::auth
