#include "hal/sim/touch_plant.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "common/base/rng.h"

namespace tandem::hal::sim {
namespace {

SimDeviceSpec bare() {
  SimDeviceSpec s;
  s.friction = 0;
  s.damping = 0;
  s.gravity = false;
  return s;
}
Vec3 home() { return *touch_inverse(Vec3::Zero()); }
HandPull grip(double k = 1000, double b = 10, double m = 0.1) {
  HandPull h;
  h.k = k, h.b = b, h.m = m;
  return h;
}
void run(TouchPlant& p, const Vec3& tau, const HandPull& hand, double duration) {
  for (int i = 0; i < static_cast<int>(std::lround(duration * 1000)); ++i) p.advance(tau, hand, 1e-3);
}

TEST(TouchPlant, MatchesTheDocumentedInertia) {
  const TouchPose p(Vec3(0.3, 0.7, 0.5));
  const Eigen::Matrix3d m = TouchPlant::inertia(p);
  const double arm = 0.13335 * p.c2 + 0.1108 * p.s3;
  EXPECT_NEAR(m(0, 0), 2e-4 + 0.04 * std::pow(0.0443 * p.c2, 2) + 0.08 * arm * arm, 1e-15);
  EXPECT_NEAR(m(1, 1), 2e-4 + 0.04 * 0.0443 * 0.0443 + 0.08 * 0.13335 * 0.13335, 1e-15);
  EXPECT_NEAR(m(2, 2), 2e-4 + 0.08 * 0.1108 * 0.1108, 1e-15);
  EXPECT_NEAR(m(1, 2), 0.08 * 0.13335 * 0.1108 * std::sin(0.5 - 0.7), 1e-15);
}

TEST(TouchPlant, FreeMotionKeepsItsKineticEnergy) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r(seed);
    TouchPlant p(bare(), {}, home());
    // Slow enough to avoid the stops, fast enough for a noticeable effect of the Coriolis terms.
    p.set(home(), Vec3(r.uniform(-2, 2), r.uniform(-1, 1), r.uniform(-1, 1)));
    const double before = p.kinetic_energy();
    run(p, Vec3::Zero(), {}, 0.25);
    EXPECT_TRUE(TouchPlant::within_stops(p.q()));
    EXPECT_NEAR(p.kinetic_energy() / before, 1.0, 1e-5);
  }
}

TEST(TouchPlant, FreeFallKeepsItsTotalEnergy) {
  SimDeviceSpec s = bare();
  s.gravity = true;
  TouchPlant p(s, {}, home());
  p.set(home(), Vec3(1.0, 1.0, 0.0));
  const double before = p.kinetic_energy() + p.potential_energy();
  run(p, Vec3::Zero(), {}, 0.1);
  EXPECT_GT(p.kinetic_energy(), 1e-3);
  EXPECT_NEAR(p.kinetic_energy() + p.potential_energy(), before, 1e-6);
}

TEST(TouchPlant, AHeldMassSwingsWithItsEnergyToo) {
  // A frictionless spring about the origin and 0.1 kg at the tip: the sum of both kinetic energies and the spring's
  // energy is constant.
  TouchPlant p(bare(), {}, *touch_inverse({0.01, 0.0, 0.0}));
  const HandPull spring = grip(200, 0, 0.1);
  const auto energy = [&] {
    return p.kinetic_energy() + 0.05 * p.tip_velocity().squaredNorm() + 100 * p.tip().squaredNorm();
  };
  const double before = energy();
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    p.advance(Vec3::Zero(), spring, 1e-3);
    worst = std::max(worst, std::abs(energy() / before - 1.0));
  }
  EXPECT_LT(worst, 0.01);
}

TEST(TouchPlant, AStiffSpringKeepsItsEnergyAtAnObliquePose) {
  // 10 MN/m and the bare device: four times faster than a substep.
  // The trapezoidal rule conserves the energy of a linear system at any step if every implicit term is present. The
  // remaining error is the change of J within the 0.01 mm.
  const Vec3 there(0.02, -0.05, 0.03);
  TouchPlant p(bare(), {}, *touch_inverse(there + Vec3(1e-5, -1e-5, 1e-5)));
  HandPull spring = grip(1e7, 0, 0);
  spring.x = there;
  const auto energy = [&] { return p.kinetic_energy() + 5e6 * (p.tip() - there).squaredNorm(); };
  const double before = energy();
  for (int i = 0; i < 2000; ++i) {
    p.advance(Vec3::Zero(), spring, 1e-3);
    ASSERT_NEAR(energy() / before, 1.0, 0.05);
  }
}

