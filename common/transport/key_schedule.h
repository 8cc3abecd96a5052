#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/secret.h"

/// Derives the datagram keys from the exported bytes of the joining handshake, and each key from the one before
/// (FORMAT.md, "Keys").
namespace tandem::transport {

/// The two ciphers of datagrams. No other cipher can be negotiated.
enum class Cipher : std::uint8_t {
  kAes256Gcm,         ///< needs a processor with AES and carry-less multiplication
  kChaCha20Poly1305,  ///< RFC 8439; runs on every processor
};
/// Returns the faster cipher that this machine supports.
/// @throws std::runtime_error if the machine has no source of randomness
[[nodiscard]] Cipher fastest_cipher();

/// 32 bytes from which the keys of one direction are derived.
using Secret = tandem::Secret<32>;

/// Secrets that only the two ends of a connection know: one per direction.
struct ConnectionSecrets {
  Cipher cipher = Cipher::kChaCha20Poly1305;
  Secret to_server, to_client;
};

inline constexpr std::size_t kExportedSize = 64;
/// Returns the secrets of a connection.
/// @param exported  output of the TLS exporter: first half to the server, second half to the client
[[nodiscard]] ConnectionSecrets secrets_from_exporter(std::span<const std::byte, kExportedSize> exported,
                                                      Cipher cipher) noexcept;

/// Key material of one phase in one direction.
struct Key {
  Cipher cipher = Cipher::kChaCha20Poly1305;
  tandem::Secret<32> key;
  tandem::Secret<12> iv;
};

/// Computes HKDF-Expand-Label [RFC 8446 7.1, without "tls13 " before the label] with an empty context and HMAC-SHA-256.
/// No heap.
/// @param out  at most 32 bytes  @param label  at most 32 characters
void expand_label(const Secret& secret, std::string_view label, std::span<std::byte> out) noexcept;
/// Returns key and iv of a phase.
[[nodiscard]] Key key_of(const Secret& secret, Cipher cipher) noexcept;
/// Returns the secret of the next phase; the old secret cannot be derived from it.
[[nodiscard]] Secret next_secret(const Secret& secret) noexcept;

}  // namespace tandem::transport
