#include "common/transport/aead.h"

#include <sodium.h>

#include <bit>
#include <cstring>
#include <stdexcept>

#include "common/base/raw_bytes.h"

namespace tandem::transport {

namespace {
static_assert(std::endian::native == std::endian::little, "the counter is mixed in as it lies in memory");
}

Aead::Aead(const Key& key) {
  if (key.cipher == Cipher::kAes256Gcm && !AesGcm::available())
    throw std::runtime_error("this processor has no instructions for AES-256-GCM");
  rekey(key);
}

void Aead::rekey(const Key& key) noexcept {
  key_ = key;
  if (key.cipher == Cipher::kAes256Gcm) aes_.expand(key.key);
}

std::array<std::byte, 12> Aead::nonce(std::uint64_t counter) const noexcept {
  std::array<std::byte, 12> n = key_.iv.bytes;
  std::uint64_t last;
  std::memcpy(&last, n.data() + 4, sizeof last);
  last ^= counter;
  std::memcpy(n.data() + 4, &last, sizeof last);
  return n;
}

bool Aead::seal(std::uint64_t counter, std::span<std::byte> datagram) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize) return false;
  const auto once = nonce(counter);
  const auto header = datagram.first<kHeaderSize>();
  const auto body = datagram.subspan(kHeaderSize, datagram.size() - kHeaderSize - kTagSize);
  const auto tag = datagram.last<kTagSize>();
  if (key_.cipher == Cipher::kAes256Gcm) {
    aes_.seal(once, header, body, tag);
    return true;
  }
  return crypto_aead_chacha20poly1305_ietf_encrypt_detached(
             raw(body.data()), raw(tag.data()), nullptr, raw(body.data()), body.size(), raw(header.data()),
             header.size(), nullptr, raw(once.data()), raw(key_.key.bytes.data())) == 0;
}

bool Aead::open(std::uint64_t counter, std::span<const std::byte> datagram, std::span<std::byte> plaintext) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize || plaintext.size() != datagram.size() - kHeaderSize - kTagSize)
    return false;
  const auto once = nonce(counter);
  const auto header = datagram.first<kHeaderSize>();
  const auto body = datagram.subspan(kHeaderSize, plaintext.size());
  const auto tag = datagram.last<kTagSize>();
  if (key_.cipher == Cipher::kAes256Gcm) return aes_.open(once, header, body, tag, plaintext);
  return crypto_aead_chacha20poly1305_ietf_decrypt_detached(
             raw(plaintext.data()), nullptr, raw(body.data()), body.size(), raw(tag.data()), raw(header.data()),
             header.size(), raw(once.data()), raw(key_.key.bytes.data())) == 0;
}

}  // namespace tandem::transport
