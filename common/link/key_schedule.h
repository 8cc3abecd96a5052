#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/secret.h"

/// From a joining handshake's exported bytes to the keys of datagrams, and from one key to the next (FORMAT.md, "Keys").
namespace tandem::link {

/// The two ciphers datagrams may be sealed with; nothing else is ever negotiated.
enum class Cipher : std::uint8_t {
  kAes256Gcm,         ///< needs a processor with AES and carry-less multiplication
  kChaCha20Poly1305,  ///< RFC 8439; runs everywhere
};
/// The faster one this machine can do.
/// @throws std::runtime_error if the machine has no source of randomness
[[nodiscard]] Cipher fastest_cipher();

/// 32 bytes from which the keys of one direction come.
using Secret = tandem::Secret<32>;

/// What both ends of a connection know and nobody else: one secret per direction.
struct ConnectionSecrets {
  Cipher cipher = Cipher::kChaCha20Poly1305;
  Secret to_server, to_client;
};

inline constexpr std::size_t kExportedSize = 64;
/// @param exported  the TLS exporter's output: first half to the server, second half to the client
[[nodiscard]] ConnectionSecrets secrets_from_exporter(std::span<const std::byte, kExportedSize> exported, Cipher cipher) noexcept;

struct Key {
  Cipher cipher = Cipher::kChaCha20Poly1305;
  tandem::Secret<32> key;
  tandem::Secret<12> iv;
};

/// HKDF-Expand-Label [RFC 8446 7.1, but the label has no "tls13 " in front] with an empty context, HMAC-SHA-256. No heap.
/// @param out  at most 32 bytes  @param label  at most 32 characters
void expand_label(const Secret& secret, std::string_view label, std::span<std::byte> out) noexcept;
/// Key and iv of a phase.
[[nodiscard]] Key key_of(const Secret& secret, Cipher cipher) noexcept;
/// The secret of the next phase; the old one cannot be found from it.
[[nodiscard]] Secret next_secret(const Secret& secret) noexcept;

}  // namespace tandem::link
