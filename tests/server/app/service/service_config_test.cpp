// Warning about the end of a member's voucher.
#include "server/app/service/service_config.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tandem::server
