#include "server/console/app/tls_files.h"

#include <fcntl.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/io/fd.h"

namespace tandem::console {
namespace {

std::string openssl_reason() {
  const unsigned long code = ERR_peek_last_error();
  ERR_clear_error();
  const char* reason = code != 0 ? ERR_reason_error_string(code) : nullptr;
  return reason != nullptr ? reason : "it is no PEM file";
}

/// A wildcard or another pattern is no name that a URL can have.
std::string text_of(const GENERAL_NAME& name) {
  if (name.type == GEN_DNS) {
    const std::string text(reinterpret_cast<const char*>(ASN1_STRING_get0_data(name.d.dNSName)),
                           static_cast<std::size_t>(ASN1_STRING_length(name.d.dNSName)));
    return text.find('*') == std::string::npos ? text : std::string{};
  }
  if (name.type != GEN_IPADD || ASN1_STRING_length(name.d.iPAddress) != 4) return {};
  const unsigned char* b = ASN1_STRING_get0_data(name.d.iPAddress);
  std::string text;
  for (int i = 0; i < 4; ++i) text += (i == 0 ? "" : ".") + std::to_string(b[i]);
  return text;
}

}  // namespace

std::expected<TlsFiles, std::string> TlsFiles::load(const std::string& certificate, const std::string& key) {
  for (const auto& [option, file] : {std::pair{"--certificate: ", certificate}, std::pair{"--key: ", key}})
    if (const io::Fd readable{::open(file.c_str(), O_RDONLY | O_CLOEXEC)}; !readable.open())
      return std::unexpected(option + file + " cannot be read: " + std::strerror(errno) +
                             "; name an existing file in PEM format that this user may read");
  ERR_clear_error();
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context{SSL_CTX_new(TLS_server_method()), &SSL_CTX_free};
  if (!context) return std::unexpected("TLS is not available: " + openssl_reason());
  if (SSL_CTX_use_certificate_chain_file(context.get(), certificate.c_str()) != 1)
    return std::unexpected("--certificate: " + certificate + " cannot be used: " + openssl_reason() +
                           "; give a certificate chain in PEM format");
  if (SSL_CTX_use_PrivateKey_file(context.get(), key.c_str(), SSL_FILETYPE_PEM) != 1 ||
      SSL_CTX_check_private_key(context.get()) != 1)
    return std::unexpected("--key: " + key + " cannot be used: " + openssl_reason() +
                           "; give the private key of the certificate in PEM format, without a password");
  TlsFiles files;
  files.certificate_ = certificate;
  files.key_ = key;
  X509* leaf = SSL_CTX_get0_certificate(context.get());
  X509_up_ref(leaf);
  files.leaf_ = {leaf, &X509_free};
  if (files.name().empty())
    return std::unexpected("--certificate: " + certificate +
                           " names no host; give one with subjectAltName (DNS or IP), which browsers require");
  return files;
}

bool TlsFiles::covers(std::string_view name) const {
  const std::string text(name);
  return X509_check_host(leaf_.get(), text.data(), text.size(), X509_CHECK_FLAG_NEVER_CHECK_SUBJECT, nullptr) == 1 ||
         X509_check_ip_asc(leaf_.get(), text.c_str(), 0) == 1;
}

std::string TlsFiles::name() const {
  auto* names = static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(leaf_.get(), NID_subject_alt_name, nullptr, nullptr));
  std::string found;
  for (int i = 0; i < sk_GENERAL_NAME_num(names) && found.empty(); ++i)
    found = text_of(*sk_GENERAL_NAME_value(names, i));
  GENERAL_NAMES_free(names);
  return found;
}

}  // namespace tandem::console
