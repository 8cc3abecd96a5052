// Flags and their reasons; no value without data.
#include "netsim/score/quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/netsim/score/lesson_maker.h"

namespace tandem::netsim::score {
namespace {

LessonMaker clean() {
  LessonMaker maker;
  maker.ticks(5000)
      .hand(0, [](double t) { return LessonTriple{0.1 * std::sin(t), 0.05 * std::cos(2 * t), 0}; })
      .force(0, [](double t) { return LessonTriple{std::sin(t), 0, 0}; });
  maker.lesson.seats[0].f_cmd = maker.lesson.seats[0].f;
  maker.lesson.seats[0].fresh.assign(5000, 1);
  maker.lesson.seats[0].gate.assign(5000, 3);
  return maker;
}

/// Removes the rows [from, to) from all columns that `clean` fills.
void cut(Lesson& lesson, std::ptrdiff_t from, std::ptrdiff_t to) {
  const auto erase = [&](auto& column) {
    if (!column.empty()) column.erase(column.begin() + from, column.begin() + to);
  };
  LessonSeat& s = lesson.seats[0];
  erase(lesson.tick), erase(s.x), erase(s.f), erase(s.f_cmd), erase(s.fresh), erase(s.gate);
}

const Quality& quality(const LessonScores& scores) { return scores.seat("trainee")->parts.front().quality; }
MetricTrust trust(const LessonScores& scores, Metric metric) {
  return trust_in(quality(scores), metric, value_of(scores, "trainee", metric));
}

TEST(ScoreQuality, OfACleanLessonIsGood) {
  const LessonScores s = clean().scores();
  EXPECT_TRUE(quality(s).doubts.empty());
  EXPECT_EQ(quality(s).missing_share, 0);
  EXPECT_NEAR(quality(s).longest_gap_s, 0.001, 1e-12);
  EXPECT_NEAR(quality(s).expected_s, 5, 1e-9);
  EXPECT_EQ(trust(s, Metric::kSparc).trust, Trust::kGood);
}

TEST(ScoreQuality, LeavesOutASeatWithoutSamples) {
  LessonMaker maker = clean();
  const LessonScores taken = maker.scores();
  ASSERT_NE(taken.seat("trainee"), nullptr);
  // As in a recording of a seat that no participant took: zeros in all rows, and no sample is new.
  maker.lesson.seats[0].x.assign(5000, {0, 0, 0});
  maker.lesson.seats[0].f.assign(5000, {0, 0, 0});
  maker.lesson.seats[0].fresh.assign(5000, 0);
  const LessonScores free = maker.scores();
  EXPECT_EQ(free.seat("trainee"), nullptr);
  EXPECT_NE(std::ranges::find(free.notes, "Seat trainee has no samples."), free.notes.end());
}

TEST(ScoreQuality, FlagsAGapAbove50MsOnly) {
  LessonMaker maker = clean();
  cut(maker.lesson, 2000, 2049);
  EXPECT_TRUE(quality(maker.scores()).doubts.empty()) << "50 ms between two samples, 0.98 % missing";
  cut(maker.lesson, 2000, 2001);
  const LessonScores s = maker.scores();
  EXPECT_NEAR(quality(s).longest_gap_s, 0.051, 1e-9);
  EXPECT_EQ(trust(s, Metric::kPathLength).trust, Trust::kFlagged);
  EXPECT_NE(trust(s, Metric::kPathLength).reason.find("the longest gap between two samples is 51 ms (limit 50 ms)"),
            std::string::npos)
      << trust(s, Metric::kPathLength).reason;
  EXPECT_EQ(trust(s, Metric::kTime).trust, Trust::kGood);
}

TEST(ScoreQuality, FlagsAndWithholdsMissingSamples) {
  for (const auto& [stride, expected] :
       {std::pair{125, Trust::kGood}, std::pair{80, Trust::kFlagged}, std::pair{8, Trust::kWithheld}}) {
    LessonMaker maker = clean();
    for (std::size_t k = 0; k < 5000; k += static_cast<std::size_t>(stride)) maker.lesson.seats[0].fresh[k] = 0;
    const LessonScores s = maker.scores();
    EXPECT_EQ(trust(s, Metric::kForceMean).trust, expected) << "one of " << stride;
    EXPECT_NEAR(quality(s).missing_share, 1.0 / stride, 2e-3);
  }
}

TEST(ScoreQuality, WithholdsAfterAGapOfMoreThanHalfASecond) {
  LessonMaker maker = clean();
  cut(maker.lesson, 2000, 2501);
  EXPECT_EQ(trust(maker.scores(), Metric::kPathLength).trust, Trust::kWithheld);
}

TEST(ScoreQuality, CountsGapsOfThePartThatHasThem) {
  LessonMaker maker = clean();
  maker.lesson.scene.phases = {{"good", 0, 1.5, false}, {"bad", 1.5, 5, false}};
  cut(maker.lesson, 2000, 2100);
  const LessonScores s = maker.scores();
  const SeatScore& seat = *s.seat("trainee");
  EXPECT_TRUE(seat.part("phase:good")->quality.doubts.empty());
  EXPECT_FALSE(seat.part("phase:bad")->quality.doubts.empty());
}

TEST(ScoreQuality, AcceptsAStopAndALateJoin) {
  LessonMaker maker = clean();
  maker.lesson.running.assign(5000, 1);
  for (std::size_t k = 1000; k < 2000; ++k) maker.lesson.running[k] = 0;
  for (std::size_t k = 0; k < 500; ++k) maker.lesson.seats[0].x[k] = kUnknownTriple;
  const LessonScores s = maker.scores();
  EXPECT_TRUE(quality(s).doubts.empty()) << quality(s).doubts.front().reason;
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTime), 4, 1e-9);
}

