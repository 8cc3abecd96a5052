#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "common/base/rng.h"
#include "common/control/authority.h"
#include "common/control/energy_ledger.h"
#include "common/control/force_gate.h"

/// Books, shares and clocks at their extremes. tests/EXTREMES.md lists what was tried.
namespace tandem::control {
namespace {

using namespace std::chrono_literals;

constexpr double kInf = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();

// 1e9 ticks are 11.6 days at 1 kHz. A ledger that does the same in every tick equals one that does it once times the
// number of ticks, because it counts whole nanojoules. A million ticks prove that; a thousand such millions follow.
TEST(ExtremesOfBooks, StayExactOver1e9Ticks) {
  constexpr std::uint64_t kMillion = 1'000'000, kThousand = 1'000;
  RandomStream random{7};
  std::uint64_t in = 0, heat = 0, out = 0;  // one million ticks, by the test's own integers [nJ]
  EnergyLedger slow(0.05, 1);
  for (std::uint64_t i = 0; i < kMillion; ++i) {
    const auto absorbed = random.below(5000), warm = 4000 + random.below(1000), spent = random.below(4000);
    // a quarter of a nanojoule more is rounded away from a credit, and a quarter less added to a debit
    slow.absorb((static_cast<double>(absorbed) + 0.25) * 1e-9);
    slow.dissipate((static_cast<double>(warm) + 0.25) * 1e-9);
    ASSERT_TRUE(slow.spend(std::max(0.0, static_cast<double>(spent) - 0.25) * 1e-9));
    in += absorbed;
    heat += warm;
    out += spent;
  }
  EXPECT_EQ(slow.in_nj(), in);
  EXPECT_EQ(slow.out_nj(), out);
  EXPECT_EQ(slow.margin_nj(), 50'000'000 + heat - out);
  EnergyLedger fast(0.05, 1);
  for (std::uint64_t i = 0; i < kThousand; ++i) {
    const auto joule = [](std::uint64_t nj) { return (static_cast<double>(nj) + 0.25) * 1e-9; };
    fast.absorb(joule(in));
    fast.dissipate(joule(heat));
    ASSERT_TRUE(fast.spend((static_cast<double>(out) - 0.25) * 1e-9));
    ASSERT_TRUE(fast.holds());
  }
  EXPECT_EQ(fast.in_nj(), kThousand * in);
  EXPECT_EQ(fast.out_nj(), kThousand * out);
  EXPECT_EQ(fast.margin_nj(), 50'000'000 + kThousand * (heat - out));
}

// 584 years of 1 W fill a counter. Next to its end it saturates, and the account refuses instead of beginning again.
TEST(ExtremesOfBooks, RefuseAtTheEndOfTheirCounters) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  for (const std::uint64_t left : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{999}}) {
    EnergyLedger ledger(0, 1);
    ledger.receive(kMax - left);
    std::uint64_t before = 0;
    for (int i = 0; i < 40; ++i) {
      static_cast<void>(ledger.spend(9e8));
      ledger.absorb(9e8);
      EXPECT_TRUE(ledger.holds());
      EXPECT_GE(ledger.in_nj(), before);
      before = ledger.in_nj();
    }
    EXPECT_FALSE(ledger.spend(9e8));
  }
}

TEST(ExtremesOfShares, SumToOneOrAreRefused) {
  struct Case {
    double a, b;
    bool accepted;
  };
  for (const Case& c : {Case{0, 1, true}, Case{1, 0, true}, Case{1e-12, 1 - 1e-12, true}, Case{1 - 1e-12, 1e-12, true},
                        Case{5e-324, 1, true}, Case{-0.0, 1, true}, Case{0.5, 0.5 + 1e-7, true}, Case{kNaN, 1, false},
                        Case{kInf, 0, false}, Case{-kInf, 1, false}, Case{-1e-12, 1, false}, Case{0.5, 0.6, false},
                        Case{1e300, -1e300, false}}) {
    SCOPED_TRACE(testing::PrintToString(c.a) + ", " + testing::PrintToString(c.b));
    ToolAuthority row(2, 1, 0.05);
    ASSERT_TRUE(row.request({0.5, 0.5}));
    EXPECT_EQ(row.request({c.a, c.b}), c.accepted);
    ToolAuthority::Input in;
    in.present[0] = in.present[1] = true;
    for (int i = 0; i < 3000; ++i) {
      row.step(in);
      ASSERT_NEAR(row.alpha(0) + row.alpha(1), 1, 1e-12);
      ASSERT_GE(std::min(row.alpha(0), row.alpha(1)), 0);
    }
    EXPECT_NEAR(row.alpha(0), c.accepted ? std::abs(c.a) : 0.5, 1e-6);
  }
}

// The clock of a client steps while a force acts. The gate keeps the motor's limit and its slew, and releases within
// the usual time after the last datagram, by ticks of the stepped clock.
TEST(ExtremesOfClocks, StepsKeepTheForceLimitedAndEndWithTheLink) {
  const auto years = std::chrono::hours(24 * 365 * 100);
  for (const Duration step : {Duration(-years), Duration(-1h), Duration(-1ms), Duration(0), Duration(1ms),
                              Duration(19ms), Duration(1h), Duration(years)}) {
    SCOPED_TRACE(step.count());
    ForceGate gate({.dof = 1, .latch = false});
    Time now = Time{} + years * 3 / 2;  // the largest step still fits
    double before = 0;
    const auto tick = [&](bool fresh) {
      now += 1ms;
      AxisArray wanted{5};
      const auto out = gate.step({.now = now, .fresh = fresh, .engage = true, .wanted = wanted});
      EXPECT_TRUE(std::isfinite(out.effort[0]));
      EXPECT_LE(std::abs(out.effort[0]), 3.3 * (1 + 1e-12));
      EXPECT_LE(out.effort[0] - before, 1 + 1e-9) << "1 N per tick upwards";
      before = out.effort[0];
    };
    for (int i = 0; i < 800; ++i) tick(true);
    EXPECT_NEAR(before, 3.3, 1e-9);
    now += step;
    for (int i = 0; i < 30; ++i) tick(true);
    if (step >= Duration(0)) {
      for (int i = 0; i < 130; ++i) tick(false);
      EXPECT_EQ(before, 0) << "silence ends the force";
    }
  }
}

}  // namespace
}  // namespace tandem::control
