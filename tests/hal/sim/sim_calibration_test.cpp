#include "hal/sim/sim_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::hal::sim {
namespace {

/// Largest error of an estimate, as a share.
constexpr double kErrorMax = 0.2;
constexpr double kG = 9.81;

/// Weights of the simulated Touch without load [N]: its gravity torques per vertical lever.
const Vec3 kWeights{0, (0.04 * 0.0443 + 0.08 * kTouchL1) * kG / kTouchL1, 0.08 * 0.1108 * kG / kTouchL2};

SimSetup touch(double friction, double load, const Point& start = {}) {
  SimSetup setup;
  setup.device.friction = friction;
  setup.device.load = load;
  setup.device.start = start;
  return setup;
}

void expect_estimate(const SimSetup& setup, const SlowMotion& motion) {
  const auto load = calibrate_load(setup, motion);
  ASSERT_TRUE(load.has_value()) << load.error().message;
  const Vec3 friction = TouchPlant::joint_friction(setup.device.friction);
  for (std::size_t j = 0; j < 3; ++j) {
    const auto e = static_cast<Eigen::Index>(j);
    const double weight = j == 0 ? 0 : kWeights[e] + kG * setup.device.load;
    EXPECT_NEAR(load->friction[j], friction[e], kErrorMax * friction[e]) << "joint " << j + 1;
    EXPECT_NEAR(load->weight[j], weight, kErrorMax * weight) << "joint " << j + 1;
    if (j > 0 && setup.device.load >= 0.05) {
      EXPECT_NEAR((load->weight[j] - kWeights[e]) / kG, setup.device.load, kErrorMax * setup.device.load)
          << "unknown load at joint " << j + 1;
    }
  }
}

TEST(SimCalibration, FindsFrictionAndAnUnknownLoadOfATouch) {
  for (const double friction : {0.1, 0.3, 0.5})
    for (const double load : {0.0, 0.1, 0.2}) {
      SCOPED_TRACE(std::to_string(friction) + " N, " + std::to_string(load) + " kg");
      expect_estimate(touch(friction, load), {});
    }
}

TEST(SimCalibration, FindsThemFromDrawnPosesWithEveryMotion) {
  for (std::uint64_t seed = 1, last = test::seeds(3); seed <= last; ++seed) {
    RandomStream r(seed);
    for (const SlowMotion& motion : {SlowMotion{}, SlowMotion{.amplitude = 0.015, .frequency = 0.4, .length = 8},
                                     SlowMotion{.amplitude = 0.03, .frequency = 0.15, .length = 14}}) {
      const double friction = r.uniform(0.1, 0.5), load = r.uniform(0, 0.2);
      const Point start{r.uniform(-0.02, 0.02), r.uniform(-0.02, 0.02), r.uniform(-0.02, 0.02)};
      SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(motion.frequency) + " Hz, " +
                   std::to_string(friction) + " N, " + std::to_string(load) + " kg");
      expect_estimate(touch(friction, load, start), motion);
    }
  }
}

TEST(SimCalibration, RefusesMotorsThatCannotLiftTheLoad) {
  SimSetup weak = touch(0.1, 0.4);
  weak.device.calibrate = true;
  const auto device = SimDevice::make(weak);
  ASSERT_FALSE(device.has_value());
  EXPECT_NE(device.error().message.find("calibration of its weight failed: joint"), std::string::npos)
      << device.error().message;
}

TEST(SimCalibration, MeasuresTheFrictionOfARail) {
  SimSetup rail = touch(0.2, 0.1);
  rail.device.model = DeviceModel::kLinear;
  const auto load = calibrate_load(rail);
  ASSERT_TRUE(load.has_value()) << load.error().message;
  EXPECT_NEAR(load->friction[0], 0.2, kErrorMax * 0.2);
  EXPECT_EQ(load->weight[0], 0);
}

/// Returns how far a released device with a load falls within 0.5 s [m].
double fall(bool compensate, bool calibrate) {
  SimSetup setup = touch(0.05, 0.15);
  setup.device.gravity_compensation = compensate;
  setup.device.calibrate = calibrate;
  auto device = SimDevice::make(setup);
  EXPECT_TRUE(device.has_value());
  for (int tick = 0; tick < 500; ++tick) (*device)->advance({}, std::chrono::milliseconds(1));
  return -(*device)->ground_truth().x[2];
}

TEST(SimCalibration, LetsTheCompensationHoldAnUnknownLoad) {
  EXPECT_GT(fall(true, false), 0.02) << "the built-in model does not contain the load";
  EXPECT_GT(fall(false, true), 0.02) << "calibrated, and switched off";
  EXPECT_LT(fall(true, true), 0.001);
}

}  // namespace
}  // namespace tandem::hal::sim
