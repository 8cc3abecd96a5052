#include "common/auth/tls_key.h"

#include <openssl/bio.h>
#include <openssl/core_names.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"

namespace tandem::auth {
namespace {

struct FreeBio {
  void operator()(BIO* bio) const noexcept { BIO_free(bio); }
};
using Bio = std::unique_ptr<BIO, FreeBio>;

[[noreturn]] void fail(const char* what) { throw std::runtime_error(std::string("OpenSSL cannot ") + what); }

Bio reading(std::span<const std::byte> bytes) {
  // An empty span may have a null pointer, which OpenSSL rejects.
  Bio bio{BIO_new_mem_buf(bytes.empty() ? "" : as_text(bytes.data()),
                          static_cast<int>(std::min<std::size_t>(bytes.size(), 1 << 20)))};
  if (!bio) fail("read memory");
  return bio;
}

std::span<const std::byte> written(const Bio& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return {as_bytes(data), static_cast<std::size_t>(std::max(size, 0L))};
}

bool is_p256(const EVP_PKEY* key) {
  if (EVP_PKEY_get_base_id(key) != EVP_PKEY_EC) return false;
  char group[64] = {};
  std::size_t length = 0;
  return EVP_PKEY_get_utf8_string_param(key, OSSL_PKEY_PARAM_GROUP_NAME, group, sizeof group, &length) == 1 &&
         std::string_view(group, length) == SN_X9_62_prime256v1;
}

/// A key file has no passphrase, so OpenSSL must not ask for one at a terminal.
int no_passphrase(char*, int, int, void*) { return -1; }

constexpr char kNotP256[] = "is a key of another kind: P-256 is the only one used here";

std::expected<KeyFingerprint, std::string> fingerprint_of_key(X509_PUBKEY* key) {
  unsigned char* der = nullptr;
  const int size = i2d_X509_PUBKEY(key, &der);
  if (size <= 0) return std::unexpected("the public key cannot be written");
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owner{der, [](unsigned char* p) { OPENSSL_free(p); }};
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  std::transform(der, der + size, bytes.begin(), [](unsigned char c) { return std::byte{c}; });
  return KeyFingerprint{transport::sha256(bytes)};
}

/// Object identifier of the credential: the arc 2.25 of UUIDs needs no registration [ITU-T X.667].
struct CredentialId {
  ASN1_OBJECT* object = OBJ_txt2obj("2.25.153576311631204445934303684696471065803", 1);
  CredentialId() = default;
  CredentialId(const CredentialId&) = delete;
  CredentialId& operator=(const CredentialId&) = delete;
  ~CredentialId() { ASN1_OBJECT_free(object); }
};

bool add_credential(X509* certificate, std::span<const std::byte> credential) {
  const CredentialId id;
  ASN1_OCTET_STRING* const content = ASN1_OCTET_STRING_new();
  X509_EXTENSION* extension = nullptr;
  const bool made = id.object != nullptr && content != nullptr &&
                    ASN1_OCTET_STRING_set(content, raw(credential.data()), static_cast<int>(credential.size())) == 1 &&
                    X509_EXTENSION_create_by_OBJ(&extension, id.object, 0, content) != nullptr;
  const bool added = made && X509_add_ext(certificate, extension, -1) == 1;
  X509_EXTENSION_free(extension);
  ASN1_OCTET_STRING_free(content);
  return added;
}

}  // namespace

void TlsKey::Free::operator()(evp_pkey_st* key) const noexcept { EVP_PKEY_free(key); }
void Certificate::Free::operator()(x509_st* certificate) const noexcept { X509_free(certificate); }

TlsKey TlsKey::generate() {
  EVP_PKEY* const key = EVP_EC_gen(SN_X9_62_prime256v1);
  if (key == nullptr) fail("make a key: is there no source of randomness?");
  return TlsKey(key);
}

std::expected<TlsKey, std::string> TlsKey::from_pem(std::span<const std::byte> pem) {
  TlsKey key(PEM_read_bio_PrivateKey(reading(pem).get(), nullptr, &no_passphrase, nullptr));
  if (!key.key_) return std::unexpected("holds no private key in PEM form without passphrase");
  if (!is_p256(key.handle())) return std::unexpected(kNotP256);
  return key;
}

SecretBuffer TlsKey::to_pem() const {
  const Bio bio{BIO_new(BIO_s_secmem())};  // wiped when it is freed
  if (!bio || PEM_write_bio_PKCS8PrivateKey(bio.get(), handle(), nullptr, nullptr, 0, nullptr, nullptr) != 1)
    fail("write a key");
  return SecretBuffer(written(bio));
}

KeyFingerprint TlsKey::fingerprint() const {
  X509_PUBKEY* spki = nullptr;
  if (X509_PUBKEY_set(&spki, handle()) != 1) fail("write a public key");
  const auto fingerprint = fingerprint_of_key(spki);
  X509_PUBKEY_free(spki);
  if (!fingerprint) fail("write a public key");
  return *fingerprint;
}

Certificate Certificate::self_signed(const TlsKey& key, std::string_view common_name,
                                     std::span<const std::byte, 16> serial, std::int64_t now,
                                     std::span<const std::byte> credential) {
  Certificate made(X509_new());
  X509* const x = made.handle();
  if (x == nullptr) fail("make a certificate");
  // The serial number must be positive and not zero for any random bytes [RFC 5280 4.1.2.2].
  std::array<std::byte, 16> number;
  std::copy(serial.begin(), serial.end(), number.begin());
  number[0] = (number[0] & std::byte{0x3f}) | std::byte{0x40};
  BIGNUM* const big = BN_bin2bn(raw(number.data()), static_cast<int>(number.size()), nullptr);
  const bool numbered = big != nullptr && BN_to_ASN1_INTEGER(big, X509_get_serialNumber(x)) != nullptr;
  BN_free(big);
  X509_NAME* const name = X509_get_subject_name(x);
  constexpr std::int64_t kSeconds = Certificate::kYears * 365 * 24 * 3600;
  const bool good =
      numbered && X509_set_version(x, X509_VERSION_3) == 1 && ASN1_TIME_set(X509_getm_notBefore(x), now) != nullptr &&
      ASN1_TIME_set(X509_getm_notAfter(x), now + kSeconds) != nullptr &&
      X509_NAME_add_entry_by_NID(name, NID_commonName, MBSTRING_UTF8, raw(common_name.data()),
                                 static_cast<int>(common_name.size()), -1, 0) == 1 &&
      X509_set_issuer_name(x, name) == 1 && X509_set_pubkey(x, key.handle()) == 1 &&
      (credential.empty() || add_credential(x, credential)) && X509_sign(x, key.handle(), EVP_sha256()) > 0;
  if (!good) fail("make a certificate");
  return made;
}

std::expected<Certificate, std::string> Certificate::from_pem(std::span<const std::byte> pem) {
  Certificate read(PEM_read_bio_X509(reading(pem).get(), nullptr, &no_passphrase, nullptr));
  if (!read.certificate_) return std::unexpected("holds no certificate in PEM form");
  if (const auto fingerprint = fingerprint_of(read.handle()); !fingerprint) return std::unexpected(fingerprint.error());
  return read;
}

std::string Certificate::to_pem() const {
  const Bio bio{BIO_new(BIO_s_mem())};
  if (!bio || PEM_write_bio_X509(bio.get(), handle()) != 1) fail("write a certificate");
  return std::string(text_of(written(bio)));
}

KeyFingerprint Certificate::fingerprint() const {
  const auto fingerprint = fingerprint_of(handle());
  if (!fingerprint) fail("read a certificate's key");
  return *fingerprint;
}

std::expected<KeyFingerprint, std::string> fingerprint_of(const x509_st* certificate) {
  const EVP_PKEY* const key = X509_get0_pubkey(certificate);
  if (key == nullptr || !is_p256(key)) return std::unexpected(kNotP256);
  return fingerprint_of_key(X509_get_X509_PUBKEY(certificate));
}

std::vector<std::byte> credential_in(const x509_st* certificate) {
  const CredentialId id;
  const int at = id.object == nullptr ? -1 : X509_get_ext_by_OBJ(certificate, id.object, -1);
  const ASN1_OCTET_STRING* const content = at < 0 ? nullptr : X509_EXTENSION_get_data(X509_get_ext(certificate, at));
  if (content == nullptr) return {};
  const std::size_t size = static_cast<std::size_t>(ASN1_STRING_length(content));
  const auto bytes = bytes_of({as_text(ASN1_STRING_get0_data(content)), size});
  return {bytes.begin(), bytes.end()};
}

Identity Identity::make(std::string_view common_name, std::span<const std::byte, 16> serial, std::int64_t now) {
  TlsKey key = TlsKey::generate();
  Certificate certificate = Certificate::self_signed(key, common_name, serial, now);
  return {std::move(key), std::move(certificate)};
}

std::expected<Identity, std::string> Identity::from_pem(std::span<const std::byte> key,
                                                        std::span<const std::byte> certificate) {
  auto private_key = TlsKey::from_pem(key);
  if (!private_key) return std::unexpected("the key file " + private_key.error());
  auto around = Certificate::from_pem(certificate);
  if (!around) return std::unexpected("the certificate file " + around.error());
  if (private_key->fingerprint() != around->fingerprint())
    return std::unexpected("the certificate belongs to another key");
  return Identity{std::move(*private_key), std::move(*around)};
}

}  // namespace tandem::auth
