#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/control/ipc.h"
#include "tests/support/sampled_wall.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001;

/// Spectral radius of one tick of device and real MasterIpc, computed column by column: both are linear.
double spectral_radius(const MasterIpc::Gains& g, double k, const test::HeldMass& device) {
  Eigen::Matrix4d M;
  for (int column = 0; column < 4; ++column) {
    std::array<double, 4> s{};
    s[static_cast<std::size_t>(column)] = 1;
    MasterIpc ipc;
    ipc.x = s[2];
    ipc.v = s[3];
    ipc.step(g, kT, s[0], 0, k, 0);
    const Eigen::Vector2d next = device.A * Eigen::Vector2d(s[0], s[1]) + device.B * ipc.device_effort(g, s[0]);
    M.col(column) << next[0], next[1], ipc.x, ipc.v;
  }
  return M.eigenvalues().cwiseAbs().maxCoeff();
}

/// Damping that a device needs for a stable loop with any mass. Without mass, b alone decides, at half the sample rate.
double least_device_damping(const MasterIpc::Gains& g, double k) {
  double worst = 0;
  for (double m = 1e-8; m < 10; m *= 2) {
    double lo = 1e-3 * g.k_c * kT, hi = 10 * g.k_c * kT;
    for (int i = 0; i < 40; ++i) {
      const double b = 0.5 * (lo + hi);
      (spectral_radius(g, k, test::HeldMass(m, b, kT)) < 1 ? hi : lo) = b;
    }
    worst = std::max(worst, hi);
  }
  return worst;
}

TEST(MasterIpc, RequiresTheDampingOfColgateAndSchenkel) {
  for (const double k_c : {100.0, 400.0, 750.0}) {
    const double needed = least_device_damping({k_c, 1, 0.02}, 1000);
    EXPECT_NEAR(needed, 0.5 * k_c * kT, 0.03 * 0.5 * k_c * kT) << "k_c = " << k_c;
  }
}

TEST(MasterIpc, RequiresNoMoreDampingForAStiffReference) {
  const double soft = least_device_damping({400, 1, 0.02}, 60), stiff = least_device_damping({400, 1, 0.02}, 10000);
  EXPECT_NEAR(soft, 0.2, 0.006);
  EXPECT_NEAR(stiff, 0.2, 0.006);
}

TEST(SampledWall, IsStableUpToGilAndHulinsStiffness) {
  struct Row {
    int delay;
    double limit;
  };
  for (const Row row : {Row{0, 200}, Row{1, 66.7}, Row{5, 18.2}, Row{20, 4.9}}) {
    const test::SampledWall wall{.m = 0.045, .b = 0.1, .B = 0, .T = kT, .delay = row.delay};
    EXPECT_NEAR(wall.stiffness_limit(), row.limit, 0.02 * row.limit) << "delay " << row.delay << " ms";
    const double law = 0.1 / (0.5 * kT + row.delay * kT);
    EXPECT_NEAR(wall.stiffness_limit(), law, 0.02 * law) << "delay " << row.delay << " ms";
  }
}

TEST(SampledWall, IsNeverStableWithMuchDelayedDamping) {
  const test::SampledWall wall{.m = 0.045, .b = 0.5, .B = 4, .T = kT, .delay = 20};
  for (double K = 1e-3; K < 1e4; K *= 1.5) EXPECT_GT(wall.spectral_radius(K), 1) << K;
  EXPECT_EQ(wall.stiffness_limit(), 0);
}

TEST(SampledWall, GrowsInTimeExactlyWhereItsEigenvaluesSay) {  // by eigenvalues and by simulation
  const test::HeldMass mass(0.045, 0.1, kT);
  for (const double K : {190.0, 210.0}) {
    Eigen::Vector2d s(0.01, 0);
    for (int i = 0; i < 20000; ++i) s = (mass.A * s - K * s[0] * mass.B).eval();
    EXPECT_EQ(std::abs(s[0]) > 0.01, test::SampledWall{}.spectral_radius(K) > 1) << K;
  }
}

}  // namespace
}  // namespace tandem::control
