#include "common/transport/key_schedule.h"

#include <sodium.h>

#include <algorithm>
#include <stdexcept>

#include "common/base/raw_bytes.h"
#include "common/transport/aes_gcm.h"

namespace tandem::transport {

namespace {
constexpr std::size_t kLabelMax = 32;
}  // namespace

Cipher fastest_cipher() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium does not start: it found no source of randomness");
  return AesGcm::available() ? Cipher::kAes256Gcm : Cipher::kChaCha20Poly1305;
}

ConnectionSecrets secrets_from_exporter(std::span<const std::byte, kExportedSize> exported, Cipher cipher) noexcept {
  ConnectionSecrets s;
  s.cipher = cipher;
  std::copy_n(exported.begin(), 32, s.to_server.bytes.begin());
  std::copy_n(exported.begin() + 32, 32, s.to_client.bytes.begin());
  return s;
}

void expand_label(const Secret& secret, std::string_view label, std::span<std::byte> out) noexcept {
  // HkdfLabel = u16 length (big-endian) | u8 label size | label | u8 context size (0), then block number 1 of
  // HKDF-Expand.
  std::array<unsigned char, 2 + 1 + kLabelMax + 1 + 1> info{};
  const std::size_t n = std::min(label.size(), kLabelMax);
  std::size_t size = 0;
  info[size++] = 0;
  info[size++] = static_cast<unsigned char>(out.size());
  info[size++] = static_cast<unsigned char>(n);
  for (std::size_t i = 0; i < n; ++i) info[size++] = static_cast<unsigned char>(label[i]);
  info[size++] = 0;
  info[size++] = 1;
  std::array<unsigned char, crypto_auth_hmacsha256_BYTES> block;
  crypto_auth_hmacsha256_state state;
  crypto_auth_hmacsha256_init(&state, raw(secret.bytes.data()), secret.bytes.size());
  crypto_auth_hmacsha256_update(&state, info.data(), size);
  crypto_auth_hmacsha256_final(&state, block.data());
  for (std::size_t i = 0; i < std::min(out.size(), block.size()); ++i) out[i] = static_cast<std::byte>(block[i]);
  sodium_memzero(block.data(), block.size());
  sodium_memzero(&state, sizeof state);
}

Key key_of(const Secret& secret, Cipher cipher) noexcept {
  Key key;
  key.cipher = cipher;
  expand_label(secret, "tandem key", key.key.bytes);
  expand_label(secret, "tandem iv", key.iv.bytes);
  return key;
}

Secret next_secret(const Secret& secret) noexcept {
  Secret next;
  expand_label(secret, "tandem ku", next.bytes);
  return next;
}

}  // namespace tandem::transport
