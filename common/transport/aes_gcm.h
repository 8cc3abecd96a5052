#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/base/secret.h"
#include "common/transport/datagram.h"

namespace tandem::transport {

/// AES-256-GCM [NIST SP 800-38D] under one key, which is expanded once. Intel's library computes it with the widest
/// instructions of this processor: a quarter of libsodium's time for datagrams of this size. No heap and no state
/// between calls, so threads may share an object.
class AesGcm {
 public:
  using Nonce = std::array<std::byte, 12>;
  using Header = std::span<const std::byte, kHeaderSize>;
  using Tag = std::span<std::byte, kTagSize>;

  /// Returns whether this build and this processor support it. The first call allocates memory for the life of the
  /// process.
  [[nodiscard]] static bool available();

  AesGcm() = default;
  AesGcm(const AesGcm&) = default;
  AesGcm& operator=(const AesGcm&) = default;
  ~AesGcm() { wipe(expanded_); }

  /// Switches to another key. @pre available()
  void expand(const tandem::Secret<32>& key) noexcept TANDEM_REALTIME;

  /// Encrypts `body` in place and writes the tag, which also authenticates `header`.
  void seal(const Nonce& nonce, Header header, std::span<std::byte> body, Tag tag) const noexcept TANDEM_REALTIME;
  /// Decrypts `body`.
  /// @param plaintext  as long as `body`; all zeros if the tag is wrong
  /// @return whether the tag is right
  [[nodiscard]] bool open(const Nonce& nonce, Header header, std::span<const std::byte> body,
                          std::span<const std::byte, kTagSize> tag,
                          std::span<std::byte> plaintext) const noexcept TANDEM_REALTIME;

 private:
  alignas(64) std::array<std::byte, 1024> expanded_{};  ///< owned by the library: round keys and powers of the hash key
};

}  // namespace tandem::transport
