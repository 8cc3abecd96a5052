#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"

namespace tandem::directory {

/// How to reach etcd.
struct EtcdOptions {
  std::vector<std::string> endpoints;  ///< "host:port" of one or more members; the next is tried when one fails
  /// Certificates in PEM. With `authority`, connections use TLS: etcd proves itself by a certificate that `authority`
  /// signed, and the server proves itself by `certificate` and `key`. All three or none.
  std::string authority, certificate, key;
  std::string name_in_certificate;                  ///< expected name of etcd; empty: the host of the endpoint
  Duration answer_limit = std::chrono::seconds(1);  ///< requests without an answer end with kUnknown

  /// Returns what is wrong with these options, in words, or nothing.
  [[nodiscard]] std::optional<std::string> problem() const;
};

}  // namespace tandem::directory
