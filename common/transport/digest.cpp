#include "common/transport/digest.h"

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <stdexcept>

namespace tandem::transport {

struct Digest::Context {
  EVP_MD_CTX* evp = EVP_MD_CTX_new();
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { EVP_MD_CTX_free(evp); }
};

Digest::Digest() : context_(std::make_unique<Context>()) {
  if (context_->evp == nullptr || EVP_DigestInit_ex(context_->evp, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 is not available in this OpenSSL");
}
Digest::~Digest() = default;
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

void Digest::add(std::string_view bytes) noexcept { EVP_DigestUpdate(context_->evp, bytes.data(), bytes.size()); }

std::array<std::byte, 32> sha256(std::span<const std::byte> bytes) noexcept {
  std::array<unsigned char, 32> hash{};
  unsigned size = 0;
  EVP_Digest(bytes.data(), bytes.size(), hash.data(), &size, EVP_sha256(), nullptr);
  return std::bit_cast<std::array<std::byte, 32>>(hash);
}

std::string Digest::hex() {
  std::array<unsigned char, 32> hash{};
  unsigned size = 0;
  EVP_DigestFinal_ex(context_->evp, hash.data(), &size);
  std::string out;
  for (const unsigned char byte : hash) {
    out += "0123456789abcdef"[byte >> 4];
    out += "0123456789abcdef"[byte & 15];
  }
  return out;
}

}  // namespace tandem::transport
