// When samples are sent, against numbers computed by hand, and what the receiver predicts in between.
#include "common/control/send_pace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::control {
namespace {

/// One axis, weber 10 %, spring 400 N/m: at rest the tolerances are 10 mm/s and 0.06 N / 400 N/m = 0.15 mm.
SendPace::Params one_axis(std::uint32_t order = 1) {
  return {.dof = 1, .heartbeat = 16, .order = order, .velocity_floor = 0.1, .force_floor = 0.6, .energy = 1000};
}
PortSample at(double x, double v = 0, double f = 0, std::uint64_t e_in = 0) {
  PortSample sample;
  sample.x[0] = x;
  sample.v[0] = v;
  sample.f[0] = f;
  sample.e_in[0] = e_in;
  return sample;
}
/// A pace whose last datagram, at tick 100, held `sample`.
SendPace after(const PortSample& sample, SendPace::Params params = one_axis()) {
  SendPace pace(params, 1);
  pace.record(0, sample);
  pace.sent(100);
  return pace;
}

TEST(SendPace, SendsTheFirstSampleAndThenAHeartbeat) {
  SendPace pace(one_axis(), 1);
  EXPECT_TRUE(pace.allowed(7));
  EXPECT_TRUE(pace.overdue(7));
  pace.sent(7);
  EXPECT_FALSE(pace.overdue(22));
  EXPECT_TRUE(pace.overdue(23));
  pace.restart();
  EXPECT_TRUE(pace.overdue(8)) << "a new connection knows nothing";
}

TEST(SendPace, CountsTicksAcrossTheirWrap) {
  SendPace pace(one_axis(), 1);
  pace.sent(0xfffffff8U);
  EXPECT_FALSE(pace.overdue(7));
  EXPECT_TRUE(pace.overdue(8));
}

TEST(SendPace, ComparesPositionsByTheForceOfTheirError) {
  const SendPace pace = after(at(0));
  EXPECT_FALSE(pace.noticeable(101, 0, at(0.00014), 0));
  EXPECT_TRUE(pace.noticeable(101, 0, at(0.00016), 0));
  EXPECT_FALSE(pace.noticeable(101, 0, at(0.00049), 2)) << "10 % of 2 N at 400 N/m: 0.5 mm";
  EXPECT_TRUE(pace.noticeable(101, 0, at(0.00051), 2));
}

TEST(SendPace, ComparesVelocitiesByAShareOfThePresentOne) {
  SendPace::Params p = one_axis();
  p.stiffness = 1e-6;  // positions do not count
  const SendPace slow = after(at(0), p), fast = after(at(0, 0.5), p);
  EXPECT_FALSE(slow.noticeable(101, 0, at(0, 0.0099), 0));
  EXPECT_TRUE(slow.noticeable(101, 0, at(0, 0.0101), 0));
  EXPECT_FALSE(fast.noticeable(101, 0, at(0, 0.55), 0)) << "0.05 of 0.55 m/s";
  EXPECT_TRUE(fast.noticeable(101, 0, at(0, 0.56), 0)) << "0.06 of 0.56 m/s";
}

TEST(SendPace, ComparesForcesWhereALawUsesThem) {
  SendPace::Params p = one_axis();
  EXPECT_FALSE(after(at(0), p).noticeable(101, 0, at(0, 0, 0.059), 0));
  EXPECT_TRUE(after(at(0), p).noticeable(101, 0, at(0, 0, 0.061), 0));
  EXPECT_FALSE(after(at(0, 0, 2), p).noticeable(101, 0, at(0, 0, 2.2), 0));
  EXPECT_TRUE(after(at(0, 0, 2), p).noticeable(101, 0, at(0, 0, 2.3), 0));
  p.force_acts = false;
  EXPECT_FALSE(after(at(0), p).noticeable(101, 0, at(0, 0, 3), 0));
}

TEST(SendPace, NeverKeepsMoreEnergyFromTheReceiverThanItsLimit) {
  const SendPace pace = after(at(0, 0, 0, 500));
  EXPECT_FALSE(pace.noticeable(101, 0, at(0, 0, 0, 1500), 0));
  EXPECT_TRUE(pace.noticeable(101, 0, at(0, 0, 0, 1501), 0));
  EXPECT_TRUE(pace.noticeable(101, 0, at(0, 0, 0, 0), 0)) << "an account that began again";
}

TEST(SendPace, IgnoresTargetsThatActOnNothingButNotTheirEnergy) {
  const SendPace pace = after(at(0));
  EXPECT_FALSE(pace.noticeable(101, 0, at(0.01, 1), 0, false));
  EXPECT_TRUE(pace.noticeable(101, 0, at(0.01, 1, 0, 1001), 0, false));
}

TEST(SendPace, ComparesWithThePredictionOfItsOrder) {
  // 0.1 m/s for 10 ticks: 1 mm.
  EXPECT_FALSE(after(at(0, 0.1)).noticeable(110, 0, at(0.001, 0.1), 0));
  EXPECT_TRUE(after(at(0, 0.1)).noticeable(110, 0, at(0, 0.1), 0));
  EXPECT_TRUE(after(at(0, 0.1), one_axis(0)).noticeable(110, 0, at(0.001, 0.1), 0));
  EXPECT_FALSE(after(at(0, 0.1), one_axis(0)).noticeable(110, 0, at(0, 0.1), 0));
}

TEST(SendPace, SendsValuesThatAreNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(after(at(0)).noticeable(101, 0, at(bad), 0));
    EXPECT_TRUE(after(at(0)).noticeable(101, 0, at(0, bad), 0));
    EXPECT_TRUE(after(at(bad)).noticeable(101, 0, at(0), 0)) << "the receiver holds it still";
  }
}