TEST(TouchPlant, AcceleratesByItsApparentMass) {
  TouchPlant p(bare(), {}, home());
  const TouchPose pose(home());
  const Eigen::Matrix3d j = pose.jacobian();
  const Vec3 force(0.1, 0.05, -0.1);
  const Vec3 expected = j * TouchPlant::inertia(pose).inverse() * j.transpose() * force;
  run(p, pose.joint_effort(force), {}, 0.01);
  EXPECT_LT((p.tip_velocity() / 0.01 - expected).norm(), 0.02 * expected.norm());
}

TEST(TouchPlant, GravityPullsDownUnlessHeld) {
  SimDeviceSpec s = bare();
  s.gravity = true;
  TouchPlant falling(s, {}, home()), held(s, {}, home());
  run(falling, Vec3::Zero(), {}, 0.05);
  EXPECT_LT(falling.tip()[2], -1e-3);
  for (int i = 0; i < 100; ++i) held.advance(TouchPlant::gravity(held.pose()), {}, 1e-3);
  EXPECT_LT(held.tip().norm(), 1e-9);
}

TEST(TouchPlant, StaticSagIsForceOverStiffness) {
  SimDeviceSpec s = bare();
  s.gravity = true;
  s.damping = 0.2;
  TouchPlant p(s, {}, home());
  run(p, Vec3::Zero(), grip(), 3.0);
  // At rest J^T K (0 - x) = G.
  const Vec3 spring = p.pose().joint_effort(-1000.0 * p.tip());
  EXPECT_LT((spring - TouchPlant::gravity(p.pose())).norm(), 1e-9);
  EXPECT_GT(p.tip().norm(), 5e-4);
  EXPECT_LT(p.tip().norm(), 2e-3);
}

TEST(TouchPlant, FrictionStopsMotionAndHolds) {
  SimDeviceSpec s = bare();
  s.friction = 0.26;
  TouchPlant p(s, {}, home());
  p.set(home(), Vec3(0.5, 0.5, 0.0));
  run(p, Vec3::Zero(), {}, 0.3);
  EXPECT_LT(p.tip_velocity().norm(), 1e-5);
  const Vec3 before = p.tip();
  run(p, p.pose().joint_effort({0.13, 0, 0}), {}, 0.2);
  EXPECT_LT((p.tip() - before).norm(), 0.2 * kFrictionSpeed) << "creeps below the smoothing speed at most";
  run(p, p.pose().joint_effort({0.6, 0, 0}), {}, 0.1);
  EXPECT_GT((p.tip() - before).norm(), 5e-3) << "breaks loose";
}

TEST(TouchPlant, AnyFrictionIsStableAndDissipates) {
  for (double friction = 0; friction <= 1e6; friction = friction == 0 ? 1e-6 : friction * 10) {
    SCOPED_TRACE(friction);
    SimDeviceSpec s = bare();
    s.friction = friction;
    TouchPlant p(s, {}, home());
    p.set(home(), Vec3(1.0, 0.5, -0.5));
    double energy = p.kinetic_energy() * (1 + 1e-5);
    for (int i = 0; i < 300; ++i) {
      p.advance(Vec3::Zero(), {}, 1e-3);
      ASSERT_LE(p.kinetic_energy(), energy * (1 + 1e-5));
      energy = p.kinetic_energy();
    }
  }
}

TEST(TouchPlant, WallPenetrationIsForceOverStiffness) {
  for (const double k : {1e2, 1e3, 2e4, 1e5, 1e7}) {
    SCOPED_TRACE(k);
    EnvironmentSpec e;
    e.wall = WallSpec{0, 0.0, k, 5.0, true};
    SimDeviceSpec s = bare();
    s.damping = 1;
    TouchPlant p(s, e, home());
    for (int i = 0; i < 6000; ++i)
      p.advance(p.pose().joint_effort(Vec3(2.0, 0, 0) - 50 * Vec3(0, p.tip()[1], p.tip()[2])), {}, 1e-3);
    EXPECT_NEAR(p.penetration(), 2.0 / k, 0.01 / k + 1e-9);
    EXPECT_NEAR(p.environment_force()[0], -2.0, 0.01);
  }
}

TEST(TouchPlant, SettlesUnderALeaderPressingOnAWall) {
  for (double k = 1e-4; k <= 1e8; k *= 10) {
    SCOPED_TRACE(k);
    EnvironmentSpec e;
    e.wall = WallSpec{0, 0.0, k, 5.0, true};
    TouchPlant p(SimDeviceSpec{}, e, *touch_inverse({-0.02, 0, 0}));
    HandPull hand = grip();
    hand.x = {0.003, 0, 0};
    run(p, Vec3::Zero(), hand, 3.0);
    EXPECT_LT(p.tip_velocity().norm(), 1e-3);
    const double expected = 0.003 * 1000 / (1000 + k);
    EXPECT_NEAR(p.tip()[0], expected, 0.3e-3) << "friction of 0.1 N in each joint hides up to 0.1 mm of the spring";
  }
}

