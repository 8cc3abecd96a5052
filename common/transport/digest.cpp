#include "common/transport/digest.h"

#include <openssl/evp.h>

#include <stdexcept>

#include "common/base/hex.h"
#include "common/base/raw_bytes.h"

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

std::string Digest::hex() {
  std::array<std::byte, 32> hash{};
  EVP_DigestFinal_ex(context_->evp, raw(hash.data()), nullptr);
  return to_hex(hash);
}

std::array<std::byte, 32> sha256(std::span<const std::byte> first, std::span<const std::byte> second) noexcept {
  std::array<std::byte, 32> hash{};
  EVP_MD_CTX* const context = EVP_MD_CTX_new();
  EVP_DigestInit_ex(context, EVP_sha256(), nullptr);
  EVP_DigestUpdate(context, first.data(), first.size());
  EVP_DigestUpdate(context, second.data(), second.size());
  EVP_DigestFinal_ex(context, raw(hash.data()), nullptr);
  EVP_MD_CTX_free(context);
  return hash;
}

}  // namespace tandem::transport