TEST(ScoreQuality, CountsNoWayThatAHandGoesWhileSessionTimeStandsStill) {
  LessonMaker maker = clean();
  maker.hand(0, [](double t) { return LessonTriple{t < 2 ? 0.01 * t : 0.5 + 0.01 * t, 0, 0}; });
  EXPECT_GT(value_of(maker.scores(), "trainee", Metric::kPathLength), 0.5) << "a jump, as far as the file states";
  for (std::vector<std::uint64_t> Lesson::* counts : {&Lesson::stopped_ticks, &Lesson::dropped_ticks}) {
    LessonMaker stopped = maker;
    for (std::size_t k = 0; k < 5000; ++k) (stopped.lesson.*counts).push_back(k < 2000 ? 0 : 700);
    const LessonScores s = stopped.scores();
    EXPECT_NEAR(value_of(s, "trainee", Metric::kPathLength), 0.05, 1e-3);
    EXPECT_TRUE(quality(s).doubts.empty());
  }
}

TEST(ScoreQuality, FlagsGateTripsClippedForceAndOverdrawnAccounts) {
  LessonMaker maker = clean();
  for (std::size_t k = 100; k < 200; ++k) maker.lesson.seats[0].gate[k] = 4;
  LessonScores s = maker.scores();
  EXPECT_EQ(quality(s).gate_trips, 1u);
  EXPECT_EQ(trust(s, Metric::kForcePeak).reason, "the force gate released the hand 1 time");
  EXPECT_EQ(trust(s, Metric::kPathLength).trust, Trust::kGood) << "motion does not need the gate";

  maker = clean();
  maker.lesson.scene.gate.force_max = 0.9;
  s = maker.scores();
  EXPECT_EQ(trust(s, Metric::kForcePeak).trust, Trust::kFlagged);
  EXPECT_NE(trust(s, Metric::kForcePeak).reason.find("the force limit of 0.9 N cut the force in"), std::string::npos);
  EXPECT_EQ(trust(s, Metric::kPathLength).trust, Trust::kGood);
  maker.lesson.scene.seats[0].device.force_peak = 0.5;
  EXPECT_EQ(force_limit_of(maker.lesson.scene, 0), 0.5);
  maker.lesson.scene.seats[0].role = Role::kEvaluator;
  EXPECT_EQ(force_limit_of(maker.lesson.scene, 0), 0.25) << "evaluators get half";

  maker = clean();
  maker.fill<double>(maker.lesson.seats[0].margin_min_j, [](double t) { return t < 3 ? 0.01 : -0.002; });
  s = maker.scores();
  EXPECT_EQ(trust(s, Metric::kPassivityMargin).reason, "the energy account was overdrawn by 2 mJ");
}

TEST(ScoreQuality, TakesGateTripsFromTheLinkWhereTheStateIsUnknown) {
  LessonMaker maker = clean();
  maker.lesson.seats[0].gate.clear();
  EXPECT_FALSE(quality(maker.scores()).gate_known);
  LessonLink link;
  link.tick = 400;
  link.gate_trips = 2;
  maker.lesson.links.push_back(link);
  EXPECT_EQ(quality(maker.scores()).gate_trips, 2u);
}

