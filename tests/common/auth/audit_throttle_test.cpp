#include "common/auth/audit_throttle.h"

#include <gtest/gtest.h>

namespace tandem::auth {
namespace {

using namespace std::chrono_literals;

constexpr Time at(Duration since) { return Time{} + since; }

TEST(AuditThrottle, TakesTenAtOnceOfASourceThenSixAMinute) {
  AuditThrottle throttle;
  int taken = 0;
  for (int i = 0; i < 1000; ++i) taken += throttle.admit("a", at(1s)) ? 1 : 0;
  EXPECT_EQ(taken, 10);
  EXPECT_EQ(throttle.suppressed(), 990u);
  for (int s = 2; s <= 62; ++s) taken += throttle.admit("a", at(std::chrono::seconds(s))) ? 1 : 0;
  EXPECT_EQ(taken, 16);
}

TEST(AuditThrottle, LimitsEachSourceSeparately) {
  AuditThrottle throttle;
  for (int i = 0; i < 1000; ++i) (void)throttle.admit("flood", at(1s));
  EXPECT_TRUE(throttle.admit("other", at(1s)));
}

TEST(AuditThrottle, ManySourcesTogetherTakeSixtyAMinute) {
  AuditThrottle throttle;
  int taken = 0;
  for (int i = 0; i < 60000; ++i) taken += throttle.admit("s" + std::to_string(i), at(1s + i * 1ms)) ? 1 : 0;
  EXPECT_LE(taken, 121);
  EXPECT_GE(taken, 118);
}

TEST(AuditThrottle, ReportsOmittedCountsPerSourceOnceAMinute) {
  AuditThrottle throttle;
  EXPECT_FALSE(throttle.summary(at(1000s))) << "nothing was left out";
  for (int i = 0; i < 110; ++i) (void)throttle.admit("192.0.2.1", at(1s));
  for (int i = 0; i < 13; ++i) (void)throttle.admit("192.0.2.2", at(2s));
  EXPECT_FALSE(throttle.summary(at(60s)));
  const auto told = throttle.summary(at(61s));
  ASSERT_TRUE(told);
  EXPECT_EQ(*told, "103 lines about refused peers were left out: 100 of 192.0.2.1, 3 of 192.0.2.2");
  EXPECT_FALSE(throttle.summary(at(200s))) << "told once";
  EXPECT_FALSE(throttle.last_summary());
}

TEST(AuditThrottle, HasBoundedMemoryAndLosesNoCount) {
  AuditThrottle throttle;
  std::uint64_t left = 0;
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 3000; ++i) left += throttle.admit("s" + std::to_string(i), at(1s)) ? 0 : 1;
  EXPECT_EQ(throttle.suppressed(), left);
  const auto told = throttle.last_summary();
  ASSERT_TRUE(told);
  EXPECT_TRUE(told->starts_with(std::to_string(left) + " lines")) << *told;
  EXPECT_NE(told->find("of others"), std::string::npos) << "most sources were forgotten or are not named: " << *told;
}

}  // namespace
}  // namespace tandem::auth
