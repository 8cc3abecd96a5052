#include "common/auth/key_fingerprint.h"

namespace tandem::auth {

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
