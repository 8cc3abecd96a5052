#include "hal/drivers/woodenhaptics/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/rng.h"
#include "hal/drivers/woodenhaptics/motors.h"
#include "hal/drivers/woodenhaptics/woodenhaptics_caps.h"
#include "tests/common/base/counts.h"
#include "tests/hal/drivers/woodenhaptics/mechanisms.h"

namespace tandem::hal::woodenhaptics {
namespace {

constexpr double kPi = std::numbers::pi;

/// Returns a random tip position in the ball of the workspace.
Vec3 somewhere(RandomStream& r, double radius) {
  Vec3 x;
  do {
    for (int i = 0; i < 3; ++i) x[i] = r.uniform(-radius, radius);
  } while (x.norm() > radius);
  return x;
}

TEST(WoodenKinematics, MatchesTheHandComputedCalibrationPose) {
  const Kinematics k(test::wooden_2015());
  const Vec3 q = k.angles({0, 0, 6000});
  EXPECT_NEAR(q[2], kPi / 2, 1e-15) << "three turns of a motor whose capstan is a twelfth of the drum";
  // Upper arm upright, forearm level: 245 mm before the base, 80 + 205 mm high; the origin is 220 mm before it, 80
  // high.
  const Vec3 tip = k.tip(q);
  EXPECT_NEAR(tip[0], 0.0, 1e-15);
  EXPECT_NEAR(tip[1], -0.025, 1e-15) << "25 mm nearer to the user than the origin";
  EXPECT_NEAR(tip[2], 0.205, 1e-15);
}

TEST(WoodenKinematics, UsesTheFramesOfTheHal) {
  const Kinematics k(test::wooden_2015());
  const Eigen::Matrix3d j = k.jacobian(*k.inverse(Vec3::Zero()));
  EXPECT_GT(j(0, 0), 0.0) << "the base turns the tip to the right";
  EXPECT_LT(j(1, 1), 0.0) << "leaning the upper arm forward brings the tip to the user";
  EXPECT_LT(j(1, 2), 0.0);
  EXPECT_LT(j(2, 1), 0.0) << "and lowers it";
  EXPECT_GT(j(2, 2), 0.0) << "raising the forearm raises the tip";
}

TEST(WoodenKinematics, ForwardUndoesInverseOverTheWorkspace) {
  double worst = 0.0;
  for (const auto& spec : test::mechanisms()) {
    const Kinematics k(spec);
    const std::uint64_t seeds = test::seeds(2000);
    std::uint64_t reached = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      RandomStream r(seed);
      const Vec3 x = somewhere(r, spec.radius);
      const auto q = k.inverse(x);
      if (!q) continue;  // AluHaptics' short arms do not fill the ball
      ++reached;
      worst = std::max(worst, (k.tip(*q) - x).norm());
      ASSERT_LT((k.tip(*q) - x).norm(), 1e-9) << seed;
      ASSERT_GE(std::sin((*q)[1] + (*q)[2]), -1e-9) << "elbow down, seed " << seed;
    }
    EXPECT_GT(reached, seeds * 9 / 10);
  }
  std::printf("[ worst    ] FK(IK(x)) - x: %.2g m\n", worst);
}

TEST(WoodenKinematics, InverseUndoesForwardInJoints) {
  for (const auto& spec : test::mechanisms()) {
    const Kinematics k(spec);
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
      RandomStream r(seed);
      const double b = r.uniform(-0.5, 1.3);
      const Vec3 q(r.uniform(-1.3, 1.3), b, r.uniform(0.01 - b, kPi - 0.01 - b));          // elbow up
      if (spec.link[1] * std::sin(q[1]) + spec.link[2] * std::sin(q[2]) < 1e-3) continue;  // behind the base
      const auto back = k.inverse(k.tip(q));
      ASSERT_TRUE(back.has_value()) << seed;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::remainder((*back - q)[i], 2 * kPi), 0.0, 1e-9) << seed;
    }
  }
}

TEST(WoodenKinematics, JacobianIsTheDerivative) {
  double worst = 0.0;
  for (const auto& spec : test::mechanisms()) {
    const Kinematics k(spec);
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
      RandomStream r(seed);
      const Vec3 q(r.uniform(-1.5, 1.5), r.uniform(-1, 2), r.uniform(-1, 3));
      const Eigen::Matrix3d j = k.jacobian(q);
      for (int i = 0; i < 3; ++i) {
        const Vec3 d = 1e-5 * Vec3::Unit(i);
        worst = std::max(worst, ((k.tip(q + d) - k.tip(q - d)) / 2e-5 - j.col(i)).norm());
      }
    }
  }
  EXPECT_LT(worst, 1e-6);
  std::printf("[ worst    ] J - numeric: %.2g m/rad\n", worst);
}

