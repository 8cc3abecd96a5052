// Metrics of tracking, sharing, passivity and link against numbers computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/netsim/score/lesson_maker.h"

namespace tandem::netsim::score {
namespace {

constexpr double kPi = std::numbers::pi;
const auto kNoForce = [](double) { return LessonTriple{}; };

TEST(TrackingScores, SeparateDelayFromDistance) {
  LessonMaker maker;
  const auto sway = [](double t) { return LessonTriple{0.05 * std::sin(2 * kPi * 0.5 * t), 0, 0}; };
  maker.ticks(8000).hand(0, sway).tool(
      [&](double t) {
        LessonTriple x = sway(t - 0.020);
        x[1] = 0.003;
        return x;
      },
      kNoForce);
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTrackingDelay), 0.020, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTrackingNoDelay), 0.003, 1e-6);
  const double lag_rms = 0.05 * 2 * std::sin(kPi * 0.5 * 0.020) / std::numbers::sqrt2;
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTracking), std::hypot(0.003, lag_rms), 1e-5);
}

TEST(TrackingScores, FindReflectionErrorAndStiffness) {
  LessonMaker maker;
  maker.lesson.scene.tools[0].environment.wall = WallSpec{.axis = 0, .at = 0.01};
  // The hand goes 10 mm beyond the wall and feels 400 N/m; the environment pushes 0.3 N more.
  const auto depth = [](double t) { return 0.01 * minimum_jerk((t - 0.5) / 2); };
  maker.ticks(4000)
      .hand(0, [&](double t) { return LessonTriple{0.01 + depth(t), 0, 0}; })
      .force(0, [&](double t) { return LessonTriple{-400 * depth(t), 0, 0}; })
      .tool([](double) { return LessonTriple{0.01, 0, 0}; },
            [&](double t) { return depth(t) > 0.0005 ? LessonTriple{-400 * depth(t) - 0.3, 0, 0} : LessonTriple{}; });
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kReflectionError), 0.3, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kReflectionErrorShare), 0.3 / 4.3, 1e-6);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kRenderedStiffness), 400, 4);
}

TEST(TrackingScores, MeasureDriftAtRestOnly) {
  LessonMaker maker;
  maker.ticks(3000)
      .hand(0, [](double t) { return LessonTriple{0.1 * minimum_jerk(t), 0, 0}; })
      .tool([](double t) { return LessonTriple{t < 1.2 ? 0.5 : 0.1, 0.002, 0}; }, kNoForce);
  EXPECT_NEAR(value_of(maker.scores(), "trainee", Metric::kDrift), 0.002, 1e-5);
  LessonMaker moving;
  moving.ticks(3000)
      .hand(0, [](double t) { return LessonTriple{0.1 * t, 0, 0}; })
      .tool([](double) { return LessonTriple{}; }, kNoForce);
  EXPECT_TRUE(std::isnan(value_of(moving.scores(), "trainee", Metric::kDrift)));
}

/// The trainer takes the tool at 2 s and gives it back at 3 s; the trainee's hand moves against the force.
LessonMaker hand_over() {
  LessonMaker maker({"trainer", "trainee"});
  const auto trainer = [](double t) { return t >= 2 && t < 3 ? 1.0 : 0.0; };
  maker.ticks(4000)
      .hand(0, [](double t) { return LessonTriple{0.05 * t, 0, 0}; })
      .hand(1, [](double t) { return LessonTriple{0.1 * t, 0, 0}; })
      .force(0, [](double) { return LessonTriple{0.5, 0, 0}; })
      .force(1, [](double t) { return LessonTriple{t >= 2 ? -1.0 : -0.75, 0, 0}; })
      .authority(0, trainer)
      .authority(1, [&](double t) { return 1 - trainer(t); })
      .tool([](double t) { return LessonTriple{0.1 * t, 0, 0}; },
            [](double t) { return LessonTriple{t >= 1 && t < 3 ? -1.0 : 0.0, 0, 0}; });
  return maker;
}

