#include "hal/core/load_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "hal/core/device_load.h"

namespace tandem::hal {
namespace {

/// A vertical rail of one joint with weight 2 N, friction 0.3 N and damping 0.5 N s/m, moved up and down.
/// @param change  changes a reading before the calibration gets it
std::expected<DeviceLoad, std::string> moved(double speed, const std::function<void(State&, double)>& change = {}) {
  LoadCalibration calibration(1);
  State s;
  s.J(2, 0) = 1;
  for (double t = 0; t < 4; t += 0.001) {
    s.dq[0] = speed * std::sin(3 * t);
    s.tau_out[0] = 2 + (s.dq[0] > 0 ? 0.3 : -0.3) + 0.5 * s.dq[0];
    if (change) change(s, t);
    calibration.add(s);
  }
  return calibration.result();
}

void expect_refused(const std::expected<DeviceLoad, std::string>& result, const char* words) {
  ASSERT_FALSE(result.has_value());
  EXPECT_NE(result.error().find(words), std::string::npos) << result.error();
}

TEST(LoadCalibration, FindsWeightAndFrictionOfARail) {
  const auto load = moved(0.05);
  ASSERT_TRUE(load.has_value()) << load.error();
  EXPECT_NEAR(load->weight[0], 2, 1e-9);
  EXPECT_NEAR(load->friction[0], 0.3, 1e-9);
}

TEST(LoadCalibration, RefusesMotionThatIsTooSlowOrInOneDirection) {
  expect_refused(moved(0.004), "joint 1 has 0 samples in one direction and 0 in the other");
  expect_refused(moved(0.05, [](State& s, double) { s.dq[0] = std::abs(s.dq[0]); }), "back and forth");
  expect_refused(moved(0.05, [](State& s, double) { s.dq[0] = s.dq[0] > 0 ? 0.05 : -0.05; }), "at one speed only");
}

TEST(LoadCalibration, RefusesAMotionThatAHandMakes) {
  expect_refused(moved(0.05, [](State& s, double) { s.tau_out[0] = 0; }), "without a known motor effort");
  expect_refused(moved(0.05, [](State& s, double t) { s.tau_out[0] += 3 * std::sin(7 * t); }), "release the device");
}

TEST(LoadCalibration, IgnoresReadingsThatAreStaleOrNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int bad = 0;
  const auto load = moved(0.05, [&](State& s, double) {
    s.stale = ++bad % 5 == 0;
    s.J(2, 0) = bad % 7 == 0 ? nan : 1;
    if (bad % 3 == 0) s.tau_out[0] = nan;
    if (bad % 11 == 0) s.dq[0] = std::numeric_limits<double>::infinity();
  });
  ASSERT_TRUE(load.has_value()) << load.error();
  EXPECT_NEAR(load->weight[0], 2, 1e-9);
  EXPECT_NEAR(load->friction[0], 0.3, 1e-9);
  expect_refused(moved(0.05, [&](State& s, double) { s.tau_out[0] = nan; }), "has 0 samples");
}

TEST(LoadCalibration, GivesNoWeightToAJointThatDoesNotLiftTheTip) {
  const auto load = moved(0.05, [](State& s, double) {
    s.J(2, 0) = 0;
    s.J(0, 0) = 1;
    s.tau_out[0] -= 2;
  });
  ASSERT_TRUE(load.has_value()) << load.error();
  EXPECT_EQ(load->weight[0], 0);
  EXPECT_NEAR(load->friction[0], 0.3, 1e-9);
}

TEST(FrictionEffort, OpposesMotionAndNeverExceedsTheFriction) {
  const DeviceLoad load{.weight = {2}, .friction = {0.3}};
  State s;
  s.J(2, 0) = 1;
  for (const double v : {-1.0, -0.01, 0.0, 0.001, 0.1}) {
    s.dq[0] = v;
    const double effort = friction_effort(load, s, 1)[0];
    EXPECT_GE(effort * v, 0);
    EXPECT_LE(std::abs(effort), 0.3);
  }
  EXPECT_EQ(weight_effort(load, s, 1)[0], 2);
}

}  // namespace
}  // namespace tandem::hal
