#include "common/auth/limiter.h"

#include <gtest/gtest.h>

namespace tandem::auth {
namespace {

using namespace std::chrono_literals;

const Source kA = Source::of(Origin::v4(0x0a000001)), kB = Source::of(Origin::v4(0x0a000002));

TEST(Source, IsTheAddressOrTheFirst64BitsOfIpv6) {
  std::array<std::uint8_t, 16> a{0x20, 1, 0xd, 0xb8, 0, 0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8}, b = a;
  b[15] = 99;
  EXPECT_EQ(Source::of(Origin::of_v6(a)), Source::of(Origin::of_v6(b)));
  b[7] = 2;
  EXPECT_NE(Source::of(Origin::of_v6(a)), Source::of(Origin::of_v6(b)));
  EXPECT_FALSE(Source::of(Origin::of_v6(a)).loopback);
  EXPECT_EQ(Source::of(Origin::of_v6({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 10, 0, 0, 1})), kA);
  EXPECT_TRUE(Source::of(Origin::of_v6({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 127, 0, 0, 1})).loopback);
  EXPECT_TRUE(Source::of(Origin::of_v6({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1})).loopback);
  EXPECT_TRUE(Source::of(Origin::v4(0x7f000102)).loopback);
  EXPECT_FALSE(kA.loopback);
}

TEST(AcceptLimiter, LimitsOneSourceWithoutBlockingOthers) {
  AcceptLimiter limiter;
  const Time now{1h};
  int a = 0;
  for (int i = 0; i < 1000; ++i) a += limiter.accept(kA, now) ? 1 : 0;
  EXPECT_EQ(a, 100);
  EXPECT_TRUE(limiter.accept(kB, now));
}

TEST(SourceTable, IsBoundedAndEvictsTheLeastRecentSource) {
  SourceTable<int> table;
  const Time t0{1h};
  table.at(kA, t0, 0) = 7;
  for (std::uint32_t i = 0; i < SourceTable<int>::kMax - 1; ++i)
    table.at(Source::of(Origin::v4(i)), t0 + 1s + i * 1ms, 0) = 1;
  EXPECT_EQ(table.at(kA, t0 + 10s, 0), 7) << "heard of again";
  table.at(kB, t0 + 11s, 0) = 9;
  EXPECT_EQ(table.size(), SourceTable<int>::kMax);
  EXPECT_EQ(table.find(Source::of(Origin::v4(0))), nullptr);
  ASSERT_NE(table.find(kA), nullptr);
  EXPECT_EQ(*table.find(kA), 7);
  EXPECT_EQ(*table.find(kB), 9);
}

}  // namespace
}  // namespace tandem::auth
