#include "common/control/esc_hub.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::control {
namespace {

/// Oracle 1 of the design notes (control 10), for any A, C and gates. The sum of all port powers equals the power
/// injected by the flow sources.
template <std::size_t N, std::size_t M>
void balances(RandomStream& random) {
  std::array<std::array<double, N>, M> A{}, C{}, g{};
  std::array<double, M> v{};
  std::array<double, N> F{};
  for (std::size_t j = 0; j < M; ++j) {
    v[j] = random.uniform(-2, 2);
    for (std::size_t i = 0; i < N; ++i) {
      A[j][i] = random.uniform();
      C[j][i] = random.uniform();
      g[j][i] = static_cast<double>(random.below(2));
    }
  }
  for (double& f : F) f = random.uniform(-20, 20);
  const auto out = hub<N, M>(A, C, g, v, F);
  double sum = 0, scale = 1e-9, expected = 0;
  for (std::size_t i = 0; i < N; ++i) {
    sum += F[i] * out.flow[i];
    scale += std::abs(F[i] * out.flow[i]);
  }
  for (std::size_t j = 0; j < M; ++j) {
    sum += out.effort[j] * v[j];
    scale += std::abs(out.effort[j] * v[j]);
    for (std::size_t i = 0; i < N; ++i) expected += g[j][i] * (C[j][i] - A[j][i]) * F[i] * v[j];
  }
  scale = std::max(scale, std::abs(expected));
  EXPECT_NEAR(out.injected, expected, 1e-12 * scale) << N << " masters, " << M << " tools";
  EXPECT_NEAR(sum, out.injected, 1e-12 * scale) << N << " masters, " << M << " tools";
}

TEST(EscHub, ConservesPowerUpToWhatTheFlowSourcesInject) {
  const std::uint64_t last = test::seeds(200);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    balances<1, 1>(random);
    balances<2, 1>(random);
    balances<3, 1>(random);
    balances<8, 1>(random);
    balances<1, 2>(random);
    balances<2, 2>(random);
    balances<5, 3>(random);
    balances<8, 4>(random);
  }
}

/// Eq. 1-2 of [Licona et al. 2019] row by row, with all betas. The sources give g v_rs (eq. 4).
struct Printed {
  double v_r1, v_r2, F_rs;
};
Printed printed(double alpha, double g, double v_rs, double F_r1, double F_r2) {
  const bool edge = alpha == 0 || alpha == 1;
  const double beta1 = edge ? alpha : 1;
  const double beta2 = edge ? alpha : 0;
  const double v_s1 = beta1 * v_rs;  // eq. 2
  const double v_s2 = (1 - beta2) * v_rs;
  const double v_sf = g * v_rs;       // eq. 4
  const double T_s1 = -alpha * F_r1;  // eq. 1
  const double T_s2 = (alpha - 1) * F_r2;
  return {alpha * v_s1 + (1 - alpha) * v_sf, (1 - alpha) * v_s2 + alpha * v_sf, beta1 * T_s1 + (1 - beta2) * T_s2};
}

TEST(EscHub, MatchesThePaperForTwoMastersAndOneTool) {
  RandomStream random{1};
  for (int trial = 0; trial < 1000; ++trial) {
    const double alpha = trial % 4 == 0 ? 0 : trial % 4 == 1 ? 1 : random.uniform();
    const double g = static_cast<double>(random.below(2));
    const double v = random.uniform(-1, 1);
    const std::array F{random.uniform(-5, 5), random.uniform(-5, 5)};
    const auto out = hub<2, 1>({{{alpha, 1 - alpha}}}, {{{1, 1}}}, {{{g, g}}}, {v}, F);
    const Printed paper = printed(alpha, g, v, F[0], F[1]);
    EXPECT_NEAR(out.flow[0], paper.v_r1, 1e-15);
    EXPECT_NEAR(out.flow[1], paper.v_r2, 1e-15);
    EXPECT_NEAR(out.effort[0], paper.F_rs, 1e-14);
  }
}

TEST(EscHub, MovesAFollowerThatDoesNotPush) {
  const auto out = hub<2, 1>({{{1, 0}}}, {{{1, 1}}}, {{{1, 1}}}, {0.5}, {2, 100});
  EXPECT_EQ(out.flow[1], 0.5);
  EXPECT_EQ(out.effort[0], -2);
  EXPECT_EQ(out.injected, 50);
  const auto cut = hub<2, 1>({{{1, 0}}}, {{{1, 1}}}, {{{0, 0}}}, {0.5}, {2, 100});
  EXPECT_EQ(cut.flow[1], 0);
  EXPECT_EQ(cut.injected, 0);
}

TEST(EscHub, IsLosslessInTheWeightedStorageWithOpenGates) {
  RandomStream random{5};
  for (int trial = 0; trial < 200; ++trial) {
    const double a = random.uniform(), v = random.uniform(-1, 1);
    const std::array A{a, 0.5 * (1 - a), 0.5 * (1 - a)};
    const std::array F{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
    const auto out = hub<3, 1>({A}, {{{1, 1, 1}}}, {{{1, 1, 1}}}, {v}, F);
    double power = out.effort[0] * v;
    for (std::size_t i = 0; i < 3; ++i) power += A[i] * F[i] * out.flow[i];
    EXPECT_NEAR(power, 0, 1e-14);
  }
}

}  // namespace
}  // namespace tandem::control