TEST(SendPace, AllowsNoMoreThanItsRate) {
  SendPace::Params p = one_axis();
  p.interval = 5;
  p.heartbeat = 2;  // raised to the interval
  SendPace pace(p, 1);
  pace.sent(0);
  EXPECT_FALSE(pace.allowed(4));
  EXPECT_TRUE(pace.allowed(5));
  EXPECT_FALSE(pace.overdue(4));
  EXPECT_TRUE(pace.overdue(5));
}

TEST(HeldSample, IsAdvancedByItsVelocityUntilTheHeartbeatIsLate) {
  HeldSample held(0.016, 1);
  PortSample sample = at(0.01, 0.1);
  double silence = 0;
  for (int tick = 1; tick <= 40; ++tick) {
    silence += 0.001;
    held.predict(sample, 1, held.advance(silence));
    EXPECT_NEAR(held.held(), std::min(silence, 0.016), 1e-12);
    EXPECT_NEAR(sample.x[0], 0.01 + 0.1 * std::min(silence, 0.016), 1e-12);
  }
  held.restart();
  EXPECT_EQ(held.held(), 0);
  EXPECT_EQ(held.advance(24 * 3600), 0.016) << "silence before the first datagram";
  EXPECT_EQ(held.advance(0.001), 0) << "a clock that steps back takes no motion back";
}

TEST(HeldSample, StaysWhereItIsWithOrderZeroAndWithoutSend) {
  PortSample sample = at(0.01, 0.1);
  HeldSample held(0.016, 0), off;
  EXPECT_FALSE(off.on());
  held.predict(sample, 1, held.advance(0.01));
  EXPECT_EQ(sample.x[0], 0.01);
  EXPECT_EQ(held.held(), 0.01);
  EXPECT_EQ(off.advance(0.01), 0);
}

// Sender and receiver together, over random motions: between two datagrams the receiver is never farther off than the
// dead-band.
TEST(HeldSample, KeepsTheReceiverWithinTheDeadBand) {
  const std::uint64_t last = test::seeds(50);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const auto order = static_cast<std::uint32_t>(random.below(2));
    SendPace pace(one_axis(order), 1);
    HeldSample held(0.016, order);
    const double amplitude = random.uniform(0.001, 0.03), turn = 2 * 3.14159 * random.uniform(0.1, 1);
    PortSample received;
    double silence = 0;
    int sent = 0;
    for (std::uint32_t tick = 0; tick < 2000; ++tick) {
      const double t = 0.001 * tick;
      const PortSample now = at(amplitude * std::sin(turn * t), amplitude * turn * std::cos(turn * t));
      silence += 0.001;
      if (pace.overdue(tick) || pace.noticeable(tick, 0, now, 0)) {
        pace.record(0, now);
        pace.sent(tick);
        received = now;
        held.restart();
        silence = 0;
        ++sent;
      } else {
        held.predict(received, 1, held.advance(silence));
      }
      ASSERT_LE(std::abs(received.x[0] - now.x[0]), 0.00015 + 1e-9);
      ASSERT_LE(std::abs(received.v[0] - now.v[0]), 0.1 * std::max(0.1, std::abs(now.v[0])) + 1e-9);
    }
    EXPECT_GE(sent, 2000 / 16);
    EXPECT_LT(sent, order == 1 ? 1000 : 2000) << "the velocity predicts at least half of the samples of a hand";
  }
}

// A hostile client states the fastest velocity at the limit of its reach. The prediction of the receiver stays in
// range.
TEST(HeldSample, StaysInTheRangeOfPositionsOnTheWire) {
  for (const double side : {1.0, -1.0}) {
    HeldSample held(0.016, 1);
    PortSample sample;
    sample.x[0] = side * 9.9;
    sample.v[0] = side * 100;
    for (int tick = 1; tick <= 20; ++tick) held.predict(sample, 1, held.advance(0.001 * tick));
    EXPECT_EQ(sample.x[0], side * 10);
  }
}

}  // namespace
}  // namespace tandem::control
