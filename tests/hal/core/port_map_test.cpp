#include "hal/core/port_map.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/base/rng.h"
#include "hal/sim/touch_kinematics.h"

namespace tandem::hal {
namespace {

State pose(const Vec3& q, const Vec3& dq = Vec3::Zero()) {
  State s;
  const sim::TouchPose p(q);
  for (std::size_t i = 0; i < 3; ++i) s.q[i] = q[static_cast<int>(i)], s.dq[i] = dq[static_cast<int>(i)];
  s.x = p.tip();
  s.dx = p.jacobian() * dq;
  s.J.leftCols<3>() = p.jacobian();
  return s;
}

const Vec3 kWorking(0.0, 0.742, 0.553);

double dot(const AxisArray& a, const AxisArray& b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return s;
}

TEST(PortMap, PowerIsTheSameOnBothSides) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r(seed);
    const Vec3 q(r.uniform(-0.5, 0.5), r.uniform(0.2, 1.2), r.uniform(0.2, 1.2)),
        dq(r.uniform(-2, 2), r.uniform(-2, 2), r.uniform(-2, 2));
    const State s = pose(q, dq);
    for (const auto space : {PortSpace::kTip, PortSpace::kJoint}) {
      const PortMap map(space, 3, 3);
      const AxisArray effort{r.uniform(-3, 3), r.uniform(-3, 3), r.uniform(-3, 3)};
      const double port = dot(effort, map.velocity(s));
      EXPECT_NEAR(port, dot(map.joint_effort(s, effort), s.dq), 1e-12);
      EXPECT_NEAR(port, map.tip_force(s, effort).dot(s.dx), 1e-9);
    }
  }
}

TEST(PortMap, TipForceAndEffortAreInverse) {
  const State s = pose(kWorking);
  const PortMap map(PortSpace::kJoint, 3, 3);
  const Vec3 force(1.0, -2.0, 0.5);
  EXPECT_LT((map.tip_force(s, map.effort(s, force)) - force).norm(), 1e-12);
}

TEST(PortMap, ScaleIsTheSquaredLever) {
  const State s = pose(kWorking);
  const AxisArray scale = PortMap(PortSpace::kJoint, 3, 3).scale(s);
  const double rho = sim::TouchPose(kWorking).rho;
  EXPECT_NEAR(scale[0], rho * rho, 1e-15);
  EXPECT_NEAR(scale[1], 0.13335 * 0.13335, 1e-15);
  EXPECT_NEAR(scale[2], 0.13335 * 0.13335, 1e-15);
  const AxisArray tip = PortMap(PortSpace::kTip, 3, 3).scale(s);
  EXPECT_EQ(tip[0], 1.0);
  EXPECT_EQ(tip[2], 1.0);
  EXPECT_EQ(tip[3], 0.0);
}

TEST(PortMap, AxesBeyondTheDofStayZero) {
  const State s = pose(kWorking, {1, 1, 1});
  const PortMap map(PortSpace::kTip, 1, 3);
  const AxisArray effort{1.0, 5.0, 5.0};
  EXPECT_EQ(map.tip_force(s, effort), Vec3(1, 0, 0));
  EXPECT_EQ(map.velocity(s)[1], 0.0);
  EXPECT_EQ(PortMap(PortSpace::kTip, 7, 3).dof(), 3u);
  EXPECT_EQ(PortMap(PortSpace::kJoint, 7, 1).dof(), 1u);
}

TEST(PortMap, OneAxisDeviceIsItsOwnTip) {
  State s;
  s.q[0] = s.x[0] = 0.02;
  s.J(0, 0) = 1.0;
  const PortMap joint(PortSpace::kJoint, 1, 1), tip(PortSpace::kTip, 1, 1);
  EXPECT_EQ(joint.position(s)[0], tip.position(s)[0]);
  EXPECT_EQ(joint.scale(s)[0], 1.0);
  EXPECT_EQ(tip.joint_effort(s, {2.0})[0], 2.0);
  EXPECT_NEAR(joint.tip_force(s, {2.0})[0], 2.0, 1e-15);
}

TEST(SolveTipForce, StaysWithinReasonAtASingularPose) {
  // Stretched arm: q3 - q2 = 90 degrees; every pose up to it is tested.
  double largest = 0;
  for (double gap = 0.3; gap >= -0.3; gap -= 1e-3) {
    const State s = pose({0.0, 0.2, 0.2 + 1.5707963267948966 - gap});
    for (int axis = 0; axis < 3; ++axis) {
      AxisArray tau{};
      tau[static_cast<std::size_t>(axis)] = 1.0;
      const Vec3 f = solve_tip_force(s.J, tau, 3);
      ASSERT_TRUE(f.allFinite());
      largest = std::max(largest, f.norm() * 0.13335);
    }
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(largest, 20.0);
}

TEST(SolveTipForce, IsTotal) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const State s = pose(kWorking);
  EXPECT_EQ(solve_tip_force(s.J, {nan, inf, 0.0}, 3), Vec3(0, 0, 0));
  EXPECT_EQ(solve_tip_force(Jacobian::Zero(), {1.0, 1.0, 1.0}, 3), Vec3(0, 0, 0));
  EXPECT_EQ(solve_tip_force(s.J, {1.0}, 0), Vec3(0, 0, 0));
  Jacobian broken = s.J;
  broken(0, 0) = nan;
  EXPECT_TRUE(solve_tip_force(broken, {1.0, 1.0, 1.0}, 3).allFinite());
}

TEST(SolveTipForce, RedundantJointsGiveLeastSquares) {
  RandomStream r(4);
  Jacobian J;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 7; ++j) J(i, j) = r.uniform(-0.5, 0.5);
  }
  const Vec3 force(0.3, -1.0, 2.0);
  AxisArray tau{};
  for (int j = 0; j < 7; ++j) tau[static_cast<std::size_t>(j)] = J.col(j).dot(force);
  EXPECT_LT((solve_tip_force(J, tau, 7) - force).norm(), 1e-12);
}

}  // namespace
}  // namespace tandem::hal