// A leave, a stop and a pause release the hand as requested. The gate's state looks the same as after a loss.
TEST(ScoreQuality, DoesNotFlagARequestedRelease) {
  LessonMaker maker = clean();
  for (std::size_t k = 4500; k < 5000; ++k) maker.lesson.seats[0].gate[k] = 4;
  EXPECT_EQ(quality(maker.scores()).gate_trips, 1u) << "without a counter the lesson does not say why";
  for (std::uint32_t tick = 0; tick < 5000; tick += 16) {
    LessonLink link;
    link.tick = tick;
    maker.lesson.links.push_back(link);
  }
  EXPECT_TRUE(quality(maker.scores()).doubts.empty()) << "the client counted no loss";
  for (LessonLink& link : maker.lesson.links) link.gate_trips = link.tick > 4500 ? 1 : 0;
  EXPECT_EQ(trust(maker.scores(), Metric::kForcePeak).reason, "the force gate released the hand 1 time");
  for (LessonLink& link : maker.lesson.links) link.gate_trips = 0;
  for (std::size_t k = 4500; k < 5000; ++k) maker.lesson.seats[0].gate[k] = 6;
  EXPECT_EQ(quality(maker.scores()).gate_trips, 1u) << "a reading that is not a number is no loss, and a fault";
}

TEST(ScoreQuality, CountsTripsOfItsOwnTimeOnly) {
  LessonMaker maker = clean();
  for (std::uint32_t& tick : maker.lesson.tick) tick += 60'000;  // the recording begins a minute after its session
  for (const auto& [tick, trips] : {std::pair{60'010u, 3u}, std::pair{61'000u, 3u}, std::pair{62'000u, 4u},
                                    std::pair{63'000u, 0u}, std::pair{64'000u, 1u}}) {
    LessonLink link;
    link.tick = tick;
    link.gate_trips = trips;
    maker.lesson.links.push_back(link);
  }
  EXPECT_EQ(quality(maker.scores()).gate_trips, 2u) << "from 3 to 4, and one of the next program at the seat";
}

TEST(ScoreQuality, CallsUnknownValuesAbsent) {
  LessonMaker maker;
  maker.ticks(1000).hand(0, [](double t) { return LessonTriple{0.1 * t, 0, 0}; });
  const LessonScores s = maker.scores();
  EXPECT_EQ(trust(s, Metric::kForcePeak).trust, Trust::kAbsent);
  EXPECT_EQ(trust(s, Metric::kRoundTrip50).trust, Trust::kAbsent);
  EXPECT_FALSE(s.notes.empty()) << "the lesson lacks freshness, gate, accounts and links";
}

TEST(ScoreLesson, RejectsLessonsThatDoNotFit) {
  EXPECT_FALSE(score_lesson(Lesson{}));
  LessonMaker maker = clean();
  maker.lesson.seats[0].f.pop_back();
  EXPECT_EQ(score_lesson(maker.lesson).error(), "a column of the lesson has another number of rows");
  maker = clean();
  maker.lesson.tick[7] = 3;
  EXPECT_EQ(score_lesson(maker.lesson).error(), "tick 3 of row 8 is not above the one before");
  maker = clean();
  maker.lesson.running.assign(5000, 0);
  EXPECT_FALSE(score_lesson(maker.lesson)) << "the clock never ran";
  maker = clean();
  maker.lesson.scene.seats[0].kind = SeatKind::kSlave;
  EXPECT_EQ(score_lesson(maker.lesson).error(), "the lesson has no MASTER seat");
}

TEST(ScoreLesson, SurvivesAnyValues) {
  LessonMaker maker = clean();
  Lesson& lesson = maker.lesson;
  maker.tool([](double) { return LessonTriple{}; }, [](double) { return LessonTriple{1, 0, 0}; });
  maker.authority(0, [](double) { return 1.0; });
  std::uint32_t state = 1;
  const double values[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 0, 5e-324};
  for (int hit = 0; hit < 500; ++hit) {
    state = state * 1664525u + 1013904223u;
    const std::size_t row = (state >> 8) % 5000;
    const double value = values[(state >> 3) % 7];
    LessonTriple& target = hit % 4 == 0   ? lesson.seats[0].x[row]
                           : hit % 4 == 1 ? lesson.seats[0].f[row]
                           : hit % 4 == 2 ? lesson.tools[0].x[row]
                                          : lesson.tools[0].f_env[row];
    target[hit % 3] = value;
    if (hit % 50 == 0) lesson.seats[0].alpha[row] = value;
  }
  const auto scores = score_lesson(lesson);
  ASSERT_TRUE(scores) << scores.error();
}

}  // namespace
}  // namespace tandem::netsim::score