TEST(TouchPlant, RestsOnTissueAndWallTogether) {
  EnvironmentSpec e;
  e.wall = WallSpec{2, -0.01, 2e4, 5, false};
  e.tissue = TissueSpec{};
  SimDeviceSpec s = bare();
  s.damping = 1;
  TouchPlant p(s, e, *touch_inverse({0, 0, 0.01}));
  for (int i = 0; i < 5000; ++i)
    p.advance(p.pose().joint_effort(Vec3(0, 0, -6.0) - 200 * Vec3(p.tip()[0], p.tip()[1], 0)), {}, 1e-3);
  EXPECT_NEAR(p.environment_force()[2], 6.0, 0.01);
  const double d = -p.tip()[2];
  EXPECT_NEAR(300 * d + 1e6 * d * d * d + 2e4 * std::max(0.0, d - 0.01), 6.0, 0.02);
}

TEST(TouchPlant, StaysBoundedOverTwelveDecadesOfHandStiffness) {
  for (double k = 1e-6; k <= 1e6; k *= 10) {
    for (const double m : {0.0, 0.05, 0.5}) {
      SCOPED_TRACE(testing::Message() << "k " << k << " m " << m);
      TouchPlant p(SimDeviceSpec{}, {}, home());
      HandPull hand = grip(k, 2, m);
      hand.x = {0.005, 0.0, 0.005};
      run(p, TouchPlant::gravity(p.pose()), hand, 3.0);
      ASSERT_TRUE(p.q().allFinite());
      EXPECT_LT(p.tip_velocity().norm(), 0.05);
      if (k >= 1e4) {
        EXPECT_LT((p.tip() - hand.x).norm(), 2e-3);
      }
    }
  }
}

TEST(TouchPlant, AgreesForStepsOfAnySize) {
  const auto end = [](double dt) {
    TouchPlant p(SimDeviceSpec{}, {}, home());
    HandPull hand = grip();
    hand.x = {0.02, 0.01, -0.01};
    for (int i = 0; i < static_cast<int>(std::lround(0.1 / dt)); ++i)
      p.advance(TouchPlant::gravity(p.pose()), hand, dt);
    return p.tip();
  };
  const Vec3 fine = end(0.02e-3);
  EXPECT_LT((end(1e-3) - fine).norm(), 0.15e-3);
  EXPECT_LT((end(0.25e-3) - fine).norm(), 0.1e-3);
}

TEST(TouchPlant, StaysFiniteForEveryInput) {
  const double values[] = {5e-324,
                           1e-300,
                           1e12,
                           1e300,
                           std::numeric_limits<double>::max(),
                           std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()};
  EnvironmentSpec e;
  e.wall = WallSpec{};
  for (const double v : values) {
    TouchPlant p(SimDeviceSpec{}, e, home());
    HandPull hand = grip();
    hand.x = hand.v = hand.force = Vec3(v, -v, v);
    run(p, Vec3(v, v, -v), hand, 0.2);
    EXPECT_TRUE(p.q().allFinite() && p.dq().allFinite() && p.tip().allFinite() && p.environment_force().allFinite())
        << v;
    run(p, Vec3::Zero(), grip(), 2.0);
    EXPECT_LT(p.tip_velocity().norm(), 0.1) << "comes to rest again after " << v;
  }
}

TEST(TouchPlant, SurvivesTheSingularPose) {
  SimDeviceSpec s = bare();
  s.damping = 0.2;
  TouchPlant p(s, {}, home());
  HandPull hand = grip();
  hand.x = {0.0, -0.3, 0.0};  // far beyond the stretched arm
  run(p, Vec3::Zero(), hand, 2.0);
  EXPECT_TRUE(p.q().allFinite());
  EXPECT_LT(p.tip_velocity().norm(), 0.05);
  hand.x.setZero();
  run(p, Vec3::Zero(), hand, 2.0);
  EXPECT_LT(p.tip().norm(), 1e-3);
}

TEST(TouchPlant, PrintsWhatATickCosts) {
  EnvironmentSpec wall;
  wall.wall = WallSpec{0, 0.0, 2e4, 5, true};
  struct Case {
    const char* name;
    EnvironmentSpec environment;
    HandPull hand;
  };
  HandPull press = grip();
  press.x = {0.002, 0, 0};
  for (const Case& c : {Case{"free", {}, {}}, Case{"hand", {}, grip()}, Case{"wall", wall, press}}) {
    TouchPlant p(SimDeviceSpec{}, c.environment, home());
    run(p, Vec3::Zero(), c.hand, 0.5);
    constexpr int kTicks = 20000;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kTicks; ++i) p.advance(TouchPlant::gravity(p.pose()), c.hand, 1e-3);
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
    std::printf("[ bench    ] TouchPlant, 1 ms, %s: %.0f ns\n", c.name, spent.count() / kTicks);
    EXPECT_TRUE(p.q().allFinite());
  }
}

}  // namespace
}  // namespace tandem::hal::sim
