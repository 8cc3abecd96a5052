#pragma once

#include <expected>
#include <memory>
#include <string>
#include <string_view>

struct x509_st;

namespace tandem::console {

/// Certificate and key of the page, as files in PEM format.
class TlsFiles {
 public:
  /// @param certificate  chain, the gateway's own first
  /// @param key          its private key, without a password
  /// @return error: the option, the file, and why it cannot be used
  [[nodiscard]] static std::expected<TlsFiles, std::string> load(const std::string& certificate,
                                                                 const std::string& key);

  /// Whether the certificate is for this DNS name or address.
  [[nodiscard]] bool covers(std::string_view name) const;
  /// First DNS name or address of the certificate; empty: none.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] const std::string& certificate() const noexcept { return certificate_; }
  [[nodiscard]] const std::string& key() const noexcept { return key_; }

 private:
  std::string certificate_, key_;
  std::shared_ptr<x509_st> leaf_;
};

}  // namespace tandem::console
