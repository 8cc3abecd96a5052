// Estimates the surface that a slave touches from its motion and effort. The test implements slave and plane
// independently.
#include "common/control/plane_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001;
using State = PlaneEstimator::State;
using Vector = std::array<double, 3>;

/// A slave that presses slowly on a plane through `point`. Its position is where the plane's spring gives the force.
struct Slave {
  Vector normal{-1, 0, 0}, point{};
  double k = 1000, encoder = 0, noise = 0;
  RandomStream random{3};

  PlaneEstimator::Sample pressing(double force) {
    PlaneEstimator::Sample s;
    for (std::size_t a = 0; a < 3; ++a) {
      s.x[a] = point[a] - normal[a] * force / k;
      if (encoder > 0) s.x[a] = encoder * std::round(s.x[a] / encoder);
      s.f[a] = normal[a] * force + noise * random.uniform(-1, 1);
    }
    return s;
  }
};
/// Raises the force to `most` [N] within `rise` seconds and holds it for 1 s.
void press(PlaneEstimator& estimator, Slave& slave, double most, double rise) {
  for (double t = 0; t < rise + 1; t += kT) estimator.step(kT, slave.pressing(most * std::min(1.0, t / rise)));
}
/// Height of a point above the surface through `slave.point` [m].
double height(const Slave& slave, const Vector& x) {
  double sum = 0;
  for (std::size_t a = 0; a < 3; ++a) sum += slave.normal[a] * (x[a] - slave.point[a]);
  return sum;
}

TEST(PlaneEstimator, FindsAPressedPlane) {
  const double r = std::sqrt(1 / 3.0);
  for (const Vector& normal : {Vector{-1, 0, 0}, Vector{0, 0, 1}, Vector{0, -0.6, 0.8}, Vector{r, r, -r}})
    for (const double k : {100.0, 300.0, 1000.0, 5000.0}) {
      Slave slave{.normal = normal, .point = {0.01, -0.02, 0.03}, .k = k};
      PlaneEstimator estimator;
      EXPECT_EQ(estimator.state(), State::kFree);
      press(estimator, slave, 2, 1);
      EXPECT_EQ(estimator.state(), State::kKnown);
      EXPECT_NEAR(estimator.stiffness(), k, 0.02 * k);
      EXPECT_NEAR(height(slave, estimator.point()), 0, 2e-5);
      for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(estimator.normal()[a], normal[a], 1e-6);
      EXPECT_EQ(estimator.touches(), 1u);
    }
}

TEST(PlaneEstimator, FindsAPlaneDespiteEncoderStepsAndNoise) {
  const std::uint64_t cases = test::seeds(50);
  for (std::uint64_t seed = 1; seed <= cases; ++seed)
    for (const double k : {300.0, 2000.0}) {
      Slave slave{.normal = {0, 0.6, 0.8},
                  .point = {0.013, 0.004, 0},
                  .k = k,
                  .encoder = 5.5e-5,
                  .noise = 0.05,
                  .random = RandomStream{seed}};
      PlaneEstimator estimator;
      press(estimator, slave, 3, 0.5);
      ASSERT_EQ(estimator.state(), State::kKnown) << seed;
      // Stiffness felt by a hand on 400 N/m.
      const double felt = 1 / (1 / 400.0 + 1 / estimator.stiffness()), is = 1 / (1 / 400.0 + 1 / k);
      EXPECT_NEAR(felt, is, 0.05 * is) << seed;
      EXPECT_NEAR(height(slave, estimator.point()), 0, 1e-4) << seed;
    }
}

TEST(PlaneEstimator, BoundsTheStiffnessOfBone) {
  Slave slave{.k = 20000, .encoder = 5.5e-5};
  PlaneEstimator estimator;
  press(estimator, slave, 3, 0.5);
  EXPECT_EQ(estimator.state(), State::kKnown);
  EXPECT_GE(estimator.stiffness(), 5000);
  EXPECT_LE(estimator.stiffness(), PlaneEstimator::kStiffnessMax);
}

TEST(PlaneEstimator, FindsNoContactInFreeMotion) {
  for (const double hz : {0.5, 1.0}) {
    PlaneEstimator estimator;
    for (double t = 0; t < 6; t += kT) {
      const double w = 2 * std::numbers::pi * hz, at = 0.05 * std::sin(w * t), v = 0.05 * w * std::cos(w * t),
                   a = -w * w * at;
      PlaneEstimator::Sample s;
      s.x[0] = at;
      s.v[0] = v;
      s.f[0] = -(0.1 * std::copysign(1, v) + 0.2 * v + 0.1 * a);  // Coulomb, viscous, 100 g
      estimator.step(kT, s);
      ASSERT_EQ(estimator.state(), State::kFree) << hz << " Hz at " << t;
    }
  }
}

