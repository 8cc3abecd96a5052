#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>

#include "common/base/secret.h"

namespace tandem::trust {

using Signature = std::array<std::byte, 64>;

/// Public half of a ticket key [Ed25519, RFC 8032].
struct TicketVerifier {
  std::array<std::byte, 32> key{};
  std::uint32_t kid = 0;  ///< names it in tickets: the first four bytes of its SHA-256, little-endian

  /// Strict: keys and signatures of small order and signatures in a second form are refused.
  [[nodiscard]] bool verifies(std::span<const std::byte> message, const Signature& signature) const noexcept;
};

/// What signs join tickets. Copies wipe themselves.
class TicketKey {
 public:
  /// @param seed  32 random bytes: they are the key
  explicit TicketKey(const Secret<32>& seed) noexcept;

  [[nodiscard]] Signature sign(std::span<const std::byte> message) const noexcept;
  [[nodiscard]] const TicketVerifier& verifier() const noexcept { return verifier_; }

  /// One line of text, for a file of mode 0600: `tandem-ticket-key-v1 HEX`.
  [[nodiscard]] SecretBuffer to_text() const;
  [[nodiscard]] static std::expected<TicketKey, std::string> from_text(std::span<const std::byte> text);

 private:
  Secret<32> seed_;
  Secret<64> expanded_;
  TicketVerifier verifier_;
};

}  // namespace tandem::trust
