// Pairs of certificate and private key in PEM.
#include "common/auth/io/pem_pair.h"

#include <gtest/gtest.h>

#include <array>

#include "common/auth/tls_key.h"

namespace tandem::auth {
namespace {

TEST(PemPair, IsAcceptedOnlyIfKeyAndCertificateBelongTogether) {
  const TlsKey own = TlsKey::generate(), other = TlsKey::generate();
  const std::string certificate =
      Certificate::self_signed(own, "etcd", std::array<std::byte, 16>{std::byte{1}}, 1700000000).to_pem();
  const auto text = [](const TlsKey& key) {
    const SecretBuffer pem = key.to_pem();
    return std::string(reinterpret_cast<const char*>(pem.bytes().data()), pem.bytes().size());
  };
  EXPECT_EQ(pem_pair_problem(certificate, text(own)), "");
  EXPECT_EQ(pem_pair_problem(certificate, text(other)), "the private key does not belong to the certificate");
  EXPECT_EQ(pem_pair_problem(text(own), text(own)), "the certificate is no certificate in PEM format");
  EXPECT_EQ(pem_pair_problem(certificate, "x"), "the private key is no key in PEM format without a password");
  EXPECT_NE(pem_pair_problem("", ""), "");
}

}  // namespace
}  // namespace tandem::auth
