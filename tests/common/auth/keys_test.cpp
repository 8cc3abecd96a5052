#include <gtest/gtest.h>
#include <openssl/x509.h>

#include "common/auth/tls_key.h"
#include "common/base/raw_bytes.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::kNow;

std::string pem(const TlsKey& key) {
  const auto text = key.to_pem();
  return std::string(text_of(text.bytes()));
}

TEST(TlsKey, SurvivesAFileRoundTrip) {
  const TlsKey key = TlsKey::generate();
  const auto read = TlsKey::from_pem(bytes_of(pem(key)));
  ASSERT_TRUE(read) << read.error();
  EXPECT_EQ(read->fingerprint(), key.fingerprint());
  EXPECT_NE(TlsKey::generate().fingerprint(), key.fingerprint());
}

TEST(TlsKey, RejectsNonKeysAndOtherKinds) {
  const std::string text = pem(TlsKey::generate());
  EXPECT_FALSE(TlsKey::from_pem({}));
  EXPECT_FALSE(TlsKey::from_pem(bytes_of(text.substr(0, text.size() / 2))));
  const std::string ed25519 =
      "-----BEGIN PRIVATE KEY-----\nMC4CAQAwBQYDK2VwBCIEIJ1hsZ3v/VpguoRK9JLsLMREScVpezJpGXA7rAMcrn9g\n-----END PRIVATE "
      "KEY-----\n";
  const auto other = TlsKey::from_pem(bytes_of(ed25519));
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().find("P-256"), std::string::npos);
}

TEST(KeyFingerprint, IsTheSha256OfTheSpkiAsOpenSslsOwnToolPrintsIt) {
  // openssl pkey -in key.pem -pubout -outform DER | sha256sum
  const std::string known =
      "-----BEGIN PRIVATE KEY-----\n"
      "MIGHAgEAMBMGByqGSM49AgEGCCqGSM49AwEHBG0wawIBAQQgCHz+rEMX9fojx2il\n"
      "ZY2YOkvu4/0JIcCUoA0bMDcuhxuhRANCAARcU21njbnIPp2Nt++bVicnSMQdUVlV\n"
      "EWgNxP2/69tuSXgiIv4Nl6mtKGvginn9Rtd97r0ROvmKaLkB59KdeLTN\n"
      "-----END PRIVATE KEY-----\n";
  const auto key = TlsKey::from_pem(bytes_of(known));
  ASSERT_TRUE(key) << key.error();
  EXPECT_EQ(key->fingerprint().hex(), "837ed7f1923b651405067adbc76c1eb58ac2fb874a470c945f0c13c7a0db91d6");
}

TEST(Certificate, HasTheKeysFingerprintA128BitSerialAndThirtyYears) {
  const TlsKey key = TlsKey::generate();
  const auto c = Certificate::self_signed(key, "tandem server", test::counting<16>(0x80), kNow);
  EXPECT_EQ(c.fingerprint(), key.fingerprint());
  EXPECT_EQ(X509_verify(c.handle(), key.handle()), 1);
  int days = 0, secs = 0;
  ASSERT_EQ(ASN1_TIME_diff(&days, &secs, X509_get0_notBefore(c.handle()), X509_get0_notAfter(c.handle())), 1);
  EXPECT_EQ(days, 30 * 365);
  EXPECT_EQ(secs, 0);
  const ASN1_INTEGER* const serial = X509_get0_serialNumber(c.handle());
  ASSERT_EQ(serial->length, 16);
  EXPECT_EQ(serial->data[0], 0x40);  // 0x80 was drawn; a serial number is positive and not zero
  EXPECT_EQ(serial->data[15], 0x8f);
  const auto read = Certificate::from_pem(bytes_of(c.to_pem()));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->fingerprint(), key.fingerprint());
}

TEST(Identity, NeedsTheCertificateOfItsOwnKey) {
  const Identity a = Identity::make("a", test::counting<16>(), kNow),
                 b = Identity::make("b", test::counting<16>(), kNow);
  const auto good = Identity::from_pem(bytes_of(pem(a.key)), bytes_of(a.certificate.to_pem()));
  ASSERT_TRUE(good) << good.error();
  EXPECT_EQ(good->fingerprint(), a.fingerprint());
  const auto mixed = Identity::from_pem(bytes_of(pem(a.key)), bytes_of(b.certificate.to_pem()));
  ASSERT_FALSE(mixed);
  EXPECT_NE(mixed.error().find("another key"), std::string::npos);
  EXPECT_FALSE(Identity::from_pem(bytes_of(a.certificate.to_pem()), bytes_of(pem(a.key))));
}

}  // namespace
}  // namespace tandem::auth
