// Whole sessions at extreme shares, delays and poses. tests/EXTREMES.md lists what was tried.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "proto/text/scene_text.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

/// Both hands move and share the tool, for a short time.
SceneSpec shared(double first) {
  SceneSpec scene = test::shipped("free_motion");
  scene.timeline.clear();
  scene.phases.clear();
  scene.duration = 3;
  scene.seats[1].hand.from = 0;
  for (SeatSpec& seat : scene.seats) seat.hand.deviations.clear();
  AuthorityRow row;
  row.alpha[0] = first;
  row.alpha[1] = 1 - first;
  scene.authority = {row};
  return scene;
}

void expect_quiet(const test::RunResult& run) {
  EXPECT_EQ(run.trouble, "");
  for (const auto& v : run.report.violations) EXPECT_TRUE(v.expected) << v.invariant << " at " << v.seat;
  EXPECT_LE(run.hand_speed_max, 1.0);
  EXPECT_LE(run.authority_error_max, 1e-12);
  EXPECT_TRUE(std::isfinite(run.force_step_max));
}

TEST(ExtremesOfSessions, KeepTheirInvariantsAtAnyShareOfAuthority) {
  for (const double share : {0.0, 5e-324, 1e-12, 0.5, 1 - 1e-12, 1.0}) {
    SCOPED_TRACE(share);
    expect_quiet(test::run(shared(share), test::delayed(20)));
  }
}

TEST(ExtremesOfSessions, GiveNoForceOverARoundTripOf10Seconds) {
  SceneSpec scene = shared(1);
  const test::RunResult run = test::run(scene, test::delayed(5000));
  expect_quiet(run);
  for (const auto& seat : run.report.seats) EXPECT_EQ(seat.metrics.effort_peak_n, 0) << seat.name;
}

// Both hands, the tool and the wall in one point: directions between them have no length.
TEST(ExtremesOfSessions, KeepTheirInvariantsWhereAllPosesAreEqual) {
  SceneSpec scene = shared(0.5);
  for (SeatSpec& seat : scene.seats) seat.hand.trajectory.radius = 0;
  scene.tools[0].environment.wall = WallSpec{.axis = 0, .at = 0, .k = 1e6, .b = 0};
  const test::RunResult run = test::run(scene, test::delayed(20));
  expect_quiet(run);
  EXPECT_LE(run.force_step_max, 0.05);
}

}  // namespace
}  // namespace tandem
