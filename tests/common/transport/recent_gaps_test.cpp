#include "common/transport/recent_gaps.h"

#include <gtest/gtest.h>

namespace tandem::transport {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLeast = 100ms, kMost = 450ms;

/// Adds a datagram every 5 ms from `from` on, and a last one after `gap`. @return arrival time of the last one
Time steady(RecentGaps& gaps, Time from, Duration length, Duration gap = 5ms) {
  Time now = from;
  while (now < from + length) gaps.add(now += 5ms, 5ms);
  gaps.add(now += gap, gap);
  return now;
}

TEST(RecentGaps, AllowTheLongestPauseOnAnUnknownLink) {
  RecentGaps gaps;
  EXPECT_EQ(gaps.silence_limit(kLeast, kMost), kMost);
  steady(gaps, Time{}, 49s);
  EXPECT_EQ(gaps.silence_limit(kLeast, kMost), kMost);
}

TEST(RecentGaps, AllowTheLeastPauseOnALinkWithoutGaps) {
  RecentGaps gaps;
  steady(gaps, Time{}, 61s);
  EXPECT_EQ(gaps.silence_limit(kLeast, kMost), kLeast);
}

TEST(RecentGaps, AllowEightTimesTheLongestGapUpToTheMaximum) {
  RecentGaps gaps;
  const Time later = steady(gaps, Time{}, 61s, 30ms);
  EXPECT_EQ(gaps.silence_limit(kLeast, kMost), 240ms);
  steady(gaps, later, 1s, 200ms);
  EXPECT_EQ(gaps.silence_limit(kLeast, kMost), kMost);
}

TEST(RecentGaps, ForgetAGapAfterAMinute) {
  RecentGaps gaps;
  Time now = steady(gaps, Time{}, 61s, 30ms);
  now = steady(gaps, now, 45s);
  EXPECT_EQ(gaps.silence_limit(kLeast, kMost), 240ms);
  steady(gaps, now, 20s);
  EXPECT_EQ(gaps.silence_limit(kLeast, kMost), kLeast);
}

TEST(RecentGaps, ObeyASceneLimitBelowTheMinimum) {
  RecentGaps gaps;
  steady(gaps, Time{}, 61s);
  EXPECT_EQ(gaps.silence_limit(kLeast, 40ms), 40ms);
  steady(gaps, Time{} + 62s, 1s, 300ms);
  EXPECT_EQ(gaps.silence_limit(kLeast, 40ms), 40ms);
}

}  // namespace
}  // namespace tandem::transport