TEST(PlaneEstimator, EndsAContactWhenNothingPresses) {
  Slave slave;
  PlaneEstimator estimator;
  press(estimator, slave, 2, 1);
  ASSERT_EQ(estimator.state(), State::kKnown);
  int ticks = 0;
  while (estimator.state() != State::kFree && ticks < 1000) {
    estimator.step(kT, slave.pressing(0));
    ++ticks;
  }
  EXPECT_LE(ticks, 60);
  press(estimator, slave, 2, 1);
  EXPECT_EQ(estimator.state(), State::kKnown);
  EXPECT_EQ(estimator.touches(), 2u);
}

TEST(PlaneEstimator, FindsNoStiffnessFromAConstantForce) {
  Slave slave{.noise = 0.02};
  PlaneEstimator estimator;
  for (double t = 0; t < 3; t += kT) {
    estimator.step(kT, slave.pressing(2));
    ASSERT_NE(estimator.state(), State::kKnown) << t;
  }
  EXPECT_EQ(estimator.state(), State::kTouching);
}

TEST(PlaneEstimator, FindsNoStiffnessFromDepthsThatAreMostlyError) {
  Slave slave{.k = 5000};
  PlaneEstimator estimator;
  RandomStream random{9};
  for (double t = 0; t < 3; t += kT) {
    PlaneEstimator::Sample s = slave.pressing(1 + 0.15 * std::sin(6 * t));
    s.x[0] += random.uniform(-0.004, 0.004);
    estimator.step(kT, s);
    ASSERT_NE(estimator.state(), State::kKnown) << t << " " << estimator.uncertainty();
  }
  EXPECT_GT(estimator.uncertainty(), PlaneEstimator::kUncertaintyMax);
}

/// A sample on a plane normal to z whose force is tilted by `tilt` [rad] towards x.
PlaneEstimator::Sample tilted(Slave& slave, double force, double tilt, double slide = 0, double t = 0) {
  PlaneEstimator::Sample s = slave.pressing(force);
  s.f = {force * std::sin(tilt), 0, force * std::cos(tilt)};
  s.v[0] = slide;
  s.x[0] += slide * t;
  return s;
}

TEST(PlaneEstimator, CorrectsAWrongNormalTowardsTheForce) {
  Slave slave{.normal = {0, 0, 1}};
  PlaneEstimator estimator;
  for (double t = 0; t < 2; t += kT) estimator.step(kT, tilted(slave, std::min(2.0, 4 * t), t < 0.2 ? 0.3 : 0.0));
  EXPECT_EQ(estimator.state(), State::kKnown);
  EXPECT_NEAR(estimator.normal()[0], 0, 0.005);
}

TEST(PlaneEstimator, KeepsTheNormalUnderFriction) {
  Slave slave{.normal = {0, 0, 1}};
  PlaneEstimator estimator;
  press(estimator, slave, 2, 1);
  for (double t = 0; t < 1; t += kT) estimator.step(kT, tilted(slave, 2, -0.3, 0.05, t));
  EXPECT_EQ(estimator.state(), State::kKnown);
  EXPECT_NEAR(estimator.normal()[0], 0, 1e-6);
}

TEST(PlaneEstimator, DropsAPlaneThatContradictsNewSamples) {
  Slave slave;
  PlaneEstimator estimator;
  press(estimator, slave, 2, 1);
  ASSERT_EQ(estimator.state(), State::kKnown);
  slave.point[0] += 0.01;  // the surface yields at once
  int ticks = 0;
  while (estimator.state() == State::kKnown && ticks < 1000) {
    estimator.step(kT, slave.pressing(2));
    ++ticks;
  }
  EXPECT_LE(ticks, 50);
}

TEST(PlaneEstimator, ChangesGradually) {
  Slave slave{.k = 500, .encoder = 5.5e-5, .noise = 0.05};
  PlaneEstimator estimator;
  Vector point{};
  double most = 0;
  bool known = false;
  for (double t = 0; t < 4; t += kT) {
    estimator.step(kT, slave.pressing(1.8 - 1.2 * std::cos(3 * t)));
    if (known) most = std::max(most, std::abs(estimator.point()[0] - point[0]));
    known = estimator.state() == State::kKnown;
    point = estimator.point();
  }
  EXPECT_TRUE(known);
  EXPECT_LT(most, 2e-5) << "20 mm/s";
}

TEST(PlaneEstimator, IgnoresNonFiniteInputAndRunsWithoutHeap) {
  Slave slave;
  PlaneEstimator estimator;
  press(estimator, slave, 2, 1);
  const double k = estimator.stiffness();
  const test::AllocGuard guard;
  PlaneEstimator::Sample bad = slave.pressing(2);
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    bad.f[1] = value;
    estimator.step(kT, bad);
    estimator.step(value, slave.pressing(2));
  }
  estimator.step(0, slave.pressing(2));
  EXPECT_EQ(estimator.stiffness(), k);
  EXPECT_EQ(estimator.state(), State::kKnown);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace tandem::control
