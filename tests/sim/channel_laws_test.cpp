// Every channel law in whole sessions: the paper's two experiments without delay and over delay.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/control/channel.h"
#include "common/setup/channel_factory.h"
#include "proto/text/scene_text.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

/// Largest distance of the leader's hand from the tool without delay, in free motion [mm RMS].
double tracking_max_mm(LawKind law) { return law == LawKind::kWave ? 4 : law == LawKind::kReplica ? 1 : 1.5; }

class EveryLaw : public testing::TestWithParam<LawKind> {
 protected:
  static SceneSpec scene(const std::string& name) {
    SceneSpec spec = test::shipped(name);
    choose_law(spec, GetParam());
    spec.duration = 10;
    return spec;
  }
};

TEST_P(EveryLaw, TracksThePapersFreeMotionWithoutDelay) {
  const test::RunResult run = test::run(scene("free_motion"));
  EXPECT_EQ(run.trouble, "");
  EXPECT_STREQ(run.report.verdict(), "pass");
  EXPECT_LE(1e3 * run.phase("demonstration", "trainer").tracking_rms_m, tracking_max_mm(GetParam()));
}

TEST_P(EveryLaw, PressesThePapersBlockWithoutDelay) {
  const test::RunResult run = test::run(scene("contact"));
  EXPECT_EQ(run.trouble, "");
  EXPECT_STREQ(run.report.verdict(), "pass");
  const auto& leader = run.seat("trainer").metrics;
  EXPECT_GE(leader.effort_peak_n, 1.0) << "the block is felt";
}

TEST_P(EveryLaw, KeepsItsPromisesOverDelayJitterAndLoss) {
  for (const std::string name : {"free_motion", "contact"}) {
    for (const auto& net : {test::delayed(20), test::delayed(100), test::delayed(30, 20, 20), test::delayed(500)}) {
      const test::RunResult run = test::run(scene(name), net);
      EXPECT_EQ(run.trouble, "");
      for (const auto& v : run.report.violations)
        EXPECT_TRUE(v.expected) << name << ": " << v.invariant << " at " << v.seat;
      if (GetParam() == LawKind::kRaw) continue;  // it diverges; its gate and the devices bound it
      EXPECT_LE(run.hand_speed_max, 2.0) << name;
    }
  }
}

TEST(ChannelLaws, AreTheOnesThatScenesCanName) {
  EXPECT_EQ(control::channel_laws().size(), kLaws);
  for (std::size_t law = 0; law < kLaws; ++law)
    EXPECT_NE(control::make_channel_end(setup::law_name(static_cast<LawKind>(law)), {}), nullptr) << law;
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw,
                         testing::Values(LawKind::kReplica, LawKind::kSetPosition, LawKind::kTdpa, LawKind::kWave,
                                         LawKind::kPd, LawKind::kRaw),
                         [](const auto& law) { return std::string(setup::law_name(law.param)); });

}  // namespace
}  // namespace tandem
