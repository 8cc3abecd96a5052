#include "common/auth/ticket_key.h"

#include <sodium.h>

#include <algorithm>
#include <string_view>

#include "common/auth/key_fingerprint.h"
#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"

namespace tandem::auth {
namespace {

constexpr std::string_view kLabel = "tandem-ticket-key-v1 ";
constexpr std::size_t kTextSize = kLabel.size() + 64 + 1;

}  // namespace

bool TicketVerifier::verifies(std::span<const std::byte> message, const Signature& signature) const noexcept {
  return crypto_sign_verify_detached(raw(signature.data()), raw(message.data()), message.size(), raw(key.data())) == 0;
}

TicketKey::TicketKey(const Secret<32>& seed) noexcept : seed_(seed) {
  crypto_sign_seed_keypair(raw(verifier_.key.data()), raw(expanded_.bytes.data()), raw(seed.bytes.data()));
  const auto hash = transport::sha256(verifier_.key);
  for (std::size_t i = 0; i < 4; ++i) verifier_.kid |= std::to_integer<std::uint32_t>(hash[i]) << (8 * i);
}

Signature TicketKey::sign(std::span<const std::byte> message) const noexcept {
  Signature signature;
  crypto_sign_detached(raw(signature.data()), nullptr, raw(message.data()), message.size(),
                       raw(expanded_.bytes.data()));
  return signature;
}

SecretBuffer TicketKey::to_text() const {
  std::string hex = to_hex(seed_.bytes);
  SecretBuffer text(kTextSize);
  const auto out = text.bytes();
  std::ranges::copy(bytes_of(kLabel), out.begin());
  std::ranges::copy(bytes_of(hex), out.begin() + static_cast<std::ptrdiff_t>(kLabel.size()));
  out.back() = std::byte{'\n'};
  wipe(hex);
  return text;
}

std::expected<TicketKey, std::string> TicketKey::from_text(std::span<const std::byte> text) {
  Secret<32> seed;
  const std::string_view line = text_of(text);
  if (line.size() != kTextSize || !line.starts_with(kLabel) || line.back() != '\n' ||
      !from_hex(line.substr(kLabel.size(), 64), seed.bytes))
    return std::unexpected("holds no ticket key: expected one line `tandem-ticket-key-v1` and 64 hex digits");
  return TicketKey(seed);
}

}  // namespace tandem::auth
