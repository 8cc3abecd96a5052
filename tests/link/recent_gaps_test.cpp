#include "common/link/recent_gaps.h"

#include <gtest/gtest.h>

namespace tandem::link {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLeast = 100ms, kMost = 450ms;

/// A datagram each 5 ms from `from` on; the last one `gap` after the one before. @return when it came
Time steady(RecentGaps& gaps, Time from, Duration length, Duration gap = 5ms) {
  Time now = from;
  while (now < from + length) gaps.add(now += 5ms, 5ms);
  gaps.add(now += gap, gap);
  return now;
}

TEST(RecentGaps, ALinkThatIsNotYetKnownMayPauseForAsLongAsAny) {
  RecentGaps gaps;
  EXPECT_EQ(gaps.patience(kLeast, kMost), kMost);
  steady(gaps, Time{}, 49s);
  EXPECT_EQ(gaps.patience(kLeast, kMost), kMost);
}

TEST(RecentGaps, OfALinkWithoutGapsLittleIsBorne) {
  RecentGaps gaps;
  steady(gaps, Time{}, 61s);
  EXPECT_EQ(gaps.patience(kLeast, kMost), kLeast);
}

TEST(RecentGaps, EightTimesTheLongestGapIsBorneAndNoMoreThanTheMost) {
  RecentGaps gaps;
  const Time later = steady(gaps, Time{}, 61s, 30ms);
  EXPECT_EQ(gaps.patience(kLeast, kMost), 240ms);
  steady(gaps, later, 1s, 200ms);
  EXPECT_EQ(gaps.patience(kLeast, kMost), kMost);
}

TEST(RecentGaps, AGapIsForgottenAfterAMinute) {
  RecentGaps gaps;
  Time now = steady(gaps, Time{}, 61s, 30ms);
  now = steady(gaps, now, 45s);
  EXPECT_EQ(gaps.patience(kLeast, kMost), 240ms);
  steady(gaps, now, 20s);
  EXPECT_EQ(gaps.patience(kLeast, kMost), kLeast);
}

TEST(RecentGaps, ASceneThatAllowsLessThanTheLeastIsObeyed) {
  RecentGaps gaps;
  steady(gaps, Time{}, 61s);
  EXPECT_EQ(gaps.patience(kLeast, 40ms), 40ms);
  steady(gaps, Time{} + 62s, 1s, 300ms);
  EXPECT_EQ(gaps.patience(kLeast, 40ms), 40ms);
}

}  // namespace
}  // namespace tandem::link
