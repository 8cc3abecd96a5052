#include "hal/sim/touch_kinematics.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/base/rng.h"
#include "hal/sim/touch_plant.h"

namespace tandem::hal::sim {
namespace {

Vec3 somewhere(RandomStream& r) { return {r.uniform(-0.08, 0.08), r.uniform(-0.06, 0.06), r.uniform(-0.06, 0.06)}; }

TEST(TouchKinematics, MatchesTheHandComputedWorkingPose) {
  const auto q = touch_inverse(Vec3::Zero());
  ASSERT_TRUE(q.has_value());
  EXPECT_NEAR((*q)[0], 0.0, 1e-15);
  EXPECT_NEAR((*q)[1], 0.742, 1e-3);
  EXPECT_NEAR((*q)[2], 0.553, 1e-3);
}

TEST(TouchKinematics, UsesTheFramesOfTheHal) {
  const auto q = touch_inverse(Vec3::Zero());
  // A positive rotation of joint 1 (left) moves the tip to -x. Raising link 1 moves it up (+z) and towards the base
  // (+y).
  const Eigen::Matrix3d j = TouchPose(*q).jacobian();
  EXPECT_LT(j(0, 0), 0.0);
  EXPECT_GT(j(2, 1), 0.0);
  EXPECT_GT(j(1, 1), 0.0);
  // HAL y points away from the user, the vendor's z towards the user: more rho is more vendor z and less HAL y.
  EXPECT_NEAR(TouchPose({0.0, 0.0, 0.0}).tip()[1], 0.16835 - 0.13335, 1e-15);
  EXPECT_NEAR(TouchPose({0.0, 0.0, 0.0}).tip()[2], -0.13335 + 0.02335, 1e-15);
}

TEST(TouchKinematics, ForwardUndoesInverseOverTheWorkspace) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r(seed);
    const Vec3 x = somewhere(r);
    const auto q = touch_inverse(x);
    ASSERT_TRUE(q.has_value());
    EXPECT_LT((TouchPose(*q).tip() - x).norm(), 1e-9);
    EXPECT_TRUE(TouchPlant::within_stops(*q));
    EXPECT_GT((*q)[1], (*q)[2] - 1.5707963267948966) << "elbow down";
  }
}

TEST(TouchKinematics, JacobianIsTheDerivative) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r(seed);
    const Vec3 q = *touch_inverse(somewhere(r));
    const Eigen::Matrix3d j = TouchPose(q).jacobian();
    for (int i = 0; i < 3; ++i) {
      Vec3 d = Vec3::Zero();
      d[i] = 1e-5;
      const Vec3 numeric = (TouchPose(q + d).tip() - TouchPose(q - d).tip()) / 2e-5;
      EXPECT_LT((numeric - j.col(i)).norm(), 1e-9);
    }
  }
}

TEST(TouchKinematics, ShortFormsEqualTheMatrix) {
  RandomStream r(3);
  for (int i = 0; i < 50; ++i) {
    const TouchPose p(*touch_inverse(somewhere(r)));
    const Vec3 dq(r.uniform(-3, 3), r.uniform(-3, 3), r.uniform(-3, 3)),
        f(r.uniform(-3, 3), r.uniform(-3, 3), r.uniform(-3, 3));
    EXPECT_LT((p.tip_velocity(dq) - p.jacobian() * dq).norm(), 1e-14);
    EXPECT_LT((p.joint_effort(f) - p.jacobian().transpose() * f).norm(), 1e-14);
    EXPECT_NEAR(f.dot(p.tip_velocity(dq)), p.joint_effort(f).dot(dq), 1e-12);
  }
}

TEST(TouchKinematics, ReturnsNothingOutOfReach) {
  EXPECT_FALSE(touch_inverse({0.3, 0.0, 0.0}).has_value());
  EXPECT_FALSE(touch_inverse({0.0, kTouchW, 0.1}).has_value()) << "on the axis of joint 1";
  EXPECT_FALSE(touch_inverse({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}).has_value());
  EXPECT_FALSE(touch_inverse({std::numeric_limits<double>::infinity(), 0.0, 0.0}).has_value());
}

}  // namespace
}  // namespace tandem::hal::sim