TEST(SharingScores, SplitByTheHolderOfTheTool) {
  const LessonScores s = hand_over().scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTime, "held:trainee"), 3, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTime, "held:trainer"), 1, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kPathLength, "held:trainee"), 0.3, 1e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kPathLength, "held:trainer"), 0.1, 1e-3);
  EXPECT_EQ(s.seat("trainee")->part("shared"), nullptr) << "a seat held the tool at any time";
  EXPECT_NEAR(value_of(s, "trainee", Metric::kAuthorityShare), 0.75, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kAuthorityShareContact), 0.5, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kWeightedTime), 3, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kWeightedPath), 0.3, 1e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kWeightedImpulse), 1, 1e-9);
}

TEST(SharingScores, HaveATimeWithoutHolderWhereAuthorityIsShared) {
  LessonMaker maker({"a", "b", "c"});
  maker.ticks(1000);
  for (std::size_t i = 0; i < 3; ++i) {
    maker.hand(i, [](double t) { return LessonTriple{0.1 * t, 0, 0}; });
    maker.authority(i, [](double) { return 1.0 / 3; });
  }
  const LessonScores s = maker.scores();
  ASSERT_NE(s.seat("a"), nullptr);
  EXPECT_NE(s.seat("a")->part("shared"), nullptr);
  EXPECT_EQ(s.seat("a")->part("held:a"), nullptr);
}

TEST(SharingScores, SplitByPhase) {
  LessonMaker maker;
  maker.lesson.scene.phases = {{"first", 0, 0.4, false}, {"second", 0.4, 1, false}, {"never", 5, 6, false}};
  maker.ticks(1000).hand(0, [](double t) { return LessonTriple{0.1 * t, 0, 0}; });
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTime, "phase:first"), 0.4, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTime, "phase:second"), 0.6, 1e-9);
  EXPECT_EQ(s.seat("trainee")->part("phase:never"), nullptr);
}

TEST(SharingScores, FindInterventionsWithCauseAndOpposition) {
  LessonMaker maker = hand_over();
  maker.lesson.events.push_back({1900, 0, "authority", "trainer", "trainer takes the tool by request"});
  const LessonScores s = maker.scores();
  ASSERT_EQ(s.interventions.size(), 1u);
  const NamedIntervention& i = s.interventions[0];
  EXPECT_EQ(i.seat, "trainer");
  EXPECT_EQ(i.from_seat, "trainee");
  EXPECT_NEAR(i.from_s, 2, 1e-9);
  EXPECT_NEAR(i.to_s, 3, 1e-9);
  EXPECT_EQ(i.cause, "trainer takes the tool by request");
  EXPECT_NEAR(i.opposition, -1, 1e-6) << "the force on the trainee's hand points against its motion";
  EXPECT_EQ(value_of(s, "trainer", Metric::kInterventions), 1);
  EXPECT_NEAR(value_of(s, "trainer", Metric::kInterventionTime), 1, 1e-9);
  EXPECT_TRUE(std::isnan(value_of(s, "trainee", Metric::kInterventions))) << "only instructors intervene";
  EXPECT_EQ(hand_over().scores().interventions.at(0).cause, "not recorded");
}

TEST(SharingScores, MeasureTheJumpAtAChangeOfAuthority) {
  const LessonScores s = hand_over().scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kHandoverJump), 0.25, 1e-9);
  EXPECT_NEAR(value_of(s, "trainer", Metric::kHandoverJump), 0, 1e-9);
  // A jump of 0.25 N through the low-pass of 20 Hz.
  EXPECT_GT(value_of(s, "trainee", Metric::kHandoverRate), 5);
  EXPECT_LT(value_of(s, "trainee", Metric::kHandoverRate), 25);
  LessonMaker steady = hand_over();
  steady.authority(0, [](double) { return 0.0; }).authority(1, [](double) { return 1.0; });
  EXPECT_TRUE(std::isnan(value_of(steady.scores(), "trainee", Metric::kHandoverJump)));
}

