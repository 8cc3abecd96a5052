#include "netsim/quality/link_quality.h"

#include <gtest/gtest.h>

#include "tests/netsim/quality/quality_support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Counts = std::array<std::uint64_t, kBands>;

double ms(Duration d) { return seconds(d) * 1e3; }

TEST(LinkQuality, IsGreenForAConstantDelay) {
  const DirectionSummary s = judged(regular(20'001, 10ms)).summary();
  EXPECT_EQ(s.sent, 20'001U);
  EXPECT_EQ(s.arrived, 20'001U);
  EXPECT_EQ(s.lost, 0U);
  EXPECT_EQ(s.from, Time{});
  EXPECT_EQ(s.until, Time{20'010ms});
  EXPECT_EQ(s.delay.p5, 10ms);
  EXPECT_EQ(s.delay.p50, 10ms);
  EXPECT_EQ(s.delay.p99, 10ms);
  EXPECT_EQ(s.delay.max, 10ms);
  EXPECT_NEAR(s.delay.mean_s, 0.010, 1e-12);
  EXPECT_EQ(s.longest_gap, 1ms);
  EXPECT_EQ(s.reordered + s.duplicates + s.pauses, 0U);
  // The age is 10 ms when a datagram arrives and 11 ms when the next one does.
  EXPECT_EQ(s.age.watched, 20s);
  EXPECT_NEAR(s.age.mean_s, 0.0105, 1e-12);
  EXPECT_EQ(s.age.p50, 10'500us);
  EXPECT_EQ(s.age.p99, 10'990us);
  EXPECT_EQ(s.age.max, 11ms);
  // 2001 steps of 10 ms end by 20.01 s.
  for (const auto& [w, windows] : {std::pair{0U, 1992U}, {1U, 1902U}, {2U, 1002U}}) {
    EXPECT_EQ(s.windows[w].windows, windows) << w;
    EXPECT_EQ(s.windows[w].bands, (Counts{windows, 0, 0})) << w;
    EXPECT_EQ(s.windows[w].of(Measure::kGap).worst, 0.001);
  }
}

TEST(LinkQuality, ShowsAHoldOutageAsASawtoothOfAge) {
  // Held from 5 s for 400 ms, all released at once, then 10 ms of delay as before.
  auto all = regular(20'001, 10ms);
  for (std::size_t i = 5000; i < 5400; ++i) all[i].delays = {Time{5410ms} - all[i].at};
  const DirectionSummary s = judged(all).summary();
  EXPECT_EQ(s.lost, 0U);
  EXPECT_EQ(s.delay.max, 410ms);
  EXPECT_EQ(s.longest_gap, 401ms) << "4.999 s came at 5.009, all others at 5.41";
  EXPECT_EQ(s.longest_gap_at, Time{5009ms});
  EXPECT_EQ(s.age.max, 411ms);
  EXPECT_EQ(s.age.max_at, Time{5410ms});
  // For 401 ms the age grows from 10 to 411 ms; otherwise it cycles from 10 to 11 ms.
  const double expected = ((20'000.0 - 401) * 10.5 + (411.0 * 411 - 10 * 10) / 2) / 20'000;
  EXPECT_NEAR(s.age.mean_s * 1e3, expected, 1e-9);
  // Sorted by age, the last 200 ms of 20 s are above 411 - 200 = 211 ms.
  EXPECT_NEAR(ms(s.age.p99), 211, 0.5);
  const MeasureSummary& gap = s.windows[0].of(Measure::kGap);
  EXPECT_EQ(gap.worst, 0.401);
  EXPECT_EQ(gap.worst_at, Time{5420ms});
  // The silence exceeds 50 ms from 5.059 s on. Steps that end at 5.07 to 5.40 contain it unfinished; the one to 5.42
  // and nine more contain its end. The same holds for amber between 5 and 50 ms.
  EXPECT_EQ(gap.windows[static_cast<std::size_t>(Band::kRed)], 36U + 9U);
  EXPECT_EQ(gap.windows[static_cast<std::size_t>(Band::kAmber)], 5U);
}

TEST(LinkQuality, ShowsABurstInWindowsThatMeanLossHides) {
  auto all = regular(60'001, 2ms);
  for (std::size_t i = 30'000; i < 30'050; ++i) all[i].delays = {};
  const DirectionSummary s = judged(all).summary();
  EXPECT_NEAR(s.lost_share(), 50.0 / 60'001, 1e-12) << "green by the mean: below 0.1 %";
  const MeasureSummary& short_window = s.windows[0].of(Measure::kLoss);
  EXPECT_EQ(short_window.worst, 0.5);
  EXPECT_EQ(short_window.worst_at, Time{30'050ms});
  EXPECT_EQ(s.windows[1].of(Measure::kLoss).worst, 0.05);
  EXPECT_EQ(s.windows[2].of(Measure::kLoss).worst, 0.005);
  // 10 lost in each of five steps: windows of ten steps contain 10, 20, .. 50 (six times) .. 20, 10 of 100.
  EXPECT_EQ(short_window.windows, (Counts{5991 - 14, 2, 12}));
  EXPECT_EQ(s.windows[1].of(Measure::kLoss).windows[2], 0U);
  EXPECT_EQ(s.longest_gap, 51ms);
}

TEST(LinkQuality, HasInclusiveLossLimits) {
  EXPECT_EQ(loss_band(1, 1000), Band::kGreen);
  EXPECT_EQ(loss_band(1, 999), Band::kAmber);
  EXPECT_EQ(loss_band(100, 1000), Band::kAmber);
  EXPECT_EQ(loss_band(101, 1000), Band::kRed);
  EXPECT_EQ(loss_band(0, 0), Band::kGreen);
  EXPECT_EQ(band_of(5ms, kGapLimits), Band::kGreen);
  EXPECT_EQ(band_of(5ms + 1ns, kGapLimits), Band::kAmber);
  EXPECT_EQ(band_of(50ms + 1ns, kGapLimits), Band::kRed);
}

TEST(LinkQuality, CountsOrderAndCopiesOfADatagramOnce) {
  // 2 arrives after 4; 6 twice; 7 twice, the second time after 9.
  auto all = regular(12, 1ms);
  all[2].delays = {3'500us};
  all[6].delays = {1ms, 1'500us};
  all[7].delays = {1ms, 3'500us};
  const DirectionSummary s = judged(all).summary();
  EXPECT_EQ(s.arrived, 12U);
  EXPECT_EQ(s.duplicates, 2U);
  EXPECT_EQ(s.reordered, 1U);
  EXPECT_EQ(s.reordered_by_max, 2U);
  EXPECT_NEAR(s.reordered_share(), 1.0 / 12, 1e-12);
}

TEST(SeenNumbers, ForgetsNumbersOfThePreviousRound) {
  constexpr std::uint64_t kRound = 65'536;
  SeenNumbers seen;
  for (std::uint64_t n = 0; n < kRound; ++n) ASSERT_EQ(seen.insert(n), SeenNumbers::Kind::kNewest);
  EXPECT_EQ(seen.insert(kRound + 9), SeenNumbers::Kind::kNewest);
  EXPECT_EQ(seen.insert(kRound + 3), SeenNumbers::Kind::kReordered);
  EXPECT_EQ(seen.insert(kRound + 3), SeenNumbers::Kind::kAgain);
  EXPECT_EQ(seen.insert(10), SeenNumbers::Kind::kAgain) << "the oldest remembered";
  EXPECT_EQ(seen.insert(9), SeenNumbers::Kind::kReordered) << "older numbers: unknown";
  EXPECT_EQ(seen.insert(10 * kRound), SeenNumbers::Kind::kNewest);
  for (std::uint64_t n = 9 * kRound + 1; n < 10 * kRound; n += 997)
    ASSERT_EQ(seen.insert(n), SeenNumbers::Kind::kReordered);
}

TEST(LinkQuality, TakesJitterFromTheWindow) {
  // One second with alternating 10 and 13 ms, within twenty seconds of 10 ms.
  auto all = regular(20'001, 10ms);
  for (std::size_t i = 8000; i < 9000; i += 2) all[i].delays = {13ms};
  const DirectionSummary s = judged(all).summary();
  EXPECT_EQ(s.windows[0].of(Measure::kJitter).worst, 0.003);
  EXPECT_EQ(s.windows[1].of(Measure::kJitter).worst, 0.003);
  EXPECT_EQ(s.windows[2].of(Measure::kJitter).worst, 0.003) << "500 of 10 000 are above p99's rank";
  EXPECT_EQ(s.delay.jitter(), 3ms);
  EXPECT_GT(s.windows[0].of(Measure::kJitter).windows[1], 100U);
  EXPECT_EQ(s.windows[0].of(Measure::kJitter).windows[2], 0U);
}

TEST(LinkQuality, DoesNotCountSenderPausesAgainstTheNetwork) {
  for (const Duration delay : {Duration{}, Duration{10ms}, Duration{280ms}}) {
    SCOPED_TRACE(ms(delay));
    auto all = regular(2000, delay);
    const auto more = regular(2000, delay, Time{10s});
    all.insert(all.end(), more.begin(), more.end());
    const DirectionSummary s = judged(all).summary();
    EXPECT_EQ(s.pauses, 1U);
    EXPECT_EQ(s.paused, 8001ms);
    EXPECT_EQ(s.longest_gap, 1ms);
    EXPECT_EQ(s.age.max, delay + 1ms);
    EXPECT_EQ(s.windows[0].bands[2], 0U);
    EXPECT_LT(s.windows[0].windows, 500U) << "nothing is judged while nothing happens";
  }
}

TEST(LinkQuality, CountsSilenceUpToASenderPause) {
  // The last 300 ms before a pause and the first 200 ms after it are lost.
  auto all = regular(2000, 10ms);
  const auto more = regular(2000, 10ms, Time{10s});
  all.insert(all.end(), more.begin(), more.end());
  for (std::size_t i = 1700; i < 2200; ++i) all[i].delays = {};
  const DirectionSummary s = judged(all).summary();
  EXPECT_EQ(s.lost, 500U);
  EXPECT_EQ(s.longest_gap, 1999ms - 1709ms) << "until the sender fell silent";
  EXPECT_EQ(s.longest_gap_at, Time{1709ms});
  EXPECT_EQ(s.windows[0].of(Measure::kGap).worst, 0.290);
  EXPECT_EQ(s.age.max, 1999ms - 1699ms);
}

TEST(LinkQuality, ExpectsTheFirstAfterAPauseAtTheMinimumDelay) {
  auto all = regular(2000, 10ms);
  for (std::size_t i = 1500; i < 2000; ++i) all[i].delays = {25ms};
  auto more = regular(2000, 25ms, Time{10s});
  all.insert(all.end(), more.begin(), more.end());
  EXPECT_EQ(judged(all).summary().longest_gap, 16ms) << "where the delay rises";
  all[2000].delays = {40ms};
  for (std::size_t i = 2001; i < 2015; ++i) all[i].delays = {Time{10'040ms} - all[i].at};
  EXPECT_EQ(judged(all).summary().longest_gap, 30ms) << "10 ms would have been possible, it took 40";
}

TEST(LinkQuality, DoesNotCountASlowSendersPeriodAsDelay) {
  std::vector<Sent> all;
  for (int i = 0; i < 100; ++i) all.push_back({Time{500ms * i}, {280ms}});
  const DirectionSummary s = judged(all).summary();
  EXPECT_EQ(s.pauses, 99U);
  EXPECT_EQ(s.longest_gap, Duration{});
  EXPECT_EQ(s.age.max, Duration{}) << "never older than when it came";
}

TEST(LinkQuality, CountsEverythingAsAGapWithoutArrivals) {
  auto all = regular(5001, 1ms);
  for (Sent& one : all) one.delays = {};
  const DirectionSummary s = judged(all).summary();
  EXPECT_EQ(s.longest_gap, 5s);
  EXPECT_EQ(s.windows[1].of(Measure::kLoss).worst, 1.0);
  EXPECT_EQ(s.windows[1].bands[2], s.windows[1].windows);
  EXPECT_EQ(s.age.watched, Duration{});
}

TEST(LinkQuality, IsEmptyWithoutDatagrams) {
  const DirectionSummary s = LinkQuality{}.summary();
  EXPECT_EQ(s.sent, 0U);
  EXPECT_EQ(s.windows[0].windows, 0U);
  EXPECT_EQ(s.delay.count, 0U);
  LinkQuality quality;
  quality.arrived(Time{}, Time{1ms}, 7);
  quality.lost(Time{}, 8);
  EXPECT_EQ(quality.summary().arrived + quality.summary().lost, 0U) << "nothing was sent";
}

TEST(LinkQuality, IgnoresDatagramsSentBeforeItsStart) {
  const DirectionSummary s = judged(regular(3000, 10ms), Time{2s}).summary();
  EXPECT_EQ(s.sent, 1000U);
  EXPECT_EQ(s.arrived, 1000U);
  EXPECT_EQ(s.from, Time{2s});
  EXPECT_EQ(s.longest_gap, 1ms);
}

TEST(LinkQuality, IgnoresArrivalsWithoutARecordedSend) {
  // Monitoring starts while ten datagrams are in flight.
  const auto all = regular(3000, 10ms);
  LinkQuality quality;
  for (const Told& event : story(all)) {
    if (event.kind == 1 || event.when >= Time{1s}) tell(quality, event, all);
  }
  const DirectionSummary s = quality.summary();
  EXPECT_EQ(s.sent, 2000U);
  EXPECT_EQ(s.arrived, 2000U);
  EXPECT_EQ(s.longest_gap, 1ms);
  EXPECT_EQ(s.age.max, 11ms);
}

TEST(LinkQuality, CountsBurstsBeyondItsMemoryInTheTotals) {
  // 200 000 datagrams in a millisecond exceed the memory of a window.
  LinkQuality quality;
  for (std::uint64_t i = 0; i < 200'000; ++i) quality.sent(Time{5ns * static_cast<std::int64_t>(i)}, i);
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    const Time sent{5ns * static_cast<std::int64_t>(i)};
    quality.arrived(sent, sent + 2ms, i);
  }
  for (std::uint64_t i = 0; i < 30'000; ++i) {
    const Time sent{10ms + 1ms * static_cast<std::int64_t>(i)};
    quality.sent(sent, 200'000 + i);
    quality.arrived(sent, sent + 3ms, 200'000 + i);
  }
  const DirectionSummary s = quality.summary();
  EXPECT_EQ(s.arrived, 230'000U);
  EXPECT_EQ(s.delay.p50, 2ms);
  EXPECT_EQ(s.windows[2].of(Measure::kJitter).windows[2], 0U);
  EXPECT_EQ(s.windows[0].of(Measure::kJitter).worst, 0) << "90 of the slow ones beside 32 768 others";
  EXPECT_EQ(s.windows[2].of(Measure::kJitter).worst, 0.001);
}

TEST(LinkQuality, IsUnchangedByAnIntermediateSummary) {
  auto all = regular(15'000, 4ms);
  for (std::size_t i = 0; i < all.size(); i += 37) all[i].delays = {};
  LinkQuality once, asked;
  std::size_t n = 0;
  for (const Told& event : story(all)) {
    tell(once, event, all);
    tell(asked, event, all);
    if (++n % 4001 == 0) static_cast<void>(asked.summary());
  }
  const DirectionSummary a = once.summary(), b = asked.summary();
  EXPECT_EQ(a.windows[1].bands, b.windows[1].bands);
  EXPECT_EQ(a.age.p99, b.age.p99);
  EXPECT_EQ(a.longest_gap, b.longest_gap);
}

TEST(LinkQuality, SkipsWeeksOfSilence) {
  LinkQuality quality;
  std::uint64_t index = 0;
  for (int session = 0; session < 5; ++session) {
    const Time begin{std::chrono::hours(24 * 7 * session)};
    for (int i = 0; i <= 2000; ++i, ++index) {
      const Time at = begin + 1ms * i;
      quality.sent(at, index);
      quality.arrived(at, at + 500us, index);
    }
  }
  const DirectionSummary s = quality.summary();
  EXPECT_EQ(s.pauses, 4U);
  EXPECT_EQ(s.windows[1].bands[1] + s.windows[1].bands[2], 0U);
  // A window counts from the step of its first datagram (0 to 200) until the last one has left it (99 steps later). The
  // first windows are not full, and the last session ends before step 200.
  EXPECT_EQ(s.windows[1].windows, (300U - 99) + 3 * 300U + 200U);
}

TEST(LinkQuality, RunsWithoutHeapOnceConstructed) {
  LinkQuality quality;
  const tandem::test::AllocGuard guard;
  for (std::uint64_t i = 0; i < 50'000; ++i) {
    const Time at{1ms * static_cast<std::int64_t>(i)};
    quality.sent(at, i);
    if (i % 100 == 99) quality.lost(at, i);
    if (i % 100 != 99) quality.arrived(at, at + 1us * static_cast<std::int64_t>(i % 977), i);
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::netsim
