// Numerics of a simulated device: orders of convergence and closed forms of one axis, the arm against its built-in
// scheme and its energy, both precisions, surfaces, and any input.
#include "hal/sim/integrated_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "common/control/numerics.h"
#include "hal/sim/linear_plant.h"
#include "hal/sim/sim_device.h"
#include "hal/sim/touch_plant.h"

namespace tandem::hal::sim {
namespace {

using Linear = IntegratedPlant<LinearDynamics>;
using Touch = IntegratedPlant<TouchDynamics>;
using enum IntegratorKind;
constexpr std::array kAll{kImplicitEuler, kImplicitMidpoint, kSemiImplicitEuler, kRk4, kExact};
const std::string& name_of(IntegratorKind how) {
  static const std::array<std::string, 5> names = [] {
    std::array<std::string, 5> out;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = control::kIntegratorNames[i];
    return out;
  }();
  return names[static_cast<std::size_t>(how)];
}

SimDeviceSpec rail(double damping = 0, double friction = 0) {
  SimDeviceSpec s;
  s.model = DeviceModel::kLinear;
  s.mass = 0.1;
  s.damping = damping;
  s.friction = friction;
  return s;
}
Linear linear(const SimDeviceSpec& spec, const NumericsSpec& numerics, const EnvironmentSpec& surfaces = {}) {
  return {{spec, surfaces, Vec3::Zero()}, numerics, Linear::Q::Zero()};
}
HandPull spring(double k, double b = 0) {
  HandPull hand;
  hand.k = k;
  hand.b = b;
  return hand;
}

/// Error of the position [m] after 0.1 s: 0.1 kg with viscous friction, on a spring, released at 10 mm with 0.1 m/s.
double error_of(IntegratorKind how, std::uint32_t substeps, PrecisionKind precision = PrecisionKind::kDouble) {
  constexpr double kM = 0.1, kK = 90, kB = 1.2, kT = 0.1, kX = 0.01, kV = 0.1;
  Linear plant = linear(rail(kB), {how, precision, substeps});
  plant.set(Linear::Q(kX), Linear::Q(kV));
  for (int i = 0; i < 20; ++i) plant.advance(Vec3::Zero(), spring(kK), kT / 20);
  const double decay = kB / (2 * kM), w = std::sqrt(kK / kM - decay * decay);
  const double closed = std::exp(-decay * kT) * (kX * std::cos(w * kT) + (kV + decay * kX) / w * std::sin(w * kT));
  return std::abs(plant.tip()[0] - closed);
}
double order_of(IntegratorKind how, std::uint32_t substeps) {
  return std::log2(error_of(how, substeps) / error_of(how, 2 * substeps));
}

TEST(IntegratedPlant, ConvergesWithTheOrderOfItsIntegrator) {
  EXPECT_NEAR(order_of(kImplicitEuler, 32), 1, 0.05);
  EXPECT_NEAR(order_of(kSemiImplicitEuler, 32), 1, 0.05);
  EXPECT_NEAR(order_of(kImplicitMidpoint, 4), 2, 0.05);
  EXPECT_NEAR(order_of(kRk4, 4), 4, 0.15);
}

TEST(IntegratedPlant, IsExactForViscousFrictionAndASpring) {
  for (const std::uint32_t substeps : {1U, 3U, 64U}) EXPECT_LT(error_of(kExact, substeps), 1e-15) << substeps;
  EXPECT_LT(error_of(kExact, 1, PrecisionKind::kFloat), 2e-8);
  EXPECT_GT(error_of(kExact, 1, PrecisionKind::kFloat), 1e-12) << "a step in float rounds";
}

TEST(IntegratedPlant, ReachesTheSpeedOfForceOverDamping) {  // v = F / b (1 - exp(-b t / m)), at t = m / b
  for (const IntegratorKind how : kAll) {
    Linear plant = linear(rail(2), {how, PrecisionKind::kDouble, 16});
    for (int i = 0; i < 50; ++i) plant.advance({0.4, 0, 0}, {}, 1e-3);
    EXPECT_NEAR(plant.dq()[0], 0.2 * (1 - std::exp(-1.0)), 1e-4) << name_of(how);
    EXPECT_EQ(plant.tip()[1], 0);
  }
}

TEST(IntegratedPlant, FollowsAHandInMotionWithoutLosingItsPosition) {  // at constant speed the lag is b v / k
  for (const IntegratorKind how : kAll) {
    Linear plant = linear(rail(1), {how, PrecisionKind::kDouble, 2});
    HandPull hand = spring(200, 5);
    hand.v[0] = 0.05;
    for (int i = 0; i < 2000; ++i) {
      hand.x[0] = 0.05 * (i + 0.5) * 1e-3;
      plant.advance(Vec3::Zero(), hand, 1e-3);
    }
    EXPECT_NEAR(plant.tip()[0], 0.1 - 0.05 / 200, 2e-8) << name_of(how);
    EXPECT_NEAR(plant.hand_force()[0], 0.05, 5e-5) << name_of(how);
  }
}

TEST(IntegratedPlant, RestsInAWallAtForceOverStiffness) {
  EnvironmentSpec surfaces;
  surfaces.wall = WallSpec{0, 0.0, 2000, 5.0, true};
  for (const IntegratorKind how : kAll) {
    for (const PrecisionKind precision : {PrecisionKind::kDouble, PrecisionKind::kFloat}) {
      Linear plant = linear(rail(1), {how, precision, 4}, surfaces);
      for (int i = 0; i < 3000; ++i) plant.advance({2, 0, 0}, {}, 1e-3);
      EXPECT_NEAR(plant.penetration(), 1e-3, 1e-6) << name_of(how);
      EXPECT_NEAR(plant.environment_force()[0], -2, 1e-3) << name_of(how);
    }
  }
}

TEST(IntegratedPlant, ImplicitStepsGainNoEnergyInABounceAtAnyStiffness) {
  for (double k = 1e-2; k <= 1e8; k *= 10) {
    EnvironmentSpec surfaces;
    surfaces.wall = WallSpec{0, 0.0, k, 0.0, true};
    Linear plant = linear(rail(), {kImplicitEuler, PrecisionKind::kDouble, 1}, surfaces);
    plant.set(Linear::Q(-0.01003), Linear::Q(0.5));
    for (int i = 0; i < 2000; ++i) plant.advance(Vec3::Zero(), {}, 1e-3);
    EXPECT_LE(std::abs(plant.dq()[0]), 0.5 * (1 + 1e-9)) << k;
  }
}

TEST(IntegratedPlant, FrictionHoldsAgainstLessThanItself) {
  for (const IntegratorKind how : {kImplicitEuler, kImplicitMidpoint, kExact}) {
    Linear plant = linear(rail(0, 0.26), {how, PrecisionKind::kDouble, 4});
    for (int i = 0; i < 1000; ++i) plant.advance({0.13, 0, 0}, {}, 1e-3);
    EXPECT_LT(std::abs(plant.dq()[0]), 1e-3) << name_of(how);
    for (int i = 0; i < 100; ++i) plant.advance({0.52, 0, 0}, {}, 1e-3);
    EXPECT_NEAR(plant.dq()[0], 0.26, 0.01) << name_of(how) << ": (0.52 - 0.26) N / 0.1 kg for 0.1 s";
  }
}

SimDeviceSpec arm() {
  SimDeviceSpec s;
  s.friction = 0;
  s.damping = 0;
  s.gravity = true;
  return s;
}
const Vec3 kPose(0.1, 0.742, 0.553), kRate(0.8, -0.5, 1.1);

/// Joints after 0.1 s of free fall with viscous friction under a spring at the tip.
Vec3 fallen(IntegratorKind how, std::uint32_t substeps, PrecisionKind precision = PrecisionKind::kDouble) {
  SimDeviceSpec spec = arm();
  spec.damping = 0.5;
  Touch plant({spec, {}}, {how, precision, substeps}, kPose);
  plant.set(kPose, kRate);
  for (int i = 0; i < 100; ++i) plant.advance(Vec3::Zero(), spring(50), 1e-3);
  return plant.q();
}
double arm_order(IntegratorKind how, std::uint32_t substeps) {
  const Vec3 truth = fallen(kRk4, 64);
  return std::log2((fallen(how, substeps) - truth).norm() / (fallen(how, 2 * substeps) - truth).norm());
}

TEST(IntegratedPlant, TheArmConvergesToo) {
  EXPECT_NEAR(arm_order(kImplicitEuler, 4), 1, 0.1);
  EXPECT_NEAR(arm_order(kSemiImplicitEuler, 4), 1, 0.1);
  EXPECT_NEAR(arm_order(kImplicitMidpoint, 1), 2, 0.1);
  EXPECT_NEAR(arm_order(kRk4, 1), 4, 0.3);
  EXPECT_GE(arm_order(kExact, 2), 0.9) << "Coriolis forces and gravity are held within a step";
}

TEST(IntegratedPlant, TheArmAgreesWithItsBuiltInScheme) {
  SimDeviceSpec spec = arm();
  spec.damping = 0.5;
  TouchPlant built_in(spec, {}, kPose);
  built_in.set(kPose, kRate);
  for (int i = 0; i < 1600; ++i) built_in.advance(Vec3::Zero(), spring(50), 1e-3 / 16);
  const Vec3 truth = fallen(kRk4, 16);
  EXPECT_LT((built_in.q() - truth).norm(), 1e-4);
  EXPECT_GT((truth - kPose).norm(), 0.02) << "it moves";
  for (const IntegratorKind how : kAll) EXPECT_LT((fallen(how, 16) - truth).norm(), 1e-3) << name_of(how);
  EXPECT_LT((fallen(kImplicitMidpoint, 4, PrecisionKind::kFloat) - fallen(kImplicitMidpoint, 4)).norm(), 1e-4);
}

TEST(IntegratedPlant, TheArmKeepsItsEnergyWithoutFriction) {
  const auto energy = [](const Vec3& q, const Vec3& dq) {
    TouchPlant meter(arm(), {}, q);
    meter.set(q, dq);
    return meter.kinetic_energy() + meter.potential_energy();
  };
  for (const IntegratorKind how : {kImplicitMidpoint, kRk4}) {
    Touch plant({arm(), {}}, {how, PrecisionKind::kDouble, 16}, kPose);
    plant.set(kPose, kRate);
    const double start = energy(kPose, kRate);
    for (int i = 0; i < 60; ++i) plant.advance(Vec3::Zero(), {}, 1e-3);
    EXPECT_NEAR(energy(plant.q(), plant.dq()), start, 1e-6) << name_of(how);
  }
}

TEST(IntegratedPlant, StaysFiniteForEveryInput) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  EnvironmentSpec surfaces;
  surfaces.wall = WallSpec{0, 0.001, 1e6, 10.0, true};
  for (const IntegratorKind how : kAll) {
    for (const PrecisionKind precision : {PrecisionKind::kDouble, PrecisionKind::kFloat}) {
      Linear one = linear(rail(0.1), {how, precision, 1}, surfaces);
      Touch three({arm(), surfaces}, {how, precision, 1}, kPose);
      for (const double value : {1e300, kNan, -kInf, 5e-324, -0.0, -1e9}) {
        HandPull hand = spring(1e5, 1e3);
        hand.x.fill(value);
        hand.force.fill(-value);
        one.advance({value, value, value}, hand, 1e-3);
        three.advance({value, value, value}, hand, 1e-3);
        for (const double dt : {0.0, kNan, 0.1, 10.0}) {
          one.advance(Vec3::Zero(), spring(value), dt);
          three.advance(Vec3::Zero(), spring(value), dt);
        }
        EXPECT_TRUE(one.q().allFinite() && one.dq().allFinite() && one.environment_force().allFinite());
        EXPECT_TRUE(three.q().allFinite() && three.dq().allFinite() && three.environment_force().allFinite())
            << name_of(how) << " " << value;
      }
    }
  }
}

TEST(SimDeviceNumerics, StepTheDeviceAndKeepItsCapabilities) {
  for (const DeviceModel model : {DeviceModel::kLinear, DeviceModel::kTouch}) {
    SimSetup setup;
    setup.device = model == DeviceModel::kLinear ? rail(1) : arm();
    const auto built_in = SimDevice::make(setup);
    setup.device.numerics = NumericsSpec{.integrator = kRk4, .substeps = 4};
    const auto chosen = SimDevice::make(setup);
    ASSERT_TRUE(built_in && chosen);
    EXPECT_EQ((*chosen)->caps().joints, (*built_in)->caps().joints);
    EXPECT_EQ((*chosen)->caps().mass, (*built_in)->caps().mass);
    EXPECT_EQ((*chosen)->caps().gravity, (*built_in)->caps().gravity);
    for (int i = 0; i < 200; ++i) {
      (*built_in)->advance({}, std::chrono::milliseconds(1));
      (*chosen)->advance({}, std::chrono::milliseconds(1));
    }
    EXPECT_LT(((*chosen)->ground_truth().x - (*built_in)->ground_truth().x).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace tandem::hal::sim
