// Every coupling between hands in whole sessions: the paper's two experiments without delay and over delay, and more
// hands than two where the equations allow it.
#include <gtest/gtest.h>

#include <string>

#include "common/setup/channel_factory.h"
#include "proto/text/scene_text.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

class EveryCoupling : public testing::TestWithParam<HandCouplingKind> {
 protected:
  static SceneSpec scene(const std::string& name) {
    SceneSpec spec = test::shipped(name);
    choose_law(spec, LawKind::kPd);
    spec.channel.coupling = GetParam();
    spec.duration = 10;
    return spec;
  }
};

TEST_P(EveryCoupling, RunsThePapersExperimentsWithoutAndOverDelay) {
  for (const std::string name : {"free_motion", "contact"}) {
    for (const double delay_ms : {0.0, 20.0, 100.0}) {
      SCOPED_TRACE(name + " over " + std::to_string(delay_ms) + " ms");
      ASSERT_FALSE(law_problem(scene(name)).has_value());
      const test::RunResult run = test::run(scene(name), test::delayed(delay_ms));
      EXPECT_EQ(run.trouble, "");
      for (const auto& v : run.report.violations) EXPECT_TRUE(v.expected) << v.invariant << " at " << v.seat;
      EXPECT_TRUE(run.report.judged());
      EXPECT_LE(run.hand_speed_max, 2.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Couplings, EveryCoupling,
                         testing::Values(HandCouplingKind::kEsc, HandCouplingKind::kClc, HandCouplingKind::kMcet,
                                         HandCouplingKind::kNudehi, HandCouplingKind::kNpdSaturated,
                                         HandCouplingKind::kPdVariableDelay, HandCouplingKind::kPdPeer,
                                         HandCouplingKind::kAveragePosition),
                         [](const auto& kind) {
                           return std::string(control::row_of(setup::hand_coupling(kind.param)).name);
                         });

TEST(HandCouplings, AreRefusedWithTheirReasonWhereTheyMakeNoSense) {
  SceneSpec scene = test::shipped("free_motion");
  scene.channel.coupling = HandCouplingKind::kClc;
  ASSERT_TRUE(law_problem(scene).has_value()) << "law REPLICA";
  EXPECT_EQ(law_problem(scene)->key, "channel.coupling");
  choose_law(scene, LawKind::kWave);
  EXPECT_TRUE(law_problem(scene).has_value());
  choose_law(scene, LawKind::kPd);
  EXPECT_FALSE(law_problem(scene).has_value());
  scene.channel.mfs = MfsMode::kTank;
  EXPECT_TRUE(law_problem(scene).has_value());
  scene.channel.mfs = MfsMode::kOpen;
  scene.seats.push_back(scene.seats.back());
  ASSERT_TRUE(law_problem(scene).has_value()) << "three hands";
  EXPECT_NE(law_problem(scene)->words.find("two hands"), std::string::npos);
  scene.channel.coupling = HandCouplingKind::kAveragePosition;
  EXPECT_FALSE(law_problem(scene).has_value());
}

}  // namespace
}  // namespace tandem
