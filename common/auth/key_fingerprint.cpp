#include "common/auth/key_fingerprint.h"

#include <sodium.h>

#include "common/base/raw_bytes.h"

namespace tandem::auth {

std::array<std::byte, 32> sha256(std::span<const std::byte> first, std::span<const std::byte> second) noexcept {
  std::array<std::byte, 32> out;
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  crypto_hash_sha256_update(&state, raw(first.data()), first.size());
  crypto_hash_sha256_update(&state, raw(second.data()), second.size());
  crypto_hash_sha256_final(&state, raw(out.data()));
  sodium_memzero(&state, sizeof state);
  return out;
}

std::string to_hex(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const std::byte b : bytes) {
    text += kDigits[std::to_integer<std::size_t>(b >> 4)];
    text += kDigits[std::to_integer<std::size_t>(b & std::byte{15})];
  }
  return text;
}

bool from_hex(std::string_view text, std::span<std::byte> out) noexcept {
  if (text.size() != 2 * out.size()) return false;
  const auto digit = [](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int high = digit(text[2 * i]), low = digit(text[2 * i + 1]);
    if (high < 0 || low < 0) return false;
    out[i] = static_cast<std::byte>(16 * high + low);
  }
  return true;
}

std::optional<KeyFingerprint> KeyFingerprint::from_hex(std::string_view text) noexcept {
  KeyFingerprint fingerprint;
  return auth::from_hex(text, fingerprint.sha256) ? std::optional(fingerprint) : std::nullopt;
}

}  // namespace tandem::auth
