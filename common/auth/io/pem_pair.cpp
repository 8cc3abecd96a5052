#include "common/auth/io/pem_pair.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <memory>

namespace tandem::auth {
namespace {

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;

Bio bio_of(const std::string& text) { return {BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), &BIO_free}; }

int no_password(char*, int, int, void*) { return -1; }  // OpenSSL would ask at the terminal

}  // namespace

std::string pem_pair_problem(const std::string& certificate, const std::string& key) {
  const Bio public_text = bio_of(certificate), private_text = bio_of(key);
  const std::unique_ptr<X509, decltype(&X509_free)> leaf{
      PEM_read_bio_X509(public_text.get(), nullptr, no_password, nullptr), &X509_free};
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> own{
      PEM_read_bio_PrivateKey(private_text.get(), nullptr, no_password, nullptr), &EVP_PKEY_free};
  const bool pair = leaf && own && X509_check_private_key(leaf.get(), own.get()) == 1;
  ERR_clear_error();
  if (!leaf) return "the certificate is no certificate in PEM format";
  if (!own) return "the private key is no key in PEM format without a password";
  return pair ? std::string{} : "the private key does not belong to the certificate";
}

}  // namespace tandem::auth
