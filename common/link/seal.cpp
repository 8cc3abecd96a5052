#include "common/link/seal.h"

#include <sodium.h>

#include <stdexcept>

#include "common/base/raw_bytes.h"

namespace tandem::link {

namespace {

using Expanded = crypto_aead_aes256gcm_state;
static_assert(sizeof(Expanded) == 512 && alignof(Expanded) <= 16);
Expanded* expanded(std::byte* p) noexcept { return reinterpret_cast<Expanded*>(p); }

}  // namespace

Seal::Seal(const Key& key) {
  if (key.cipher == Cipher::kAes256Gcm && fastest_cipher() != Cipher::kAes256Gcm)
    throw std::runtime_error("this processor has no instructions for AES-256-GCM");
  rekey(key);
}

Seal::~Seal() { sodium_memzero(expanded_.data(), expanded_.size()); }

void Seal::rekey(const Key& key) noexcept {
  key_ = key;
  if (key.cipher == Cipher::kAes256Gcm) crypto_aead_aes256gcm_beforenm(expanded(expanded_.data()), raw(key.key.bytes.data()));
}

std::array<std::byte, 12> Seal::nonce(std::uint64_t counter) const noexcept {
  std::array<std::byte, 12> n = key_.iv.bytes;
  for (std::size_t i = 0; i < 8; ++i) n[4 + i] ^= static_cast<std::byte>((counter >> (8 * i)) & 0xff);
  return n;
}

bool Seal::seal(std::uint64_t counter, std::span<std::byte> datagram) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize) return false;
  const auto once = nonce(counter);
  std::byte* body = datagram.data() + kHeaderSize;
  const std::size_t size = datagram.size() - kHeaderSize - kTagSize;
  if (key_.cipher == Cipher::kAes256Gcm) {
    return crypto_aead_aes256gcm_encrypt_detached_afternm(raw(body), raw(body + size), nullptr, raw(body), size,
                                                          raw(datagram.data()), kHeaderSize, nullptr, raw(once.data()),
                                                          expanded(expanded_.data())) == 0;
  }
  return crypto_aead_chacha20poly1305_ietf_encrypt_detached(raw(body), raw(body + size), nullptr, raw(body), size,
                                                            raw(datagram.data()), kHeaderSize, nullptr,
                                                            raw(once.data()), raw(key_.key.bytes.data())) == 0;
}

bool Seal::open(std::uint64_t counter, std::span<const std::byte> datagram, std::span<std::byte> plaintext) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize || plaintext.size() != datagram.size() - kHeaderSize - kTagSize) return false;
  const auto once = nonce(counter);
  const std::byte* body = datagram.data() + kHeaderSize;
  const std::size_t size = plaintext.size();
  if (key_.cipher == Cipher::kAes256Gcm) {
    return crypto_aead_aes256gcm_decrypt_detached_afternm(raw(plaintext.data()), nullptr, raw(body), size,
                                                          raw(body + size), raw(datagram.data()), kHeaderSize,
                                                          raw(once.data()), expanded(expanded_.data())) == 0;
  }
  return crypto_aead_chacha20poly1305_ietf_decrypt_detached(raw(plaintext.data()), nullptr, raw(body), size,
                                                            raw(body + size), raw(datagram.data()), kHeaderSize,
                                                            raw(once.data()), raw(key_.key.bytes.data())) == 0;
}

}  // namespace tandem::link
