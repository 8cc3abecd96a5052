#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>

#include "common/base/secret.h"

namespace tandem::auth {

using Signature = std::array<std::byte, 64>;

/// Public half of a ticket key [Ed25519, RFC 8032].
struct TicketVerifier {
  std::array<std::byte, 32> key{};
  std::uint32_t kid = 0;  ///< key id in tickets: the first four bytes of the key's SHA-256, little-endian

  /// Verifies strictly: rejects keys and signatures of small order, and signatures in a non-canonical form.
  [[nodiscard]] bool verifies(std::span<const std::byte> message, const Signature& signature) const noexcept;
};

/// Private key that signs tickets. Every copy wipes itself.
class TicketKey {
 public:
  /// @param seed  32 random bytes: the private key
  explicit TicketKey(const Secret<32>& seed) noexcept;

  [[nodiscard]] Signature sign(std::span<const std::byte> message) const noexcept;
  [[nodiscard]] const TicketVerifier& verifier() const noexcept { return verifier_; }

  /// Returns one line of text for a file of mode 0600: `tandem-ticket-key-v1 HEX`.
  [[nodiscard]] SecretBuffer to_text() const;
  [[nodiscard]] static std::expected<TicketKey, std::string> from_text(std::span<const std::byte> text);

 private:
  Secret<32> seed_;
  Secret<64> expanded_;
  TicketVerifier verifier_;
};

}  // namespace tandem::auth
