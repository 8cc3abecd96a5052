#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/transport/aes_gcm.h"
#include "common/transport/datagram.h"
#include "common/transport/key_schedule.h"

namespace tandem::transport {

enum class Direction : std::uint8_t { kToServer = 0, kToClient = 1 };

/// AEAD under one key in one direction: nonce = iv XOR (0^32 | counter), AAD = header. It never uses the heap, so that
/// a connection can change keys between two ticks.
class Aead {
 public:
  /// @throws std::runtime_error if this processor does not support the key's cipher
  explicit Aead(const Key& key);

  /// Switches to another key of the same cipher.
  void rekey(const Key& key) noexcept TANDEM_REALTIME;

  /// Encrypts in place and writes the tag. `datagram` = header (written) | plaintext | space for the tag. @return false
  /// if the datagram is too small or the cipher fails
  [[nodiscard]] bool seal(std::uint64_t counter, std::span<std::byte> datagram) noexcept TANDEM_REALTIME;
  /// Checks the tag and decrypts into `plaintext` (datagram.size() - 32 bytes). Plaintext is released only if the tag
  /// is right.
  /// @return whether the tag is right
  [[nodiscard]] bool open(std::uint64_t counter, std::span<const std::byte> datagram,
                          std::span<std::byte> plaintext) noexcept TANDEM_REALTIME;

 private:
  [[nodiscard]] std::array<std::byte, 12> nonce(std::uint64_t counter) const noexcept;

  AesGcm aes_;  ///< unused with the other cipher
  Key key_;
};

}  // namespace tandem::transport
