#include "hal/drivers/falcon/falcon_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "hal/drivers/falcon/falcon_frame.h"
#include "hal/drivers/falcon/falcon_kinematics.h"

namespace tandem::hal {
namespace {

FalconForce scaled(double counts_per_nm) {
  FalconSpec spec;
  spec.counts_per_nm = {counts_per_nm, counts_per_nm, counts_per_nm};
  return *FalconForce::from(spec);
}

TEST(FalconForce, HasTheSignAndScaleOfTheMotors) {
  const auto sent = scaled(10000).counts_for(Vec3(0.1, -0.05, 0));
  EXPECT_EQ(sent.motor, (std::array<std::int16_t, 3>{-1000, 500, 0}));
  EXPECT_FALSE(sent.saturated);
  EXPECT_NEAR((sent.tau - Vec3(0.1, -0.05, 0)).norm(), 0, 1e-15);
}

TEST(FalconForce, ReportsTheForceOfTheIntegers) {
  const auto sent = scaled(10000).counts_for(Vec3(0.00014, 0.00016, 0));
  EXPECT_EQ(sent.motor, (std::array<std::int16_t, 3>{-1, -2, 0}));
  EXPECT_DOUBLE_EQ(sent.tau[0], 0.0001);
  EXPECT_DOUBLE_EQ(sent.tau[1], 0.0002);
}

TEST(FalconForce, ClampsBeforeRoundingAndKeepsTheDirection) {
  // 30 N m times 10000 would wrap to -27680 in 16 bits.
  const auto sent = scaled(10000).counts_for(Vec3(30, 15, -30));
  EXPECT_EQ(sent.motor, (std::array<std::int16_t, 3>{-4095, -2048, 4095}));
  EXPECT_TRUE(sent.saturated);
  EXPECT_NEAR(sent.tau[1] / sent.tau[0], 0.5, 1e-3);
}

TEST(FalconForce, NeverExceedsItsCeilingForAnyInput) {
  const double huge = std::numeric_limits<double>::max(), inf = std::numeric_limits<double>::infinity();
  RandomStream random(11);
  for (const FalconForce& force : {FalconForce{}, scaled(500), scaled(100000)}) {
    const int ceiling = force.calibrated() ? kFalconMotorMax : kFalconCeilingGuess;
    for (int n = 0; n < 20000; ++n) {
      const double size = std::pow(10, random.uniform(-6, 300));
      const Vec3 tau(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
      for (const std::int16_t c : force.counts_for(tau).motor) ASSERT_LE(std::abs(c), ceiling);
    }
    for (const Vec3& tau : {Vec3(huge, -huge, huge), Vec3(huge, 1e-300, 0)}) {
      for (const std::int16_t c : force.counts_for(tau).motor) ASSERT_LE(std::abs(c), ceiling);
    }
    for (const double bad : {inf, -inf, std::nan("")}) {
      const auto sent = force.counts_for(Vec3(0.1, bad, 0.1));
      EXPECT_EQ(sent.motor, (std::array<std::int16_t, 3>{}));
      EXPECT_TRUE(sent.saturated);
    }
  }
}

TEST(FalconForce, GivesLittleForceWhileUncalibrated) {
  const FalconForce guess;
  EXPECT_FALSE(guess.calibrated());
  // The strongest public value is 57 counts per unit of force and motor along the axis, at 0.0249 N m per N.
  const double strongest = 57 / 0.0249;
  const auto pose = falcon_forward(Vec3::Constant(kFalconZeroAngle), Vec3::Zero());
  for (const double wanted : {0.1, 1.0, 100.0}) {
    const auto sent = guess.counts_for(pose->J.transpose() * Vec3(0, -wanted, 0));
    const Vec3 real = pose->J_inv.transpose() * Vec3(-sent.motor[0], -sent.motor[1], -sent.motor[2]) / strongest;
    EXPECT_LE(real.norm(), wanted);
    EXPECT_LE(real.norm(), 2.2);
  }
}

/// Returns readings of a device with these scales, held against a mass at some poses.
std::vector<FalconMassReading> readings_of(const std::array<double, 3>& scale, double noise = 0) {
  std::vector<FalconMassReading> readings;
  RandomStream random(21);
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.01, 0.01, 0), Vec3(-0.01, 0, 0.01), Vec3(0, -0.01, -0.01)}) {
    for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 1, 0)}) {  // upright, and lying on its back
      FalconMassReading r{
          .mass = 0.2, .up = {up[0], up[1], up[2]}, .encoder = {}, .motor_without = {40, -20, 10}, .motor_with = {}};
      const Vec3 theta = *falcon_inverse(x);
      const Vec3 tau = falcon_pose_at(x)->J.transpose() * (0.2 * 9.80665 * up);
      for (std::size_t i = 0; i < 3; ++i) {
        const int k = static_cast<int>(i);
        r.encoder[i] = (theta[k] - kFalconZeroAngle) / kFalconRadPerCount;
        r.motor_with[i] = r.motor_without[i] - tau[k] * scale[i] * (1 + random.uniform(-noise, noise));
      }
      readings.push_back(r);
    }
  }
  return readings;
}

TEST(FalconScaleFit, FindsEachMotorsScaleFromKnownMasses) {
  const std::array<double, 3> truth{9000, 10000, 12000};
  const auto exact = fit_falcon_scale(readings_of(truth));
  ASSERT_TRUE(exact) << exact.error().text;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*exact)[i], truth[i], 1e-6 * truth[i]);
  const auto noisy = fit_falcon_scale(readings_of(truth, 0.05));
  ASSERT_TRUE(noisy) << noisy.error().text;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*noisy)[i], truth[i], 0.03 * truth[i]);
  FalconSpec spec;
  spec.readings = readings_of(truth);
  const auto force = FalconForce::from(spec);
  ASSERT_TRUE(force);
  EXPECT_TRUE(force->calibrated());
}

TEST(FalconScaleFit, RefusesReadingsThatContradictThemselves) {
  const std::array<double, 3> truth{10000, 10000, 10000};
  auto readings = readings_of(truth);
  EXPECT_NE(fit_falcon_scale({readings[0]}).error().text.find("two"), std::string::npos);
  readings[3].motor_with[1] = readings[3].motor_without[1] + 5000;
  const auto contradiction = fit_falcon_scale(readings);
  ASSERT_FALSE(contradiction);
  EXPECT_NE(contradiction.error().text.find("apart"), std::string::npos) << contradiction.error().text;
  readings = readings_of(truth);
  for (auto& r : readings) r.up = {-r.up[0], -r.up[1], -r.up[2]};
  EXPECT_NE(fit_falcon_scale(readings).error().text.find("against gravity"), std::string::npos);
  readings = readings_of(truth);
  for (auto& r : readings) r.mass = 0.001;
  EXPECT_NE(fit_falcon_scale(readings).error().text.find("larger mass"), std::string::npos);
  readings = readings_of(truth);
  readings[1].encoder = {8000, -8000, 8000};
  EXPECT_NE(fit_falcon_scale(readings).error().text.find("no pose"), std::string::npos);
}

}  // namespace
}  // namespace tandem::hal
