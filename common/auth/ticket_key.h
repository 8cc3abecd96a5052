#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <string_view>

#include "common/base/secret.h"

namespace tandem::auth {

using Signature = std::array<std::byte, 64>;

/// Public half of a ticket key [Ed25519, RFC 8032].
struct TicketVerifier {
  std::array<std::byte, 32> key{};
  std::uint32_t kid = 0;  ///< key id in tickets: the first four bytes of the key's SHA-256, little-endian

  [[nodiscard]] static TicketVerifier of(const std::array<std::byte, 32>& key) noexcept;
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

  /// First words of the files of keys. The key of a service signs vouchers, and no ticket.
  static constexpr std::string_view kTicketLabel = "tandem-ticket-key-v1 ", kServiceLabel = "tandem-service-key-v1 ";

  /// Returns one line of text for a file of mode 0600: the label and the key in hex.
  [[nodiscard]] SecretBuffer to_text(std::string_view label = kTicketLabel) const;
  [[nodiscard]] static std::expected<TicketKey, std::string> from_text(std::span<const std::byte> text,
                                                                       std::string_view label = kTicketLabel);

 private:
  Secret<32> seed_;
  Secret<64> expanded_;
  TicketVerifier verifier_;
};

}  // namespace tandem::auth
