#include "common/base/token_bucket.h"

#include <gtest/gtest.h>

namespace tandem {
namespace {

using namespace std::chrono_literals;

TEST(TokenBucket, AllowsABurstThenItsRate) {
  TokenBucket bucket(10, 100);
  const Time t0{1h};
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(bucket.take(t0));
  EXPECT_FALSE(bucket.take(t0));
  EXPECT_FALSE(bucket.take(t0 + 99ms));
  EXPECT_TRUE(bucket.take(t0 + 101ms));
  EXPECT_FALSE(bucket.take(t0 + 102ms));
  int through = 0;
  for (int i = 0; i < 1000; ++i) through += bucket.take(t0 + 1h + i * 1us) ? 1 : 0;
  EXPECT_EQ(through, 100) << "a rest fills it to the burst and no further";
  EXPECT_FALSE(bucket.take(t0)) << "time that goes back gives nothing";
}

// 1/60 s is no whole number of nanoseconds.
TEST(TokenBucket, AllowsTheWholeBurstAtAnyRate) {
  TokenBucket bucket(60, 120);
  const auto allowed = [&](Time now) {
    int count = 0;
    while (bucket.take(now)) ++count;
    return count;
  };
  EXPECT_EQ(allowed(Time{} + 1h), 120);
  EXPECT_EQ(allowed(Time{} + 1h + 1s), 60);
}

TEST(TokenBucket, NamesTheTimeUntilTheNextEvent) {
  TokenBucket bucket(4, 2);
  const Time t0{1h};
  EXPECT_EQ(bucket.wait(t0), 0ms);
  EXPECT_TRUE(bucket.take(t0) && bucket.take(t0));
  EXPECT_EQ(bucket.wait(t0), 250ms);
  EXPECT_EQ(bucket.wait(t0 + 100ms), 150ms);
  EXPECT_FALSE(bucket.take(t0 + 250ms - 1ns));
  EXPECT_TRUE(bucket.take(t0 + 250ms)) << "exactly when it is due";
}

TEST(TokenBucket, AllowsEventsEarlierByTheToleranceOnly) {
  TokenBucket bucket(10ms, 5ms);
  const Time t0{1h};
  EXPECT_TRUE(bucket.take(t0));
  EXPECT_FALSE(bucket.take(t0 + 5ms - 1ns));
  EXPECT_TRUE(bucket.take(t0 + 5ms));
  EXPECT_FALSE(bucket.take(t0 + 10ms)) << "the next is due at 20 ms";
  EXPECT_TRUE(bucket.take(t0 + 15ms));
}

}  // namespace
}  // namespace tandem
