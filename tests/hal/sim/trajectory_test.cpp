#include "hal/sim/trajectory.h"

#include <gtest/gtest.h>

namespace tandem::hal::sim {
namespace {

TEST(Trajectory, CircleStartsAtItsCentreAtRest) {
  Trajectory c;
  c.center = {0.01, 0.02, 0.03};
  const MotionPoint p = at(c, 0.0);
  EXPECT_EQ(p.x, Vec3(0.01, 0.02, 0.03));
  EXPECT_EQ(p.v.norm(), 0.0);
  EXPECT_LT((at(c, 1e-3).x - p.x).norm(), 1e-8);
}

TEST(Trajectory, CircleHasItsRadiusAndSpeedAfterTheRamp) {
  Trajectory c;
  for (const char plane : {'x', 'y', 'z'}) {
    c.plane = plane;
    const MotionPoint p = at(c, 1.7);
    EXPECT_NEAR(p.x.norm(), 0.05, 1e-12);
    EXPECT_NEAR(p.v.norm(), 0.05 * 3.14159265358979, 1e-9);
    EXPECT_EQ(p.x[plane - 'x'], 0.0);
    EXPECT_NEAR(p.x.dot(p.v), 0.0, 1e-12);
  }
}

TEST(Trajectory, VelocityIsTheDerivative) {
  Trajectory c, w;
  w.kind = Trajectory::Kind::kWaypoints;
  w.waypoints = {{0.5, {0, 0, 0}}, {1.0, {0.05, 0, -0.02}}, {2.5, {0, 0.03, 0}}};
  for (const auto& trajectory : {c, w}) {
    for (double t = 0.01; t < 3.0; t += 0.0137) {
      const Vec3 numeric = (at(trajectory, t + 1e-5).x - at(trajectory, t - 1e-5).x) / 2e-5;
      EXPECT_LT((numeric - at(trajectory, t).v).norm(), 1e-6) << t;
    }
  }
}

TEST(Trajectory, WaypointsAreReachedAndHeld) {
  Trajectory w;
  w.kind = Trajectory::Kind::kWaypoints;
  w.waypoints = {{1.0, {0.01, 0, 0}}, {2.0, {0.03, 0, 0}}};
  EXPECT_EQ(at(w, 0.0).x[0], 0.01);
  EXPECT_NEAR(at(w, 1.5).x[0], 0.02, 1e-15);
  EXPECT_NEAR(at(w, 1.5).v[0], 1.875 * 0.02, 1e-12);
  EXPECT_EQ(at(w, 9.0).x[0], 0.03);
  EXPECT_EQ(at(w, 9.0).v[0], 0.0);
}

}  // namespace
}  // namespace tandem::hal::sim
