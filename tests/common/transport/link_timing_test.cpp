#include "common/transport/link_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/rng.h"
#include "tests/support/alloc_guard.h"

namespace tandem::transport {
namespace {

using namespace std::chrono_literals;

constexpr Time at(Duration d) { return Time{1h + d}; }

TEST(LinkTiming, ReportsNothingBeforeTheFirstDatagram) {
  const LinkTiming f(1ms);
  EXPECT_FALSE(f.heard());
  EXPECT_GE(f.loop_age(at(0s)), 1h);
  EXPECT_GE(f.age(at(0s)), 1h);
  EXPECT_GE(f.silence(at(0s)), 1h);
  EXPECT_GE(f.unanswered_for(at(0s)), 1h);
}

TEST(LinkTiming, CountsTimeWithoutANewEcho) {
  LinkTiming f(1ms);
  f.accepted(at(0ms), 0, 0ms, 0);  // the peer sent first
  EXPECT_EQ(f.unanswered_for(at(40ms)), 40ms) << "nothing was ever echoed";
  f.sent(at(50ms), 7);
  f.sent(at(51ms), 8);
  f.accepted(at(80ms), 7, 0ms, 80);
  EXPECT_EQ(f.unanswered_for(at(90ms)), 10ms) << "a long way is no silence";
  f.accepted(at(100ms), 7, 20ms, 100);
  EXPECT_EQ(f.unanswered_for(at(100ms)), 20ms) << "the same again is no news";
  f.accepted(at(110ms), 8, 0ms, 110);
  EXPECT_EQ(f.unanswered_for(at(110ms)), 0ms);
  f.accepted(at(120ms), 9, 0ms, 120);
  EXPECT_EQ(f.unanswered_for(at(120ms)), 10ms) << "that was never sent";
}

TEST(LinkTiming, SubtractsThePeersHoldingTimeFromTheRoundTrip) {
  LinkTiming f(1ms);
  f.sent(at(0ms), 7);
  f.accepted(at(30ms), 7, 4ms, 0);
  EXPECT_EQ(f.rtt(), 26ms);
  EXPECT_EQ(f.loop_age(at(30ms)), 30ms);  // the holding time is not subtracted from the age of the loop
  EXPECT_EQ(f.loop_age(at(35ms)), 35ms);
  EXPECT_EQ(f.silence(at(35ms)), 5ms);
  f.sent(at(40ms), 8);
  f.accepted(at(50ms), 8, 5s, 0);  // a peer that reports a false holding time
  EXPECT_EQ(f.rtt(), 0ms);
}

TEST(LinkTiming, IgnoresEchoesOfCountersNeverSent) {
  LinkTiming f(1ms);
  for (const std::uint64_t never : {std::uint64_t{5}, ~std::uint64_t{0}, std::uint64_t{4096}, std::uint64_t{0}}) {
    f.accepted(at(1ms), never, 0ms, 0);
    EXPECT_EQ(f.rtt_samples(), 0U) << never;
    EXPECT_GE(f.loop_age(at(1ms)), 1h);
  }
  f.sent(at(2ms), 3);
  f.accepted(at(4ms), 4, 0ms, 0);  // counter 4 is not sent yet
  EXPECT_EQ(f.rtt_samples(), 0U);
  EXPECT_TRUE(f.heard());
}

TEST(LinkTiming, KeepsTheAgeAfterAnOlderEcho) {
  LinkTiming f(1ms);
  f.sent(at(0ms), 0);
  f.sent(at(10ms), 1);
  f.accepted(at(20ms), 1, 0ms, 0);
  f.accepted(at(21ms), 0, 0ms, 1);
  EXPECT_EQ(f.loop_age(at(21ms)), 11ms);
  EXPECT_EQ(f.rtt(), 10ms);
}

// The memory is a time, not a number of datagrams: the age of a loop is the same at 10 kHz and at 100 Hz.
TEST(LinkTiming, KeepsFourSecondsOfHistoryAtEveryRate) {
  for (const Duration tick :
       {Duration{10ms}, Duration{4ms}, Duration{2ms}, Duration{1ms}, Duration{250us}, Duration{100us}}) {
    SCOPED_TRACE(tick.count());
    LinkTiming f(tick);
    std::uint64_t c = 0;
    for (Duration t = 0ms; t < 6s; t += tick) f.sent(at(t), c++);
    const auto sent_at = [&](Duration t) { return static_cast<std::uint64_t>(t / tick); };
    f.accepted(at(6s), sent_at(2s) - 1, 0ms, 0);  // one tick too old
    EXPECT_EQ(f.rtt_samples(), 0U);
    f.accepted(at(6s), sent_at(2s), 0ms, 0);
    EXPECT_EQ(f.rtt_samples(), 1U);
    EXPECT_EQ(f.loop_age(at(6s)), 4s);
  }
}

TEST(LinkTiming, TakesNoTimeOfBeforeAPauseForANewOne) {
  constexpr Duration kRepeats{std::int64_t{1} << 40};  // of the stored times
  LinkTiming f(1ms);
  f.sent(at(0ms), 0);
  f.accepted(at(kRepeats + 1s), 0, 0ms, 0);
  EXPECT_EQ(f.rtt_samples(), 0U) << "nothing was sent for 18 min";
  f.sent(at(kRepeats + 2s), 1);
  f.accepted(at(kRepeats + 3s), 0, 0ms, 1);
  EXPECT_EQ(f.rtt_samples(), 0U) << "an echo of before the pause";
  f.accepted(at(kRepeats + 3s), 1, 0ms, 2);
  EXPECT_EQ(f.rtt(), 1s);
}

TEST(BriefTime, IsTheStoredTimeWithinNineMinutes) {
  static_assert(sizeof(BriefTime) == 5);
  for (const Duration since :
       {Duration{0}, Duration{1ns}, Duration{4s}, Duration{9min}, Duration{-1ns}, Duration{-9min}})
    for (const Duration now : {Duration{0}, Duration{1h}, Duration{(std::int64_t{1} << 40) - 1}, Duration{100 * 24h}})
      EXPECT_EQ(BriefTime{Time{now - since}}.near(Time{now}), Time{now - since}) << since.count() << " " << now.count();
}

TEST(LinkTiming, AllocatesBoundedMemoryOnce) {
  for (const Duration tick : {Duration{1ns}, Duration{100us}, Duration{1h}}) {
    const test::AllocGuard made;
    LinkTiming f(tick);
    EXPECT_LE(made.count(), 1U);
    const test::AllocGuard guard;
    for (std::uint64_t c = 0; c < 100'000; ++c) {
      f.sent(at(c * 100us), c);
      f.accepted(at(c * 100us + 50us), c, 0ms, 0);
    }
    EXPECT_EQ(guard.count(), 0U);
    EXPECT_EQ(f.rtt_samples(), 100'000U);
  }
}

TEST(LinkTiming, DetectsOldDatagramsReleasedInOrder) {
  LinkTiming f(1ms);
  std::uint64_t c = 0;
  for (int ms = 0; ms < 2000; ++ms) {
    f.sent(at(ms * 1ms), c);
    f.accepted(at(ms * 1ms + 2ms), c, 1ms, static_cast<std::uint32_t>(ms));
    ++c;
  }
  EXPECT_EQ(f.loop_age(at(2001ms)), 2ms);
  // 1 s of silence, then all datagrams at once: fresh, in order, old.
  for (int ms = 2000; ms < 3000; ++ms) f.sent(at(ms * 1ms), static_cast<std::uint64_t>(ms));
  for (int ms = 2000; ms < 2100; ++ms)
    f.accepted(at(3s), static_cast<std::uint64_t>(ms), 1ms, static_cast<std::uint32_t>(ms));
  EXPECT_EQ(f.silence(at(3s)), 0ms);
  EXPECT_EQ(f.loop_age(at(3s)), 3000ms - 2099ms);
  EXPECT_NEAR(seconds(f.age(at(3s))), 0.899, 0.002);  // the one-way age shows the delay too
}

TEST(LinkTiming, EstimatesTheOneWayAgeThroughJitter) {
  RandomStream random{4};
  LinkTiming f(1ms);
  constexpr Duration kFloor = 20ms, kSkew = 1234567ms;  // the peer's clock started at another time
  Time last_arrival{};
  double worst = 0;
  for (int ms = 0; ms < 4000; ++ms) {
    const Time now = at(ms * 1ms);
    f.sent(now, static_cast<std::uint64_t>(ms));
    if (ms < 100) continue;
    const Duration transit = kFloor + from_seconds(random.uniform(0, 0.010));
    const Time made = now - transit;  // the peer sent the arriving datagram then
    const auto peer_tick = static_cast<std::uint32_t>((made - Time{1h} + kSkew) / 1ms);
    f.accepted(now, static_cast<std::uint64_t>(ms - 40), 0ms, peer_tick);
    last_arrival = now;
    if (ms > 1000) worst = std::max(worst, std::abs(seconds(f.age(now) - transit)));
  }
  EXPECT_LE(worst, 0.0025);
  EXPECT_EQ(f.age(last_arrival + 7ms) - f.age(last_arrival), 7ms);
}

TEST(LinkTiming, LearnsTheExpectedRoundTrip) {
  LinkTiming f(1ms);
  for (int i = 0; i < 3000; ++i) {
    f.sent(at(i * 1ms), static_cast<std::uint64_t>(i));
    f.accepted(at(i * 1ms + (i % 20 == 0 ? 30ms : 10ms)), static_cast<std::uint64_t>(i), 0ms,
               static_cast<std::uint32_t>(i));
  }
  EXPECT_NEAR(seconds(f.rtt_p50()), 0.010, 0.0005);
  EXPECT_NEAR(seconds(f.rtt_p99()), 0.030, 0.0015);
}

TEST(LinkTiming, ExpectsTheP99OfTheLastThousandRoundTrips) {
  LinkTiming f(1ms);
  std::uint64_t c = 0;
  const auto trips = [&](int count, Duration rtt) {
    for (int i = 0; i < count; ++i, ++c) {
      f.sent(at(c * 1ms), c);
      f.accepted(at(c * 1ms + rtt), c, 0ms, static_cast<std::uint32_t>(c));
    }
  };
  EXPECT_EQ(f.rtt_p99(), 0ms);
  trips(98, 10ms);
  EXPECT_NEAR(seconds(f.rtt_p99()), 0.010, 0.0004);
  trips(2, 30ms);  // 2 of 100
  EXPECT_NEAR(seconds(f.rtt_p99()), 0.030, 0.001);
  trips(900, 10ms);  // 2 of 1000
  EXPECT_NEAR(seconds(f.rtt_p99()), 0.010, 0.0004);
  trips(999, 50ms);  // fewer than 1000
  EXPECT_NEAR(seconds(f.rtt_p99()), 0.010, 0.0004);
  trips(1, 50ms);
  EXPECT_NEAR(seconds(f.rtt_p99()), 0.050, 0.0016);
}

TEST(WindowedMinimum, ForgetsAMinimumThatLeftTheWindow) {
  WindowedMinimum m;
  EXPECT_FALSE(m.any());
  m.add(at(0s), 5);
  for (int s = 1; s <= 4; ++s) m.add(at(s * 1s), 50);
  EXPECT_EQ(m.value(), 5);
  for (int s = 5; s <= 20; ++s) m.add(at(s * 1s), 50);
  EXPECT_EQ(m.value(), 50);
  m.add(at(21s), 7);
  EXPECT_EQ(m.value(), 7);
}

}  // namespace
}  // namespace tandem::transport
