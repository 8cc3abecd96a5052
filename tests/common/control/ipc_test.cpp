#include "common/control/ipc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::control {
namespace {

/// Draws from twelve decades, uniform in the exponent.
double any_gain(RandomStream& random) { return std::pow(10.0, random.uniform(-6, 6)); }

TEST(MasterIpc, NeverCreatesEnergyForAnyGains) {
  const std::uint64_t last = test::seeds(2000);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const MasterIpc::Gains g{any_gain(random), any_gain(random), any_gain(random)};
    const double T = std::pow(10.0, random.uniform(-5, -1)), b_added = random.below(2) == 0 ? 0 : any_gain(random);
    double k = any_gain(random), q = random.uniform(-1, 1), r = random.uniform(-1, 1);
    MasterIpc ipc;
    ipc.x = random.uniform(-1, 1);
    ipc.v = random.uniform(-1, 1);
    for (int step = 0; step < 50; ++step) {
      const double before = ipc.stored(g, q, r, k), x = ipc.x, r_old = r, k_old = k;
      const double dq = random.uniform(-0.1, 0.1);
      q += dq;
      r += random.uniform(-0.1, 0.1);
      if (random.below(4) == 0) k = any_gain(random);
      ipc.step(g, T, q, r, k, b_added);
      const double after = ipc.stored(g, q, r, k);
      const double move = 0.5 * k * (r - x) * (r - x) - 0.5 * k_old * (r_old - x) * (r_old - x);
      const double supplied = g.k_c * (q - x) * dq + move;
      ASSERT_TRUE(std::isfinite(ipc.x) && std::isfinite(ipc.v) && std::isfinite(ipc.dissipated));
      const double scale = std::abs(before) + std::abs(after) + std::abs(move) + std::abs(g.k_c * (q - x) * dq);
      ASSERT_LE(after - before, supplied + 1e-12 * scale) << "step " << step;  // ARCHITECTURE.md, invariant 9
      ASSERT_LE(after - before, supplied - ipc.dissipated + 1e-12 * scale)
          << "step " << step;  // the reported heat is lost
      ASSERT_GE(ipc.dissipated, 0);
    }
  }
}

TEST(MasterIpc, RendersTheSeriesOfItsSprings) {  // oracle 3: 250 N/m as in [Licona et al. 2019]
  const MasterIpc::Gains g{750, 12, 0.02};
  const ToolIpc::Gains tool{0.05, 12};
  MasterIpc ipc;
  ToolIpc t;
  const double q = 0.012, q_s = 0, k = 750, k_s = 750;
  for (int i = 0; i < 20000; ++i) {  // alpha = 1, the cut at the network with zero delay
    ipc.step(g, 0.001, q, t.x, k, 0);
    ToolIpc::Pull pull;
    pull.spring(k, ipc.x);
    pull.spring(k_s, q_s);
    t.step(tool, 0.001, pull, k);
  }
  EXPECT_NEAR(ipc.device_effort(g, q), -250 * q, 0.001 * 250 * q);
  EXPECT_NEAR(k_s * (t.x - q_s), 250 * q, 0.001 * 250 * q);  // the slave feels the same force
}

TEST(MasterIpc, RestsWithoutForceWhereItIsPlaced) {
  const MasterIpc::Gains g{400, 1, 0.02};
  MasterIpc ipc;
  ipc.v = 3;
  ipc.rest_at(0.07);
  EXPECT_EQ(ipc.device_effort(g, 0.07), 0);
  ipc.step(g, 0.001, 0.07, 0.07, 1000, 0);
  EXPECT_EQ(ipc.x, 0.07);
  EXPECT_EQ(ipc.v, 0);
}

TEST(MasterIpc, MatchesOneHandComputedStep) {
  MasterIpc ipc;  // m 1, k_c 2, k 3, b 4, T 0.5: v = 0.5 (2 q + 3 r) / (1 + 0.5 * 4 + 0.25 * 5)
  ipc.step({2, 1, 1}, 0.5, 1, 2, 3, 3);
  EXPECT_DOUBLE_EQ(ipc.v, 4 / 4.25);
  EXPECT_DOUBLE_EQ(ipc.x, 2 / 4.25);
  EXPECT_DOUBLE_EQ(ipc.dissipated, 4 * ipc.v * ipc.v * 0.5 + 0.5 * 3 * ipc.x * ipc.x);  // damper and channel spring
  EXPECT_DOUBLE_EQ(ipc.device_effort({2, 1, 1}, 1), -2 * (1 - ipc.x));
}

TEST(ToolIpc, NeverCreatesEnergyUnderAnyPull) {
  const std::uint64_t last = test::seeds(1000);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const ToolIpc::Gains g{any_gain(random), any_gain(random)};
    const double T = std::pow(10.0, random.uniform(-5, -1));
    std::array<double, 8> k{}, anchor{};
    for (std::size_t i = 0; i < 8; ++i) {
      k[i] = any_gain(random);
      anchor[i] = random.uniform(-1, 1);
    }
    ToolIpc tool;
    tool.x = random.uniform(-1, 1);
    tool.v = random.uniform(-1, 1);
    const auto energy = [&] {
      double e = 0.5 * g.m_s * tool.v * tool.v;
      for (std::size_t i = 0; i < 8; ++i) e += 0.5 * k[i] * (anchor[i] - tool.x) * (anchor[i] - tool.x);
      return e;
    };
    for (int step = 0; step < 50; ++step) {
      ToolIpc::Pull pull;
      for (std::size_t i = 0; i < 8; ++i) pull.spring(k[i], anchor[i]);
      const double before = energy();
      tool.step(g, T, pull, pull.k - k[0]);
      ASSERT_TRUE(std::isfinite(tool.x) && std::isfinite(tool.v));
      ASSERT_LE(energy() + tool.dissipated, before * (1 + 1e-12) + 1e-12) << "step " << step;
    }
  }
}

TEST(ToolIpc, CoastsWithoutPull) {
  ToolIpc tool{0.1, 0.2, 0};
  tool.step({0.05, 0}, 0.001, {}, 0);
  EXPECT_DOUBLE_EQ(tool.v, 0.2);
  EXPECT_DOUBLE_EQ(tool.x, 0.1002);
  EXPECT_EQ(tool.dissipated, 0);
}

}  // namespace
}  // namespace tandem::control
