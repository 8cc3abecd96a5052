#include "common/link/seal.h"

#include <openssl/evp.h>
#include <openssl/kdf.h>
#include <sodium.h>

#include <stdexcept>
#include <string_view>

namespace tandem::link {

namespace {

/// The crypto libraries speak unsigned char; these are the only casts.
unsigned char* raw(std::byte* p) noexcept { return reinterpret_cast<unsigned char*>(p); }
const unsigned char* raw(const std::byte* p) noexcept { return reinterpret_cast<const unsigned char*>(p); }

struct ContextDeleter {
  void operator()(EVP_PKEY_CTX* c) const noexcept { EVP_PKEY_CTX_free(c); }
};

}  // namespace

Key loopback_key(std::uint32_t cid, Direction direction) {
  constexpr std::string_view kSecret = "tandem loopback: this key is public";
  std::array<unsigned char, 5> info{};
  for (std::size_t i = 0; i < 4; ++i) info[i] = static_cast<unsigned char>((cid >> (8 * i)) & 0xff);
  info[4] = static_cast<unsigned char>(direction);
  std::array<unsigned char, 44> bytes{};
  std::size_t length = bytes.size();
  const std::unique_ptr<EVP_PKEY_CTX, ContextDeleter> kdf{EVP_PKEY_CTX_new_id(EVP_PKEY_HKDF, nullptr)};
  const auto* secret = reinterpret_cast<const unsigned char*>(kSecret.data());
  if (!kdf || EVP_PKEY_derive_init(kdf.get()) != 1 || EVP_PKEY_CTX_set_hkdf_md(kdf.get(), EVP_sha256()) != 1 ||
      EVP_PKEY_CTX_set1_hkdf_key(kdf.get(), secret, static_cast<int>(kSecret.size())) != 1 ||
      EVP_PKEY_CTX_add1_hkdf_info(kdf.get(), info.data(), static_cast<int>(info.size())) != 1 ||
      EVP_PKEY_derive(kdf.get(), bytes.data(), &length) != 1)
    throw std::runtime_error("HKDF-SHA-256 is not available in this OpenSSL");
  Key key;
  key.cipher = fastest_cipher();
  std::memcpy(key.key.data(), bytes.data(), key.key.size());
  std::memcpy(key.iv.data(), bytes.data() + key.key.size(), key.iv.size());
  return key;
}

Cipher fastest_cipher() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium does not start: it found no source of randomness");
  return crypto_aead_aes256gcm_is_available() == 1 ? Cipher::kAes256Gcm : Cipher::kChaCha20Poly1305;
}

struct Seal::Context {
  crypto_aead_aes256gcm_state aes{};  ///< the expanded key; unused with the other cipher
  Key key;

  [[nodiscard]] std::array<std::byte, 12> nonce(std::uint64_t counter) const noexcept {
    std::array<std::byte, 12> n = key.iv;
    for (std::size_t i = 0; i < 8; ++i) n[4 + i] ^= static_cast<std::byte>((counter >> (8 * i)) & 0xff);
    return n;
  }
};

Seal::Seal(const Key& key) : context_(std::make_unique<Context>()) {
  context_->key = key;
  if (key.cipher != Cipher::kAes256Gcm) return;
  if (fastest_cipher() != Cipher::kAes256Gcm) throw std::runtime_error("this processor has no instructions for AES-256-GCM");
  crypto_aead_aes256gcm_beforenm(&context_->aes, raw(key.key.data()));
}

Seal::~Seal() {
  if (context_) sodium_memzero(context_.get(), sizeof *context_);
}
Seal::Seal(Seal&&) noexcept = default;
Seal& Seal::operator=(Seal&&) noexcept = default;

bool Seal::seal(std::uint64_t counter, std::span<std::byte> datagram) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize) return false;
  const Context& c = *context_;
  const auto nonce = c.nonce(counter);
  std::byte* body = datagram.data() + kHeaderSize;
  const std::size_t size = datagram.size() - kHeaderSize - kTagSize;
  if (c.key.cipher == Cipher::kAes256Gcm) {
    return crypto_aead_aes256gcm_encrypt_detached_afternm(raw(body), raw(body + size), nullptr, raw(body), size,
                                                          raw(datagram.data()), kHeaderSize, nullptr, raw(nonce.data()),
                                                          &c.aes) == 0;
  }
  return crypto_aead_chacha20poly1305_ietf_encrypt_detached(raw(body), raw(body + size), nullptr, raw(body), size,
                                                            raw(datagram.data()), kHeaderSize, nullptr,
                                                            raw(nonce.data()), raw(c.key.key.data())) == 0;
}

bool Seal::open(std::uint64_t counter, std::span<const std::byte> datagram, std::span<std::byte> plaintext) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize || plaintext.size() != datagram.size() - kHeaderSize - kTagSize) return false;
  const Context& c = *context_;
  const auto nonce = c.nonce(counter);
  const std::byte* body = datagram.data() + kHeaderSize;
  const std::size_t size = plaintext.size();
  if (c.key.cipher == Cipher::kAes256Gcm) {
    return crypto_aead_aes256gcm_decrypt_detached_afternm(raw(plaintext.data()), nullptr, raw(body), size,
                                                          raw(body + size), raw(datagram.data()), kHeaderSize,
                                                          raw(nonce.data()), &c.aes) == 0;
  }
  return crypto_aead_chacha20poly1305_ietf_decrypt_detached(raw(plaintext.data()), nullptr, raw(body), size,
                                                            raw(body + size), raw(datagram.data()), kHeaderSize,
                                                            raw(nonce.data()), raw(c.key.key.data())) == 0;
}

}  // namespace tandem::link