TEST(PairScores, MeasureConflictAndTwoHandsOfOnePerson) {
  LessonMaker maker({"left", "right"});
  // Forces at 120 degrees: cosine -0.5. The left hand moves in [0, 2), the right one in [1, 3) s.
  maker.ticks(4000)
      .force(0, [](double) { return LessonTriple{1, 0, 0}; })
      .force(1, [](double) { return LessonTriple{-0.5, std::sqrt(0.75), 0}; })
      .hand(0, [](double t) { return LessonTriple{0.2 * std::fmin(t, 2), 0, 0}; })
      .hand(1, [](double t) { return LessonTriple{0.2 * std::fmin(std::fmax(t, 1), 3), 0, 0}; });
  LessonScores s = maker.scores();
  ASSERT_EQ(s.pairs.size(), 1u);
  EXPECT_NEAR(s.pairs[0].score.conflict, 0.5, 1e-6);
  EXPECT_NEAR(s.pairs[0].score.both_feel_s, 4, 1e-9);
  EXPECT_TRUE(std::isnan(s.pairs[0].score.both_move_share)) << "two persons";
  maker.lesson.seats[0].person = maker.lesson.seats[1].person = "Ada";
  s = maker.scores();
  EXPECT_NEAR(s.pairs[0].score.both_move_share, 1.0 / 3, 0.05);
  EXPECT_NEAR(s.pairs[0].score.speed_correlation, 0, 0.05);
  maker.lesson.seats[0].workstation = maker.lesson.seats[1].workstation = true;
  EXPECT_TRUE(std::isnan(maker.scores().pairs[0].score.both_move_share)) << "one workstation, two persons";
}

TEST(PassivityScores, SumDissipationAndKeepTheLeastMargin) {
  LessonMaker maker;
  maker.ticks(1000).hand(0, [](double t) { return LessonTriple{0.1 * t, 0, 0}; });
  maker.fill<double>(maker.lesson.seats[0].dissipated_j, [](double t) { return t < 0.5 ? 0.0 : 0.1 * (t - 0.5); });
  maker.fill<double>(maker.lesson.seats[0].margin_min_j, [](double t) { return 0.05 - 0.04 * t; });
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kDissipated), 0.0499, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kControllerShare), 0.499, 2e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kPassivityMargin), 0.05 - 0.04 * 0.999, 1e-9);
}

TEST(LinkScores, AreOfTheSeatAndPart) {
  LessonMaker maker({"a", "b"});
  maker.lesson.scene.phases = {{"late", 0.5, 1, false}};
  maker.ticks(1000).hand(0, [](double t) { return LessonTriple{0.1 * t, 0, 0}; }).hand(1, [](double t) {
    return LessonTriple{0.1 * t, 0, 0};
  });
  for (std::uint32_t i = 0; i < 100; ++i) {
    LessonLink link;
    link.tick = i * 10;
    link.seat = 0;
    link.rtt_p50_ms = i + 1;  // 1 to 100 ms
    link.loss_up_percent = i < 50 ? 0 : 2;
    link.gap_down_ms = i == 3 ? 80 : 4;
    link.gate_trips = i < 60 ? 1 : 3;
    link.late_ticks = i;
    maker.lesson.links.push_back(link);
  }
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "a", Metric::kRoundTrip50), 0.050, 1e-12);
  EXPECT_NEAR(value_of(s, "a", Metric::kRoundTrip95), 0.095, 1e-12);
  EXPECT_NEAR(value_of(s, "a", Metric::kRoundTrip99), 0.099, 1e-12);
  EXPECT_NEAR(value_of(s, "a", Metric::kLossUp), 0.01, 1e-12);
  EXPECT_TRUE(std::isnan(value_of(s, "a", Metric::kLossDown))) << "unknown is not 0";
  EXPECT_NEAR(value_of(s, "a", Metric::kGapDown), 0.080, 1e-12);
  EXPECT_EQ(value_of(s, "a", Metric::kGateTrips), 3);
  EXPECT_EQ(value_of(s, "a", Metric::kLateTicks), 99);
  EXPECT_NEAR(value_of(s, "a", Metric::kRoundTrip50, "phase:late"), 0.075, 1e-12);
  EXPECT_NEAR(value_of(s, "a", Metric::kGapDown, "phase:late"), 0.004, 1e-12);
  EXPECT_EQ(value_of(s, "a", Metric::kGateTrips, "phase:late"), 2);
  EXPECT_TRUE(std::isnan(value_of(s, "b", Metric::kRoundTrip50)));
}

}  // namespace
}  // namespace tandem::netsim::score
