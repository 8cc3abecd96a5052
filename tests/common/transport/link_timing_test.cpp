#include "common/transport/link_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

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

/// Both directions between this end and a peer that echoes truly. This end sends every millisecond and reads what has
/// arrived since. `own` and `other` are drawn delays of the two directions.
/// @param lateness  by how much the peer sends its datagram of a tick after that tick's time
/// @return the largest error of `peer_sent`, and of the age beyond the true one with half of both waits, from 1 s on
/// [s]
double worst_age_error(const std::function<Duration()>& own, const std::function<Duration()>& other,
                       const std::function<Duration(int tick)>& lateness) {
  constexpr Duration kSkew = 1234567ms;  // the peer's clock started at another time
  LinkTiming f(1ms);
  std::vector<Time> at_peer, sent_by_peer, back;  // by counter; a direction keeps the order
  double worst = 0;
  int heard = 0;
  Time sent_in_use{};
  Duration shared{};
  for (int ms = 0; ms < 4000; ++ms) {
    const Time now = at(ms * 1ms);
    f.sent(now, static_cast<std::uint64_t>(ms));
    at_peer.push_back(std::max(now + other(), at_peer.empty() ? now : at_peer.back()));
    sent_by_peer.push_back(now + lateness(ms));
    back.push_back(std::max(sent_by_peer.back() + own(), back.empty() ? now : back.back()));
    for (; heard < ms && back[static_cast<std::size_t>(heard)] <= now; ++heard) {
      const auto k = static_cast<std::size_t>(heard);
      const auto echo = std::upper_bound(at_peer.begin(), at_peer.end(), sent_by_peer[k]) - at_peer.begin();
      if (echo == 0) continue;
      const Duration held = sent_by_peer[k] - at_peer[static_cast<std::size_t>(echo - 1)];
      f.accepted(back[k], static_cast<std::uint64_t>(echo - 1), held,
                 static_cast<std::uint32_t>((at(heard * 1ms) - Time{1h} + kSkew) / 1ms));
      sent_in_use = sent_by_peer[k],
      shared = (std::min(held, Duration{1ms}) - std::min(now - back[k], Duration{1ms})) / 2;
    }
    f.tick(now);
    if (ms <= 1000) continue;
    worst = std::max({worst, std::abs(seconds(f.peer_sent() - sent_in_use)),
                      std::abs(seconds(f.age(now) - (now - sent_in_use + shared)))});
  }
  EXPECT_GT(heard, 3900);
  return worst;
}

TEST(LinkTiming, EstimatesTheOneWayAgeThroughJitter) {
  RandomStream random{4};
  const auto delay = [&] { return 20ms + from_seconds(random.uniform(0, 0.010)); };
  EXPECT_LE(worst_age_error(delay, delay, [](int) { return 0ms; }), 0.0025);
}

/// A peer that shifts its ticks looks like one whose datagrams are delayed, if only arrivals are compared.
TEST(LinkTiming, EstimatesTheOneWayAgeWhileThePeerShiftsItsTicks) {
  const auto five = [] { return 5ms; };
  for (const Duration step : {10us, -10us}) {
    const auto shift = [step](int ms) { return 500us + std::clamp(ms - 1500, 0, 40) * step; };
    EXPECT_LE(worst_age_error(five, five, shift), 1e-6) << step / 1us << " us per tick";
  }
}

TEST(LinkTiming, ReportsADelayOfItsOwnDirectionWhole) {
  int sent = 0;
  const auto longer = [&] { return ++sent > 2000 ? 13ms : 5ms; };
  EXPECT_LE(worst_age_error(longer, [] { return 5ms; }, [](int) { return 0ms; }), 1e-6);
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
