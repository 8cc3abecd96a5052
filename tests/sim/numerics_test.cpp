// Numerics of the simulated tool in whole sessions: server and clients step with the same, and copies agree with the
// server's tool as closely as with the default.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

/// A hand that presses on bone over 20 ms.
SceneSpec pressing(const NumericsSpec& numerics) {
  SceneSpec scene = test::shipped("contact");
  scene.numerics = numerics;
  scene.unsafe_gains = !numerics.keeps_proof();
  scene.duration = 8;
  scene.phases.clear();
  return scene;
}

struct Twins {
  test::RunResult run;
  double apart_max = 0;  ///< largest distance of the leader's copy from the server's tool once both press [m]
  double pressed_m = 0;  ///< largest depth of the server's tool
  bool same = true;      ///< numerics of both
};
Twins twins(const NumericsSpec& numerics) {
  Twins out;
  out.run = test::run(pressing(numerics), test::delayed(20), 1, [&](netsim::Simulation& simulation) {
    const client::Seat* const seat = simulation.seat(0);
    const control::VirtualTool* const tool = simulation.session().tool(0).body();
    if (seat == nullptr || tool == nullptr || seat->coupling().tool_copy() == nullptr) return;
    const control::VirtualTool& copy = *seat->coupling().tool_copy();
    for (const control::VirtualTool* one : {tool, &copy})
      out.same = out.same && one->numerics().substeps == numerics.substeps &&
                 static_cast<int>(one->numerics().integrator) == static_cast<int>(numerics.integrator) &&
                 static_cast<int>(one->numerics().precision) == static_cast<int>(numerics.precision);
    out.pressed_m = std::max(out.pressed_m, tool->penetration());
    if (out.pressed_m > 0 && copy.penetration() > 0)
      out.apart_max = std::max(out.apart_max, std::abs(tool->x(0) - copy.x(0)));
  });
  return out;
}

TEST(NumericsInSessions, ServerAndClientStepWithTheSame) {
  const Twins usual = twins({});
  ASSERT_EQ(usual.run.trouble, "");
  ASSERT_GT(usual.pressed_m, 5e-5);
  using enum IntegratorKind;
  for (const NumericsSpec& numerics :
       {NumericsSpec{.substeps = 4}, NumericsSpec{.integrator = kImplicitMidpoint},
        NumericsSpec{.integrator = kSemiImplicitEuler, .substeps = 4}, NumericsSpec{.integrator = kRk4, .substeps = 4},
        NumericsSpec{.integrator = kExact, .precision = PrecisionKind::kFloat}}) {
    SCOPED_TRACE("integrator " + std::to_string(static_cast<int>(numerics.integrator)) + ", substeps " +
                 std::to_string(numerics.substeps));
    const Twins other = twins(numerics);
    EXPECT_EQ(other.run.trouble, "");
    EXPECT_TRUE(other.same);
    for (const auto& v : other.run.report.violations) EXPECT_TRUE(v.expected) << v.invariant << " at " << v.seat;
    EXPECT_NEAR(other.pressed_m, usual.pressed_m, 0.1 * usual.pressed_m) << "the same force";
    EXPECT_LE(other.apart_max, 1.5 * usual.apart_max + 1e-5);
  }
}

// Devices may be stepped otherwise than by their own scheme: every invariant holds, and hands press alike.
TEST(NumericsInSessions, DevicesMayHaveNumericsOfTheirOwn) {
  const auto pressed = [](const std::optional<NumericsSpec>& numerics) {
    SceneSpec scene = pressing({});
    for (SeatSpec& seat : scene.seats) seat.device.numerics = numerics;
    double depth = 0;
    const test::RunResult run = test::run(scene, test::delayed(20), 1, [&](netsim::Simulation& simulation) {
      if (const control::VirtualTool* const tool = simulation.session().tool(0).body(); tool != nullptr)
        depth = std::max(depth, tool->penetration());
    });
    EXPECT_EQ(run.trouble, "");
    return depth;
  };
  const double usual = pressed({});
  ASSERT_GT(usual, 5e-5);
  using enum IntegratorKind;
  for (const NumericsSpec& numerics :
       {NumericsSpec{.integrator = kImplicitEuler, .substeps = 4}, NumericsSpec{.integrator = kImplicitMidpoint},
        NumericsSpec{.integrator = kExact, .precision = PrecisionKind::kFloat}})
    EXPECT_NEAR(pressed(numerics), usual, 0.05 * usual) << static_cast<int>(numerics.integrator);
}

}  // namespace
}  // namespace tandem
