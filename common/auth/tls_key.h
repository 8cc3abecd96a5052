#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/auth/key_fingerprint.h"
#include "common/base/secret.h"

struct evp_pkey_st;  // OpenSSL's EVP_PKEY and X509
struct x509_st;

namespace tandem::auth {

/// A P-256 key pair of a server or a workstation. OpenSSL's own generator draws it. Elsewhere random bytes are
/// arguments, but key generation from passed-in numbers would have to be implemented here.
class TlsKey {
 public:
  /// @throws std::runtime_error if OpenSSL cannot generate a key (no randomness)
  [[nodiscard]] static TlsKey generate();
  /// @return the key, or the reason for rejection (never a part of the text)
  [[nodiscard]] static std::expected<TlsKey, std::string> from_pem(std::span<const std::byte> pem);
  /// Returns PKCS #8, not encrypted: the file's mode protects it. @throws std::runtime_error
  [[nodiscard]] SecretBuffer to_pem() const;

  [[nodiscard]] KeyFingerprint fingerprint() const;
  [[nodiscard]] evp_pkey_st* handle() const noexcept { return key_.get(); }

 private:
  struct Free {
    void operator()(evp_pkey_st* key) const noexcept;
  };
  explicit TlsKey(evp_pkey_st* key) noexcept : key_(key) {}
  std::unique_ptr<evp_pkey_st, Free> key_;
};

/// A self-signed certificate: the container for a public key that TLS requires. Only its key is used; trust is decided
/// by fingerprints.
class Certificate {
 public:
  static constexpr std::int64_t kYears = 30;

  /// @param serial  random
  /// @param now     seconds since 1970, UTC; the certificate is valid from then on, for 30 years of 365 days
  /// @param credential  encoded MemberCredential (proto/rpc/service_codec.h) of a server; empty: none
  /// @throws std::runtime_error if OpenSSL fails
  [[nodiscard]] static Certificate self_signed(const TlsKey& key, std::string_view common_name,
                                               std::span<const std::byte, 16> serial, std::int64_t now,
                                               std::span<const std::byte> credential = {});
  [[nodiscard]] static std::expected<Certificate, std::string> from_pem(std::span<const std::byte> pem);
  [[nodiscard]] std::string to_pem() const;

  [[nodiscard]] KeyFingerprint fingerprint() const;
  [[nodiscard]] x509_st* handle() const noexcept { return certificate_.get(); }

 private:
  struct Free {
    void operator()(x509_st* certificate) const noexcept;
  };
  explicit Certificate(x509_st* certificate) noexcept : certificate_(certificate) {}
  std::unique_ptr<x509_st, Free> certificate_;
};

/// Returns the KeyFingerprint of the key in a certificate. @return an error if the key is not a P-256 key, the only
/// accepted kind
[[nodiscard]] std::expected<KeyFingerprint, std::string> fingerprint_of(const x509_st* certificate);
/// Returns the MemberCredential in a certificate, not decoded; empty: it has none.
[[nodiscard]] std::vector<std::byte> credential_in(const x509_st* certificate);

/// Key that a server shows in the handshake, and its credential.
struct PresentedKey : KeyFingerprint {
  explicit PresentedKey(const KeyFingerprint& key, std::vector<std::byte> shown = {})
      : KeyFingerprint(key), credential(std::move(shown)) {}
  std::vector<std::byte> credential;  ///< encoded MemberCredential; empty: it belongs to no service
};

/// A key and its certificate: the identity of a machine in TLS.
struct Identity {
  TlsKey key;
  Certificate certificate;

  [[nodiscard]] static Identity make(std::string_view common_name, std::span<const std::byte, 16> serial,
                                     std::int64_t now);
  /// @return the pair, or the reason for rejection, such as a certificate for another key
  [[nodiscard]] static std::expected<Identity, std::string> from_pem(std::span<const std::byte> key,
                                                                     std::span<const std::byte> certificate);
  [[nodiscard]] KeyFingerprint fingerprint() const { return key.fingerprint(); }
};

}  // namespace tandem::auth
