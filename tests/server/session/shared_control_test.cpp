// The control law of a session with its seats and tools, without clients: samples stay at zero.
#include "server/session/shared_control.h"

#include <gtest/gtest.h>

#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

constexpr double kStart = -0.02;  ///< of the tool of the scene "contact" [m]; its block begins at 0
constexpr std::size_t kTrainer = 0, kTrainee = 1;

void choose_set_position(SceneSpec& scene) { scene.channel.law = LawKind::kSetPosition; }

struct Rig {
  explicit Rig(LawKind law)
      : parts("contact", law == LawKind::kReplica ? nullptr : &choose_set_position),
        control(parts.scene, std::vector<std::unique_ptr<hal::SteppedDevice>>(1), {1, 1, 1, 1, 1, 1, 1}, parts.seats,
                parts.present),
        hands(parts.scene, parts.clock.dt()) {
    EXPECT_TRUE(control.tools()[0].authority.request({1}));
  }
  void run(int ticks, bool released = false) {
    for (int n = 0; n < ticks; ++n) {
      control.step_authority(released);
      control.move_references(Time{});
      control.step_tools(0);
      hands.step(tick, parts.present, parts.seats, control.tools());
      control.step_targets(tick++, hands);
    }
  }
  [[nodiscard]] double tool_x() { return control.tools()[0].x(0); }
  [[nodiscard]] double reference(std::size_t seat) { return parts.seats[seat].end(0).state().ref[0]; }

  test::SessionParts parts;
  SharedControl control;
  LeadingHands hands;
  std::uint32_t tick = 0;
};

TEST(SharedControl, RestsAllReferencesAtABrakedTool) {
  for (const LawKind law : {LawKind::kReplica, LawKind::kSetPosition}) {
    Rig rig(law);
    rig.run(100);
    EXPECT_TRUE(rig.control.hub().braked(0)) << "no seat is present";
    EXPECT_EQ(rig.tool_x(), kStart);
    for (const std::size_t i : {kTrainer, kTrainee}) {
      EXPECT_EQ(rig.reference(i), kStart);
      EXPECT_EQ(rig.parts.seats[i].tx.alpha, 0);
    }
  }
}

TEST(SharedControl, PullsTheToolToTheHandWithAuthority) {
  for (const LawKind law : {LawKind::kReplica, LawKind::kSetPosition}) {
    Rig rig(law);
    rig.parts.present[kTrainer] = rig.parts.present[kTrainee] = true;
    rig.run(8000);
    EXPECT_FALSE(rig.control.hub().braked(0));
    EXPECT_NEAR(rig.tool_x(), 0, 1e-4) << "where both hands are";
    EXPECT_EQ(rig.parts.seats[kTrainer].tx.alpha, 1);
    EXPECT_EQ(rig.parts.seats[kTrainee].tx.alpha, 0);
  }
}

TEST(SharedControl, SendsAFollowerTheLeadersPredictionAndTheTool) {
  Rig rig(LawKind::kReplica);
  rig.parts.present[kTrainer] = rig.parts.present[kTrainee] = true;
  rig.run(200);
  const PortSample& out = rig.parts.seats[kTrainee].tx.port;
  EXPECT_GT(rig.reference(kTrainer), kStart + 0.005) << "the prediction approaches the hand at 50 mm/s";
  EXPECT_EQ(out.x[0], rig.reference(kTrainer));
  EXPECT_EQ(out.f[0], rig.tool_x());
  EXPECT_EQ(rig.parts.seats[kTrainee].tx.ghost.leader, kTrainer + 1);
}

TEST(SharedControl, SendsTheToolItselfUnderSetPosition) {
  Rig rig(LawKind::kSetPosition);
  rig.parts.present[kTrainer] = rig.parts.present[kTrainee] = true;
  rig.run(1);
  EXPECT_EQ(rig.parts.seats[kTrainee].tx.port.x[0], rig.tool_x()) << "the offset begins when a hand was heard";
  EXPECT_EQ(rig.parts.seats[kTrainee].tx.ghost.leader, 0u);
}

TEST(SharedControl, BrakesTheToolsOfAReleasedSession) {
  for (const LawKind law : {LawKind::kReplica, LawKind::kSetPosition}) {
    Rig rig(law);
    rig.parts.present[kTrainer] = true;
    rig.run(1000);
    ASSERT_GT(rig.tool_x(), kStart);
    rig.run(500, true);
    EXPECT_TRUE(rig.control.hub().braked(0));
    EXPECT_EQ(rig.reference(kTrainer), rig.tool_x());
  }
}

TEST(SharedControl, PlacesAToolAndReportsItsContact) {
  Rig rig(LawKind::kReplica);
  EXPECT_FALSE(rig.control.touching(Time{}, 0));
  rig.control.rest_tool(0, {0.001});
  EXPECT_EQ(rig.control.hub().tool(0).x[0], 0.001);
  rig.run(1);
  EXPECT_TRUE(rig.control.touching(Time{}, 0)) << "1 mm within the block";
  rig.control.rest_tool(0, {-0.001});
  rig.run(1);
  EXPECT_FALSE(rig.control.touching(Time{}, 0));
}

}  // namespace
}  // namespace tandem::server
