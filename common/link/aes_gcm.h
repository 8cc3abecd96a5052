#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/base/secret.h"
#include "common/link/datagram.h"

namespace tandem::link {

/// AES-256-GCM [NIST SP 800-38D] under one key, which is expanded once. Done by Intel's library with the widest instructions this
/// processor has: a quarter of libsodium's time for datagrams of our size. No heap, no state between calls: threads may share it.
class AesGcm {
 public:
  using Nonce = std::array<std::byte, 12>;
  using Header = std::span<const std::byte, kHeaderSize>;
  using Tag = std::span<std::byte, kTagSize>;

  /// Whether this build and this processor can do it. The first call takes memory, for as long as the process lives.
  [[nodiscard]] static bool available();

  AesGcm() = default;
  AesGcm(const AesGcm&) = default;
  AesGcm& operator=(const AesGcm&) = default;
  ~AesGcm() { wipe(expanded_); }

  /// Another key. @pre available()
  void expand(const tandem::Secret<32>& key) noexcept TANDEM_REALTIME;

  /// Encrypts `body` in place and writes the tag; `header` is authenticated with it.
  void seal(const Nonce& nonce, Header header, std::span<std::byte> body, Tag tag) const noexcept TANDEM_REALTIME;
  /// @param plaintext  as long as `body`; all zeros if the tag is wrong
  /// @return whether the tag is right
  [[nodiscard]] bool open(const Nonce& nonce, Header header, std::span<const std::byte> body, std::span<const std::byte, kTagSize> tag,
                          std::span<std::byte> plaintext) const noexcept TANDEM_REALTIME;

 private:
  alignas(64) std::array<std::byte, 1024> expanded_{};  ///< the library's: round keys and powers of the hash key
};

}  // namespace tandem::link
