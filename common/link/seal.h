#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "common/link/datagram.h"

namespace tandem::link {

enum class Direction : std::uint8_t { kToServer = 0, kToClient = 1 };

struct Key {
  std::array<std::byte, 32> key{};
  std::array<std::byte, 12> iv{};
};

/// Key of the loopback profile: derived (HKDF-SHA-256) from a constant that anybody can read here, the connection id and the
/// direction. It proves that a datagram is whole and was meant for this connection; it keeps NO secret and stops no attacker, which
/// is why servers refuse any address that is not loopback until keys come from a joining handshake.
[[nodiscard]] Key loopback_key(std::uint32_t cid, Direction direction);

/// AES-256-GCM under one key and direction: nonce = iv XOR (0^32 | counter), AAD = header. Contexts are made once; no heap per datagram.
class Seal {
 public:
  enum class Use : std::uint8_t { kSealing, kOpening };
  /// @throws SetupError-like std::runtime_error if the crypto library lacks the cipher.
  Seal(const Key& key, Use use);
  ~Seal();
  Seal(Seal&&) noexcept;
  Seal& operator=(Seal&&) noexcept;

  /// `datagram` = header (written) | plaintext | room for the tag. Encrypts in place and writes the tag.
  [[nodiscard]] bool seal(std::uint64_t counter, std::span<std::byte> datagram) noexcept TANDEM_REALTIME;
  /// Checks the tag and decrypts into `plaintext` (datagram.size() - 32 bytes). Nothing is released before the tag is right.
  [[nodiscard]] bool open(std::uint64_t counter, std::span<const std::byte> datagram, std::span<std::byte> plaintext) noexcept
      TANDEM_REALTIME;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace tandem::link
