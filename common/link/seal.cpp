#include "common/link/seal.h"

#include <openssl/evp.h>
#include <openssl/kdf.h>

#include <stdexcept>
#include <string_view>

namespace tandem::link {

namespace {

/// OpenSSL speaks unsigned char; these are the only casts.
unsigned char* raw(std::byte* p) noexcept { return reinterpret_cast<unsigned char*>(p); }
const unsigned char* raw(const std::byte* p) noexcept { return reinterpret_cast<const unsigned char*>(p); }

struct ContextDeleter {
  void operator()(EVP_CIPHER_CTX* c) const noexcept { EVP_CIPHER_CTX_free(c); }
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
  std::memcpy(key.key.data(), bytes.data(), key.key.size());
  std::memcpy(key.iv.data(), bytes.data() + key.key.size(), key.iv.size());
  return key;
}

struct Seal::Context {
  std::unique_ptr<EVP_CIPHER_CTX, ContextDeleter> evp;
  std::array<std::byte, 12> iv{};

  [[nodiscard]] std::array<std::byte, 12> nonce(std::uint64_t counter) const noexcept {
    std::array<std::byte, 12> n = iv;
    for (std::size_t i = 0; i < 8; ++i) n[4 + i] ^= static_cast<std::byte>((counter >> (8 * i)) & 0xff);
    return n;
  }
};

Seal::Seal(const Key& key, Use use) : context_(std::make_unique<Context>()) {
  context_->evp.reset(EVP_CIPHER_CTX_new());
  context_->iv = key.iv;
  if (!context_->evp || EVP_CipherInit_ex(context_->evp.get(), EVP_aes_256_gcm(), nullptr, raw(key.key.data()), nullptr,
                                          use == Use::kSealing ? 1 : 0) != 1)
    throw std::runtime_error("AES-256-GCM is not available in this OpenSSL");
}

Seal::~Seal() = default;
Seal::Seal(Seal&&) noexcept = default;
Seal& Seal::operator=(Seal&&) noexcept = default;

bool Seal::seal(std::uint64_t counter, std::span<std::byte> datagram) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize) return false;
  EVP_CIPHER_CTX* c = context_->evp.get();
  const auto nonce = context_->nonce(counter);
  std::byte* body = datagram.data() + kHeaderSize;
  const int size = static_cast<int>(datagram.size() - kHeaderSize - kTagSize);
  int n = 0;
  return EVP_EncryptInit_ex(c, nullptr, nullptr, nullptr, raw(nonce.data())) == 1 &&
         EVP_EncryptUpdate(c, nullptr, &n, raw(datagram.data()), static_cast<int>(kHeaderSize)) == 1 &&
         EVP_EncryptUpdate(c, raw(body), &n, raw(body), size) == 1 && EVP_EncryptFinal_ex(c, raw(body + size), &n) == 1 &&
         EVP_CIPHER_CTX_ctrl(c, EVP_CTRL_GCM_GET_TAG, static_cast<int>(kTagSize), raw(body + size)) == 1;
}

bool Seal::open(std::uint64_t counter, std::span<const std::byte> datagram, std::span<std::byte> plaintext) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize || plaintext.size() != datagram.size() - kHeaderSize - kTagSize) return false;
  EVP_CIPHER_CTX* c = context_->evp.get();
  const auto nonce = context_->nonce(counter);
  const std::byte* body = datagram.data() + kHeaderSize;
  const int size = static_cast<int>(plaintext.size());
  std::array<std::byte, kTagSize> tag{};
  std::memcpy(tag.data(), body + size, kTagSize);
  int n = 0;
  return EVP_DecryptInit_ex(c, nullptr, nullptr, nullptr, raw(nonce.data())) == 1 &&
         EVP_DecryptUpdate(c, nullptr, &n, raw(datagram.data()), static_cast<int>(kHeaderSize)) == 1 &&
         EVP_DecryptUpdate(c, raw(plaintext.data()), &n, raw(body), size) == 1 &&
         EVP_CIPHER_CTX_ctrl(c, EVP_CTRL_GCM_SET_TAG, static_cast<int>(kTagSize), raw(tag.data())) == 1 &&
         EVP_DecryptFinal_ex(c, raw(plaintext.data()) + size, &n) == 1;
}

}  // namespace tandem::link
