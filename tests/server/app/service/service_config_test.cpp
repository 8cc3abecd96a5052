// Options of a member of a service, and the warning about the end of its voucher.
#include "server/app/service/service_config.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "common/auth/tls_key.h"

namespace tandem::server {
namespace {

constexpr std::int64_t kDay = 86400, kEnd = 951782400;  // 2000-02-29

std::string warning_at(std::int64_t now) {
  auth::ServiceMembership membership;
  membership.name = "desk-a";
  membership.not_after = kEnd;
  return voucher_warning(membership, auth::KeyFingerprint{{std::byte{0x3f}}}, now);
}

TEST(VoucherWarning, BeginsThirtyDaysBeforeTheEnd) {
  EXPECT_EQ(warning_at(kEnd - 400 * kDay), "");
  EXPECT_EQ(warning_at(kEnd - 30 * kDay - 1), "");
  EXPECT_NE(warning_at(kEnd - 30 * kDay), "");
  EXPECT_NE(warning_at(kEnd), "");
}

TEST(VoucherWarning, NamesTheDateAndTheCommandsToRun) {
  const std::string text = warning_at(kEnd - 3 * kDay), key = "3f" + std::string(62, '0');
  EXPECT_EQ(text.find("the voucher of this server expires on 2000-02-29 (UTC)"), 0U) << text;
  EXPECT_NE(text.find("`tandem-server service vouch FOLDER --name desk-a --key " + key + " --out FILE`"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("`tandem-server service join FILE`"), std::string::npos) << text;
}

/// Such a pair cannot prove this server to etcd, which then only falls silent.
TEST(ServiceOptionsFromConfig, RejectACertificateWithTheKeyOfAnotherAndNameTheFilesForEtcdctl) {
  const auth::TlsKey own = auth::TlsKey::generate(), other = auth::TlsKey::generate();
  std::string folder = ::testing::TempDir() + "tandem-config-XXXXXX";
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const auto write_key = [&](const char* name, const auth::TlsKey& key) {
    const SecretBuffer pem = key.to_pem();
    std::ofstream(folder + "/" + name) << std::string_view(reinterpret_cast<const char*>(pem.bytes().data()),
                                                           pem.bytes().size());
  };
  std::ofstream(folder + "/own.pem")
      << auth::Certificate::self_signed(own, "a", std::array<std::byte, 16>{std::byte{1}}, 1700000000).to_pem();
  write_key("own.key", own);
  write_key("other.key", other);
  ServerConfigSpec config;
  config.directory.emplace();
  config.directory->authority.text = config.directory->certificate.text = "own.pem";
  const auto read = [&](const char* key) {
    config.directory->private_key.text = key;
    InputErrors errors;
    const auto options = service_options_from(
        config, std::nullopt, [&](const std::string& name) { return folder + "/" + name; }, errors);
    EXPECT_TRUE(options);
    return std::pair(to_text(errors), options ? options->tls_options : "");
  };
  EXPECT_EQ(read("own.key").first, "");
  EXPECT_EQ(read("own.key").second,
            " --cacert " + folder + "/own.pem --cert " + folder + "/own.pem --key " + folder + "/own.key");
  EXPECT_NE(read("other.key").first.find("the private key does not belong to the certificate"), std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace tandem::server
