#include "hal/drivers/falcon/falcon_kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::hal {
namespace {

Vec3 in_box(RandomStream& random) {
  return {random.uniform(-kFalconSide, kFalconSide), random.uniform(-kFalconDepth, kFalconDepth),
          random.uniform(-kFalconSide, kFalconSide)};
}

TEST(FalconKinematics, PutsZeroCountsOnTheAxis134MillimetresInFront) {
  const auto pose = falcon_forward(Vec3::Constant(kFalconZeroAngle), Vec3::Zero());
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x[0], 0, 1e-12);
  EXPECT_NEAR(kFalconOrigin - pose->x[1], 0.1346, 5e-6);
  EXPECT_NEAR(pose->x[2], 0, 1e-12);
  // 1 N towards the user needs 0.0249 N m of each leg [public numerical check].
  const Vec3 tau = pose->J.transpose() * Vec3(0, -1, 0);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(tau[i], 0.0249, 5e-5);
  EXPECT_NEAR(kFalconRadPerCount * 180 / std::numbers::pi, 0.0364347, 5e-8);
  EXPECT_NEAR(pose->J.row(1).norm() * kFalconRadPerCount, 27e-6, 1e-6);  // resolution along the axis
  EXPECT_NEAR(pose->J.row(0).norm() * kFalconRadPerCount, 52e-6, 1e-6);  // and across it
}

TEST(FalconKinematics, ClosesTheLoopOfEachLegByHand) {
  // A second method for the inverse: knee and shin in the leg's own frame, lengths checked, no derivatives.
  RandomStream random(3);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 x = in_box(random);
    const auto theta = falcon_inverse(x);
    ASSERT_TRUE(theta);
    const Vec3 p(x[0], x[2], kFalconOrigin - x[1]);
    for (int i = 0; i < 3; ++i) {
      const double phi = (105.0 - 120.0 * i) * std::numbers::pi / 180;
      const double u = p[0] * std::cos(phi) + p[1] * std::sin(phi) - 0.04;
      const double v = -p[0] * std::sin(phi) + p[1] * std::cos(phi) + 0.02309;
      const double theta3 = std::acos((v - 0.025) / 0.1025);
      const double shin = 2 * 0.01125 + 0.1025 * std::sin(theta3);
      const double knee_u = 0.06 * std::cos((*theta)[i]), knee_w = 0.06 * std::sin((*theta)[i]);
      ASSERT_NEAR(std::hypot(u + 0.01443 - knee_u, p[2] - knee_w), shin, 1e-12);
      ASSERT_GT(knee_u, u + 0.01443) << "the knee points inward";
    }
  }
}

