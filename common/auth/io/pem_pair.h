#pragma once

#include <string>

namespace tandem::auth {

/// Returns why a certificate and a private key, both texts in PEM, cannot be used together for TLS; empty: they can.
/// The first certificate counts; further ones are its chain. The text has no part of the key.
[[nodiscard]] std::string pem_pair_problem(const std::string& certificate, const std::string& key);

}  // namespace tandem::auth
