#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "common/trust/pin.h"
#include "common/base/secret.h"

struct evp_pkey_st;  // OpenSSL's EVP_PKEY and X509
struct x509_st;

namespace tandem::trust {

/// A P-256 key pair of a server or a workstation. Drawn by OpenSSL's own generator: the one place where randomness is no argument,
/// because a key made from handed-in numbers would be ours to get right.
class TlsKey {
 public:
  /// @throws std::runtime_error if OpenSSL cannot make one (no randomness)
  [[nodiscard]] static TlsKey generate();
  /// @return the key, or what is wrong (never a part of the text)
  [[nodiscard]] static std::expected<TlsKey, std::string> from_pem(std::span<const std::byte> pem);
  /// PKCS #8, not encrypted: the file's mode protects it. @throws std::runtime_error
  [[nodiscard]] SecretBuffer to_pem() const;

  [[nodiscard]] Pin pin() const;
  [[nodiscard]] evp_pkey_st* handle() const noexcept { return key_.get(); }

 private:
  struct Free {
    void operator()(evp_pkey_st* key) const noexcept;
  };
  explicit TlsKey(evp_pkey_st* key) noexcept : key_(key) {}
  std::unique_ptr<evp_pkey_st, Free> key_;
};

/// A self-signed certificate: what TLS wants around a public key. Nothing in it but the key is ever believed, since pins decide.
class Certificate {
 public:
  static constexpr std::int64_t kYears = 30;

  /// @param serial  random
  /// @param now     seconds since 1970, UTC; the certificate is valid from then, for 30 years of 365 days
  /// @throws std::runtime_error if OpenSSL cannot
  [[nodiscard]] static Certificate self_signed(const TlsKey& key, std::string_view common_name, std::span<const std::byte, 16> serial,
                                               std::int64_t now);
  [[nodiscard]] static std::expected<Certificate, std::string> from_pem(std::span<const std::byte> pem);
  [[nodiscard]] std::string to_pem() const;

  [[nodiscard]] Pin pin() const;
  [[nodiscard]] x509_st* handle() const noexcept { return certificate_.get(); }

 private:
  struct Free {
    void operator()(x509_st* certificate) const noexcept;
  };
  explicit Certificate(x509_st* certificate) noexcept : certificate_(certificate) {}
  std::unique_ptr<x509_st, Free> certificate_;
};

/// Pin of the key in a certificate. @return nothing if it is not a P-256 key: no other kind is ever made or accepted
[[nodiscard]] std::expected<Pin, std::string> pin_of(const x509_st* certificate);

/// A key and the certificate around it: how a machine shows itself in TLS.
struct Identity {
  TlsKey key;
  Certificate certificate;

  [[nodiscard]] static Identity make(std::string_view common_name, std::span<const std::byte, 16> serial, std::int64_t now);
  /// @return the pair, or what is wrong, such as a certificate around another key
  [[nodiscard]] static std::expected<Identity, std::string> from_pem(std::span<const std::byte> key, std::span<const std::byte> certificate);
  [[nodiscard]] Pin pin() const { return key.pin(); }
};

}  // namespace tandem::trust
