#include "hal/sim/linear_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tandem::hal::sim {
namespace {

SimDeviceSpec bare() {
  SimDeviceSpec s;
  s.model = DeviceModel::kLinear;
  s.friction = 0;
  s.damping = 0;
  s.mass = 0.1;
  return s;
}

void run(LinearPlant& p, double force, const HandPull& hand, double duration) {
  for (int i = 0; i < static_cast<int>(std::lround(duration * 1000)); ++i) p.advance({force, 0, 0}, hand, 1e-3);
}

TEST(LinearPlant, AcceleratesByForceOverMass) {
  LinearPlant p(bare(), {}, Vec3::Zero());
  run(p, 0.2, {}, 0.5);
  EXPECT_NEAR(p.dq()[0], 1.0, 1e-12);
  EXPECT_NEAR(p.tip()[0], 0.25, 1e-12);
}

TEST(LinearPlant, ASpringKeepsItsEnergy) {
  LinearPlant p(bare(), {}, Vec3::Zero());
  p.set(0.01, 0.0);
  HandPull spring;
  spring.k = 1000;
  double low = 1, high = 0;
  for (int i = 0; i < 10000; ++i) {
    p.advance(Vec3::Zero(), spring, 1e-3);
    const double e = p.kinetic_energy() + 500 * p.tip()[0] * p.tip()[0];
    low = std::min(low, e);
    high = std::max(high, e);
  }
  EXPECT_NEAR(low, 0.05, 0.05 * 1e-3);
  EXPECT_NEAR(high, 0.05, 0.05 * 1e-3);
}

TEST(LinearPlant, WallPenetrationIsForceOverStiffness) {
  for (double k = 1e2; k <= 1e8; k *= 10) {
    SCOPED_TRACE(k);
    EnvironmentSpec e;
    e.wall = WallSpec{0, 0.0, k, 5.0, true};
    SimDeviceSpec s = bare();
    s.damping = 1;
    LinearPlant p(s, e, Vec3::Zero());
    run(p, 2.0, {}, 20.0);
    EXPECT_NEAR(p.penetration(), 2.0 / k, 2e-3 / k);
    EXPECT_NEAR(p.environment_force()[0], -2.0, 1e-3);
  }
}

TEST(LinearPlant, ABounceGainsNoEnergyAtAnyStiffness) {
  for (double k = 1e-2; k <= 1e10; k *= 10) {
    SCOPED_TRACE(k);
    EnvironmentSpec e;
    e.wall = WallSpec{0, 0.0, k, 0.0, true};
    LinearPlant p(bare(), e, Vec3::Zero());
    p.set(-0.01003, 0.5);
    run(p, 0.0, {}, 2.0);
    EXPECT_LE(std::abs(p.dq()[0]), 0.5 * 1.02) << "elastic bounce";
  }
}

TEST(LinearPlant, FrictionStopsMotionAndHoldsAgainstLess) {
  SimDeviceSpec s = bare();
  s.friction = 0.26;
  LinearPlant p(s, {}, Vec3::Zero());
  p.set(0.0, 0.2);
  run(p, 0.0, {}, 0.2);
  // v²/2a = 0.04 / (2 * 2.6)
  EXPECT_NEAR(p.tip()[0], 0.04 / 5.2, 2e-4);
  EXPECT_LT(std::abs(p.dq()[0]), 1e-5);
  run(p, 0.13, {}, 1.0);
  EXPECT_LT(p.dq()[0], 1e-3);
  run(p, 0.52, {}, 0.1);
  EXPECT_NEAR(p.dq()[0], 0.26, 0.01) << "breaks loose: (0.52 - 0.26) N / 0.1 kg for 0.1 s";
}

TEST(LinearPlant, StaysFiniteForEveryInput) {
  const double values[] = {0.0,
                           5e-324,
                           1e-300,
                           1.0,
                           1e12,
                           1e300,
                           std::numeric_limits<double>::max(),
                           std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()};
  EnvironmentSpec e;
  e.wall = WallSpec{};
  e.tissue = TissueSpec{0, 0.01, 300, 1e6, 3, true};
  for (const double v : values) {
    SimDeviceSpec s = bare();
    s.friction = 1.0;
    LinearPlant p(s, e, Vec3::Zero());
    HandPull hand;
    hand.force[0] = -v;
    hand.k = 1000;
    hand.x[0] = v;
    run(p, v, hand, 0.05);
    EXPECT_TRUE(std::isfinite(p.tip()[0]) && std::isfinite(p.dq()[0]) && p.environment_force().allFinite()) << v;
  }
}

}  // namespace
}  // namespace tandem::hal::sim