TEST(FalconKinematics, ForwardOfInverseIsTheSamePointToANanometre) {
  RandomStream random(1);
  const std::uint64_t points = test::seeds(20'000);
  double worst_cold = 0, worst_warm = 0;
  for (std::uint64_t n = 0; n < points; ++n) {
    const Vec3 x = in_box(random);
    const auto theta = falcon_inverse(x);
    ASSERT_TRUE(theta) << x.transpose();
    const auto cold = falcon_forward(*theta, Vec3::Zero());
    const auto warm = falcon_forward(*theta, x + Vec3(5e-4, -5e-4, 5e-4));
    ASSERT_TRUE(cold && warm) << x.transpose();
    worst_cold = std::max(worst_cold, (cold->x - x).norm());
    worst_warm = std::max(worst_warm, (warm->x - x).norm());
    ASSERT_LT(cold->condition, kConditionFull);
  }
  std::printf("[ measured ] worst error cold %.2g m, warm %.2g m over the box\n", worst_cold, worst_warm);
  EXPECT_LE(worst_cold, 1e-9);
  EXPECT_LE(worst_warm, 1e-9);
}

TEST(FalconKinematics, WorksBeyondTheWorkspaceWhereverAPoseExists) {
  RandomStream random(2);
  int reached = 0, found = 0;
  double worst = 0;
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 x(random.uniform(-0.05, 0.05), kFalconOrigin - random.uniform(0.085, 0.170),
                 random.uniform(-0.05, 0.05));
    const auto pose = falcon_pose_at(x);
    if (!pose || pose->condition > 30) continue;  // nearly singular: neighbouring points have the same angles
    ++reached;
    const auto back = falcon_forward(*falcon_inverse(x), x + Vec3(1e-3, 0, 0));
    if (!back) continue;
    ++found;
    worst = std::max(worst, (back->x - x).norm());
  }
  std::printf("[ measured ] %d of 20000 reached, %d found again, worst error %.2g m\n", reached, found, worst);
  EXPECT_GT(reached, 18'000);
  EXPECT_EQ(found, reached);
  EXPECT_LE(worst, 1e-9);
}

TEST(FalconKinematics, MatchesTheNumericJacobian) {
  RandomStream random(5);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 x = in_box(random);
    const auto pose = falcon_pose_at(x);
    ASSERT_TRUE(pose);
    const double h = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step = Vec3::Zero();
      step[axis] = h;
      const Vec3 rate = (*falcon_inverse(x + step) - *falcon_inverse(x - step)) / (2 * h);
      ASSERT_LE((rate - pose->J_inv.col(axis)).norm(), 1e-6 * (1 + pose->J_inv.norm())) << x.transpose();
    }
    ASSERT_LE((pose->J * pose->J_inv - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  }
}

TEST(FalconKinematics, ConservesPowerBetweenTipAndLegs) {
  RandomStream random(6);
  for (int n = 0; n < 5000; ++n) {
    const auto pose = falcon_pose_at(in_box(random));
    ASSERT_TRUE(pose);
    const Vec3 force(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
    const Vec3 rates(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5));
    const Vec3 tau = pose->J.transpose() * force;
    EXPECT_NEAR(force.dot(pose->J * rates), tau.dot(rates), 1e-12);
  }
}

TEST(FalconKinematics, ConditionIsTheRatioOfSingularValues) {
  RandomStream random(7);
  for (int n = 0; n < 2000; ++n) {
    const auto pose = falcon_pose_at(in_box(random));
    ASSERT_TRUE(pose);
    const Eigen::Matrix3d square = pose->J.transpose() * pose->J;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(square);
    const double ratio = std::sqrt(solver.eigenvalues()[2] / solver.eigenvalues()[0]);
    ASSERT_NEAR(pose->condition, ratio, 1e-6 * ratio);
  }
}

TEST(FalconKinematics, ReturnsNothingBeyondReachAndForGarbage) {
  EXPECT_FALSE(falcon_inverse(Vec3(0, -1, 0)));
  EXPECT_FALSE(falcon_inverse(Vec3(0.3, 0, 0)));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(falcon_inverse(Vec3(nan, 0, 0)));
  EXPECT_FALSE(falcon_forward(Vec3(nan, 0, 0), Vec3::Zero()));
  EXPECT_TRUE(falcon_forward(Vec3::Constant(kFalconZeroAngle), Vec3(nan, 0, 0)));
  EXPECT_FALSE(falcon_forward(Vec3(3, 3, -3), Vec3::Zero()));
  // Any three angles: a matching pose or none; it never hangs and never returns another pose.
  RandomStream random(8);
  for (int n = 0; n < 5'000; ++n) {
    const Vec3 theta(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
    const auto pose = falcon_forward(theta, Vec3::Zero());
    if (!pose) continue;
    ASSERT_TRUE(pose->x.allFinite() && pose->J.allFinite());
    const auto back = falcon_inverse(pose->x);
    ASSERT_TRUE(back);
  }
}

TEST(FalconKinematics, FadesEffortBetweenGoodAndBadPoses) {
  EXPECT_EQ(falcon_effort_share(1), 1.0);
  EXPECT_EQ(falcon_effort_share(8), 1.0);
  EXPECT_DOUBLE_EQ(falcon_effort_share(12), 0.5);
  EXPECT_EQ(falcon_effort_share(16), 0.0);
  EXPECT_EQ(falcon_effort_share(1e9), 0.0);
  EXPECT_EQ(falcon_effort_share(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

}  // namespace
}  // namespace tandem::hal
