// A service over an etcd that demands certificates of its clients.
#include <ctime>

#include "common/auth/tls_key.h"
#include "tests/io/pressing_service.h"

namespace tandem::test {
namespace {

/// A key with a certificate that it signed itself: its own authority.
struct TlsFiles {
  TlsFiles(const Folder& folder, const std::string& name)
      : certificate(folder.write(
            name + ".pem",
            auth::Certificate::self_signed(own, "etcd", std::array<std::byte, 16>{std::byte{1}}, std::time(nullptr))
                .to_pem())) {
    const SecretBuffer pem = own.to_pem();
    const auto bytes = pem.bytes();
    key = folder.write(name + ".key", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  auth::TlsKey own = auth::TlsKey::generate();
  std::string certificate, key;
};

/// Fields of block `directory`. @param authority  of etcd
std::string directory_of(const TlsFiles& authority, const TlsFiles& own) {
  return "authority: \"" + authority.certificate + "\" certificate: \"" + own.certificate + "\" private_key: \"" +
         own.key + "\" name_in_certificate: \"etcd\" ";
}

class ServiceTls : public PressingServiceTest {};

TEST_F(ServiceTls, ServesHandsOverAnEtcdThatDemandsCertificatesAndNamesAWrongOne) {
  const Folder folder;
  const TlsFiles etcd(folder, "etcd"), servers(folder, "servers"), stranger(folder, "stranger");
  PressingService pressed(1, {"--cert-file", etcd.certificate, "--key-file", etcd.key, "--client-cert-auth",
                              "--trusted-ca-file", servers.certificate});
  LiveService& service = pressed.service();
  for (const char* name : {"a", "b"}) service.set(name, {.directory = directory_of(etcd, servers)});
  pressed.start({"a", "b"});
  pressed.join(service.address("a"));
  service.of("a").signal(SIGKILL);
  pressed.wait_until_active("b");
  const std::vector<Absence> all = pressed.expect_safe(1);
  EXPECT_EQ(all.size(), 2U);
  for (const Absence& absence : all) EXPECT_LE(absence.back_s, 7);
  // Servers with a wrong certificate, with a wrong authority of etcd, and without TLS.
  const std::string remedy = "etcd must accept directory { certificate } by its --trusted-ca-file";
  for (const auto& [name, directory, words] :
       {std::tuple{"c", directory_of(etcd, stranger), remedy}, std::tuple{"d", directory_of(stranger, servers), remedy},
        std::tuple{"e", std::string(), std::string("An etcd that demands TLS needs directory { authority")}}) {
    SCOPED_TRACE(name);
    service.set(name, {.directory = directory});
    Process& wrong = service.start(name);
    ASSERT_TRUE(wrong.wait_for("cannot be reached")) << wrong.err();
    EXPECT_TRUE(wrong.wait_for(words)) << wrong.err();
  }
}

}  // namespace
}  // namespace tandem::test