TEST(WoodenKinematics, PowerIsTheSameAtTipAndJoints) {
  const Kinematics k(test::wooden_2015());
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomStream r(seed);
    const Eigen::Matrix3d j = k.jacobian(*k.inverse(somewhere(r, 0.1)));
    const Vec3 dq(r.uniform(-3, 3), r.uniform(-3, 3), r.uniform(-3, 3)), f(r.uniform(-5, 5), r.uniform(-5, 5), 1);
    EXPECT_NEAR(f.dot(j * dq), (j.transpose() * f).dot(dq), 1e-12) << seed;
  }
}

TEST(WoodenKinematics, HoldingEffortIsTheSlopeOfThePotential) {
  const Kinematics k(test::wooden_2015());
  // Arms level: 0.17 kg at 51 mm and 0.11 kg at the elbow pull the shoulder down, 0.11 kg at 91 mm the elbow.
  const Vec3 level = k.holding_effort({0.3, kPi / 2, kPi / 2});
  EXPECT_NEAR(level[1], -9.80665 * (0.170 * 0.051 + 0.110 * 0.205), 1e-12);
  EXPECT_NEAR(level[2], 9.80665 * 0.110 * 0.091, 1e-12);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream r(seed);
    const Vec3 q(r.uniform(-1, 1), r.uniform(-1, 2), r.uniform(-1, 3));
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = 1e-5 * Vec3::Unit(i);
      EXPECT_NEAR((k.potential(q + d) - k.potential(q - d)) / 2e-5, k.holding_effort(q)[i], 1e-9) << seed;
    }
  }
}

TEST(WoodenKinematics, ReturnsNothingOutOfReach) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  const Kinematics k(test::wooden_2015());
  EXPECT_FALSE(k.inverse({0.0, -0.3, 0.0}).has_value()) << "520 mm from a shoulder with 450 mm of arms";
  EXPECT_FALSE(k.inverse({0.0, 0.22, 0.0}).has_value()) << "on the axis of the base";
  EXPECT_FALSE(k.inverse({0.0, 0.5, 0.0}).has_value()) << "behind the base";
  for (const double bad : {kNan, kInf, -kInf, 1e300}) {
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(k.inverse(bad * Vec3::Unit(i)).has_value());
  }
}

TEST(WoodenCaps, ResolutionAndForcePerAmpereAreThePublishedOnes) {
  struct Row {
    WoodenHapticsSpec spec;
    Vec3 micrometres, newtons;  // along the maker's x, y, z
  };
  for (Row row : {Row{test::wooden_2015(), {72, 43, 44}, {1.6, 1.9, 2.1}},
                  Row{test::aluhaptics_v2(), {45, 52, 57}, {1.8, 1.6, 1.4}},
                  Row{test::polhem_v1(), {61, 24, 31}, {3.4, 6.9, 7.3}}}) {
    row.spec.current_max = row.spec.current_continuous = 1.0;
    row.spec.force_max = 100.0;
    const DeviceCaps caps = caps_of(row.spec);
    const std::array<int, 3> maker{1, 0, 2};  // HAL x is the maker's y
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(*caps.axis[i].resolution * 1e6, row.micrometres[maker[i]], 1.0);
      EXPECT_NEAR(*caps.axis[i].peak, row.newtons[maker[i]], 0.06);
      EXPECT_EQ(caps.axis[i].from, Provenance::kConfig);
    }
  }
}

TEST(WoodenCaps, MatchTheKnownValues) {
  WoodenHapticsSpec spec = test::wooden_2015();
  const DeviceCaps caps = caps_of(spec);
  EXPECT_EQ(caps.joints, 3u);
  EXPECT_EQ(caps.timing, Timing::kLockStep);
  EXPECT_EQ(caps.homing, Homing::kPresetPose);
  EXPECT_EQ(*caps.watchdog, std::chrono::milliseconds(500));
  EXPECT_FALSE(caps.force_calibrated) << "this board was never measured with a mass";
  EXPECT_FALSE(caps.mass.has_value());
  EXPECT_EQ(caps.gravity, GravityCompensation::kNone);
  spec.protocol = WoodenProtocol::kRaw64;
  EXPECT_FALSE(caps_of(spec).watchdog.has_value()) << "published for the mbed firmware only";
  spec.protocol = WoodenProtocol::kV1;
  EXPECT_EQ(*caps_of(spec).watchdog, std::chrono::milliseconds(500));
  EXPECT_EQ(caps_of(spec).timing, Timing::kFreeRunning);
  spec.current_max = 2;  // 3.2 N at the weakest motor, below the maker's 5 N
  EXPECT_NEAR(*caps_of(spec).axis[1].peak, 3.22, 0.01);
  spec.current_max = 6;
  EXPECT_EQ(*caps_of(spec).axis[1].peak, 5.0);
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
