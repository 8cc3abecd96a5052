#include "common/auth/ticket_key.h"

#include <sodium.h>

#include <algorithm>
#include <string_view>

#include "common/auth/key_fingerprint.h"
#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"

namespace tandem::auth {
TicketVerifier TicketVerifier::of(const std::array<std::byte, 32>& key) noexcept {
  TicketVerifier out{key, 0};
  const auto hash = transport::sha256(key);
  for (std::size_t i = 0; i < 4; ++i) out.kid |= std::to_integer<std::uint32_t>(hash[i]) << (8 * i);
  return out;
}

bool TicketVerifier::verifies(std::span<const std::byte> message, const Signature& signature) const noexcept {
  return crypto_sign_verify_detached(raw(signature.data()), raw(message.data()), message.size(), raw(key.data())) == 0;
}

TicketKey::TicketKey(const Secret<32>& seed) noexcept : seed_(seed) {
  crypto_sign_seed_keypair(raw(verifier_.key.data()), raw(expanded_.bytes.data()), raw(seed.bytes.data()));
  verifier_ = TicketVerifier::of(verifier_.key);
}

Signature TicketKey::sign(std::span<const std::byte> message) const noexcept {
  Signature signature;
  crypto_sign_detached(raw(signature.data()), nullptr, raw(message.data()), message.size(),
                       raw(expanded_.bytes.data()));
  return signature;
}

SecretBuffer TicketKey::to_text(std::string_view label) const {
  std::string hex = to_hex(seed_.bytes);
  SecretBuffer text(label.size() + hex.size() + 1);
  const auto out = text.bytes();
  std::ranges::copy(bytes_of(label), out.begin());
  std::ranges::copy(bytes_of(hex), out.begin() + static_cast<std::ptrdiff_t>(label.size()));
  out.back() = std::byte{'\n'};
  wipe(hex);
  return text;
}

std::expected<TicketKey, std::string> TicketKey::from_text(std::span<const std::byte> text, std::string_view label) {
  Secret<32> seed;
  const std::string_view line = text_of(text);
  if (line.size() != label.size() + 64 + 1 || !line.starts_with(label) || line.back() != '\n' ||
      !from_hex(line.substr(label.size(), 64), seed.bytes))
    return std::unexpected("holds no such key: expected one line `" + std::string(label) + "` and 64 hex digits");
  return TicketKey(seed);
}

}  // namespace tandem::auth
