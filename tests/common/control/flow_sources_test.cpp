#include "common/control/flow_sources.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::control {
namespace {

TEST(FlowSources, GiveEverythingWhenOpen) {
  FlowSources sources(FlowSourceMode::kOpen, 0.05);
  EXPECT_EQ(sources.grant(3), 3);
  EXPECT_EQ(sources.grant(0.5), 0.5);
  EXPECT_EQ(sources.granted(), 3.5);
  sources.observe(0, 1e6, 1);
  EXPECT_EQ(sources.gate(0), 1);
  EXPECT_FALSE(sources.gates_velocity());
}

TEST(FlowSources, NeverGrantMoreFromTheTankThanWasPutIn) {
  const std::uint64_t last = test::seeds(50);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    FlowSources sources(FlowSourceMode::kTank, 0.05);
    double put_in = 0.05;
    for (int i = 0; i < 1000; ++i) {
      const double joule = random.uniform(0, 0.02);
      if (random.below(2) == 0) {
        sources.fill(joule);
        put_in += joule;
      } else {
        const double given = sources.grant(joule);
        ASSERT_GE(given, 0);
        ASSERT_LE(given, joule);
      }
      ASSERT_LE(sources.granted(), put_in + 1e-12);
      ASSERT_LE(sources.tank(), 0.2 + 1e-15);  // four times its initial level
      ASSERT_GE(sources.tank(), 0);
    }
    sources.fill(-5);
    EXPECT_GE(sources.tank(), 0);
  }
}

TEST(FlowSources, GrantTheFollowerNothingWhenTheTankIsEmpty) {
  FlowSources sources(FlowSourceMode::kTank, 0.05);
  EXPECT_EQ(sources.grant(0.04), 0.04);
  EXPECT_NEAR(sources.grant(0.04), 0.01, 1e-15);
  EXPECT_EQ(sources.grant(0.04), 0);
  EXPECT_EQ(sources.gate(0), 1);  // in this mode the grants are limited, not the velocity gate
}

/// Eq. 3 literally, n = 2: E_p = integral of [(alpha - 1) T_r1 - alpha T_r2] v_rs. Eq. 4: open while E_p <= 0.
TEST(FlowSources, GateAsInEquations3And4) {
  RandomStream random{9};
  FlowSources sources(FlowSourceMode::kSeed, 0.05), other(FlowSourceMode::kSeedSigned, 0.05);
  double E_p = 0;
  int open = 0;
  for (int i = 0; i < 5000; ++i) {
    const double alpha = random.uniform(), T_r1 = random.uniform(-1, 1), T_r2 = random.uniform(-1, 1),
                 v = random.uniform(-1, 1);
    E_p += ((alpha - 1) * T_r1 - alpha * T_r2) * v * 0.001;
    const double injected = (1 - alpha) * T_r1 * v + alpha * T_r2 * v;  // sum (C - alpha_i) F_ri v, C = 1
    sources.observe(2, injected, 0.001);
    other.observe(2, injected, 0.001);
    ASSERT_NEAR(sources.energy_p(2), E_p, 1e-12);
    if (std::abs(E_p) < 1e-9) continue;
    ASSERT_EQ(sources.gate(2), E_p <= 0 ? 1 : 0);
    // The sign that makes the rule passive: the gate is closed once the sources have injected energy.
    ASSERT_EQ(other.gate(2), E_p <= 0 ? 0 : 1);
    open += E_p <= 0 ? 1 : 0;
  }
  EXPECT_GT(open, 0);
  EXPECT_LT(open, 5000);
  EXPECT_EQ(sources.gate(0), 1);  // each axis has its own gate
  EXPECT_TRUE(sources.gates_velocity());
  EXPECT_TRUE(other.gates_velocity());
}

TEST(FlowSources, CutOnlyTheSignedReadingWhenTheyHaveInjected) {
  FlowSources printed(FlowSourceMode::kSeed, 0), with_sign(FlowSourceMode::kSeedSigned, 0);
  EXPECT_EQ(printed.gate(0), 1);
  EXPECT_EQ(with_sign.gate(0), 1);
  for (FlowSources* s : {&printed, &with_sign}) s->observe(0, 1, 0.001);  // 1 mJ went into the followers
  EXPECT_EQ(printed.gate(0), 1);
  EXPECT_EQ(with_sign.gate(0), 0);
  for (FlowSources* s : {&printed, &with_sign}) s->observe(0, -2, 0.001);  // 1 mJ net returned
  EXPECT_EQ(printed.gate(0), 0);
  EXPECT_EQ(with_sign.gate(0), 1);
}

}  // namespace
}  // namespace tandem::control
