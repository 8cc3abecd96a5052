#include "common/base/time.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;

TEST(Time, ConvertsSecondsToTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(0), 0ns);
  EXPECT_EQ(from_seconds(1e-3), 1ms);
  EXPECT_EQ(from_seconds(0.1), 100ms);
  EXPECT_EQ(from_seconds(1.4e-9), 1ns);
  EXPECT_EQ(from_seconds(1.6e-9), 2ns);
  EXPECT_EQ(from_seconds(-1.6e-9), -2ns);
  EXPECT_EQ(from_seconds(-0.25), -250ms);
  EXPECT_EQ(from_seconds(8e9), 8'000'000'000s);
}

TEST(Time, ConvertsBackWithoutLoss) {
  EXPECT_EQ(seconds(1ms), 0.001);
  EXPECT_EQ(seconds(-90s), -90);
  RandomStream random{1};
  for (int i = 0; i < 10000; ++i) {
    const Duration d{static_cast<std::int64_t>(random.below(std::uint64_t{1} << 51))};  // 26 days
    ASSERT_EQ(from_seconds(seconds(d)), d);
    ASSERT_EQ(from_seconds(-seconds(d)), -d);
  }
}

}  // namespace
}  // namespace tandem
