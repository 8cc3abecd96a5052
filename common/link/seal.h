#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/link/aes_gcm.h"
#include "common/link/datagram.h"
#include "common/link/key_schedule.h"

namespace tandem::link {

enum class Direction : std::uint8_t { kToServer = 0, kToClient = 1 };

/// One key in one direction: nonce = iv XOR (0^32 | counter), AAD = header. No heap at all, so that a connection can change keys
/// between two ticks.
class Seal {
 public:
  /// @throws std::runtime_error if this processor cannot do the key's cipher
  explicit Seal(const Key& key);

  /// Another key of the same cipher.
  void rekey(const Key& key) noexcept TANDEM_REALTIME;

  /// `datagram` = header (written) | plaintext | room for the tag. Encrypts in place and writes the tag.
  [[nodiscard]] bool seal(std::uint64_t counter, std::span<std::byte> datagram) noexcept TANDEM_REALTIME;
  /// Checks the tag and decrypts into `plaintext` (datagram.size() - 32 bytes). Nothing is released before the tag is right.
  [[nodiscard]] bool open(std::uint64_t counter, std::span<const std::byte> datagram, std::span<std::byte> plaintext) noexcept
      TANDEM_REALTIME;

 private:
  [[nodiscard]] std::array<std::byte, 12> nonce(std::uint64_t counter) const noexcept;

  AesGcm aes_;  ///< unused with the other cipher
  Key key_;
};

}  // namespace tandem::link
