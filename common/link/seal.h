#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "common/link/datagram.h"

namespace tandem::link {

enum class Direction : std::uint8_t { kToServer = 0, kToClient = 1 };

/// The two ciphers datagrams may be sealed with; nothing else is ever negotiated.
enum class Cipher : std::uint8_t {
  kAes256Gcm,         ///< needs a processor with AES and carry-less multiplication
  kChaCha20Poly1305,  ///< RFC 8439; runs everywhere
};
/// The faster one this machine can do.
[[nodiscard]] Cipher fastest_cipher();

struct Key {
  Cipher cipher = Cipher::kChaCha20Poly1305;
  std::array<std::byte, 32> key{};
  std::array<std::byte, 12> iv{};
};

/// Key of the loopback profile: derived (HKDF-SHA-256) from a constant that anybody can read here, the connection id and the
/// direction. It proves that a datagram is whole and was meant for this connection; it keeps NO secret and stops no attacker, which
/// is why servers refuse any address that is not loopback until keys come from a joining handshake.
[[nodiscard]] Key loopback_key(std::uint32_t cid, Direction direction);

/// One key in one direction: nonce = iv XOR (0^32 | counter), AAD = header. The key is expanded once (libsodium: half the time of
/// OpenSSL's EVP for datagrams of our size); no heap per datagram.
class Seal {
 public:
  /// @throws std::runtime_error if this processor cannot do the key's cipher
  explicit Seal(const Key& key);
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
