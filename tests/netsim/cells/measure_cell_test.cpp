// Numbers of a cell: from traces whose numbers can be computed by hand, and from runs that other instruments measure.
#include "netsim/cells/measure_cell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"
#include "tests/support/simulation_run.h"

namespace tandem::netsim {
namespace {

double at(const CellValues& values, CellNumber number) { return values[static_cast<std::size_t>(number)]; }

/// A trace of two hands at 1 kHz: hand 0 at x = 4 mm with 1 N, hand 1 at 0, the tool at 1 mm.
FeelTrace still(double length) {
  FeelTrace trace;
  trace.hands.resize(2);
  for (std::size_t i = 0; i < static_cast<std::size_t>(1000 * length); ++i) {
    trace.t.push_back(1e-3 * static_cast<double>(i));
    trace.tool.push_back({0.001, 0, 0});
    trace.f_env.push_back({-1.5, 0, 0});
    trace.held.push_back(0);
    for (std::size_t k = 0; k < 2; ++k) {
      FeelTrace::Hand& hand = trace.hands[k];
      hand.force_max = 3.3;
      hand.x.push_back({k == 0 ? 0.004 : 0.0, 0, 0});
      hand.f.push_back({k == 0 ? -1.0 : 0.0, 0, 0});
      hand.f_cmd.push_back(hand.f.back());
      hand.engaged.push_back(1);
      hand.trips.push_back(0);
      hand.alpha.push_back(k == 0 ? 0.75 : 0.25);
      hand.work.push_back(0);
    }
  }
  return trace;
}

TEST(CellValues, OfAStillTraceAreThoseComputedByHand) {
  const CellValues v = values_of(still(16), task_times(CellTask::kFree, nullptr));
  EXPECT_NEAR(at(v, CellNumber::kTracking), 0.002, 1e-12) << "0.75 x 4 mm - 1 mm";
  EXPECT_NEAR(at(v, CellNumber::kFollower), 0.001, 1e-12);
  EXPECT_NEAR(at(v, CellNumber::kDrift), 0.002, 1e-12);
  EXPECT_NEAR(at(v, CellNumber::kDrag), 1, 1e-12);
  EXPECT_EQ(at(v, CellNumber::kEngagedShare), 1);
  EXPECT_EQ(at(v, CellNumber::kMotorEnergy), 0);
  EXPECT_EQ(at(v, CellNumber::kUnstable), 0);
  EXPECT_TRUE(std::isnan(at(v, CellNumber::kStiffness))) << "free motion has none";
}

TEST(CellValues, OfAPressAreForceOverDepthAndWhatTheToolHasMore) {
  const CellValues v = values_of(still(16), task_times(CellTask::kWall, nullptr));
  EXPECT_NEAR(at(v, CellNumber::kStiffness), 250, 1e-9) << "1 N at 4 mm";
  EXPECT_NEAR(at(v, CellNumber::kForceError), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(at(v, CellNumber::kDrag)));
  FeelTrace away = still(16);
  for (hal::Vec3& f : away.hands[0].f) f.setZero();
  EXPECT_TRUE(std::isnan(at(values_of(away, task_times(CellTask::kWall, nullptr)), CellNumber::kStiffness)))
      << "no contact has no stiffness";
}

TEST(CellValues, SumTheWorkOfTheMotorsAndKeepItsLargestValue) {
  FeelTrace trace = still(16);
  trace.hands[0].work[100] = -0.3;
  trace.hands[1].work[200] = 0.5;
  trace.hands[0].work[300] = 0.1;
  trace.hands[1].work[400] = -1;
  const CellValues v = values_of(trace, task_times(CellTask::kFree, nullptr));
  EXPECT_NEAR(at(v, CellNumber::kMotorEnergy), 0.3, 1e-12) << "-0.3 + 0.5 + 0.1";
  EXPECT_EQ(at(v, CellNumber::kLeaderEnergy), 0) << "-0.3, then -0.2";
}

TEST(CellValues, CallARunUnstableThatOscillatesInTheRestOrMovesTooFast) {
  const TaskTimes times = task_times(CellTask::kFree, nullptr);
  for (const double amplitude : {0.27, 0.30}) {  // RMS 0.19 and 0.21 N
    FeelTrace trace = still(16);
    for (std::size_t i = 0; i < trace.rows(); ++i)
      trace.hands[1].f[i].y() = amplitude * std::sin(2 * std::numbers::pi * 5 * trace.t[i]);
    EXPECT_EQ(at(values_of(trace, times), CellNumber::kUnstable), amplitude > 0.28 ? 1 : 0) << amplitude;
  }
  FeelTrace fast = still(16);
  fast.hands[1].x[5000].z() = 0.0016;  // 1.6 m/s for a millisecond
  EXPECT_EQ(at(values_of(fast, times), CellNumber::kUnstable), 1);
  FeelTrace away = still(16);
  away.tool[5000].y() = 0.26;
  EXPECT_EQ(at(values_of(away, times), CellNumber::kUnstable), 1);
}

TEST(CellValues, OfARunThatDidNotBeginAreAbsent) {
  for (const double value : values_of({}, task_times(CellTask::kFree, nullptr))) EXPECT_TRUE(std::isnan(value));
}

TEST(CellResult, StatesMedianAndWorstOverTheSeedsThatHaveTheNumber) {
  CellResult result;
  for (const double v : {3.0, 1.0, kNaN, 8.0, 2.0}) {
    CellRun& run = result.runs.emplace_back();
    run.seed = result.runs.size();
    run.values.fill(v);
    run.values[static_cast<std::size_t>(CellNumber::kUnstable)] = v > 2.5 ? 1 : 0;
  }
  EXPECT_EQ(result.of(CellNumber::kDrag).median, 2.5);
  EXPECT_EQ(result.of(CellNumber::kDrag).worst, 8);
  EXPECT_EQ(result.of(CellNumber::kDrag).worst_seed, 4u);
  EXPECT_EQ(result.of(CellNumber::kStiffness).worst, 1) << "the softest is the worst";
  EXPECT_EQ(result.of(CellNumber::kStiffness).worst_seed, 2u);
  EXPECT_EQ(result.of(CellNumber::kUnstable).median, 0.4) << "share of the five seeds";
  EXPECT_TRUE(result.sound());
  result.runs[1].broken = {"ledger"};
  EXPECT_FALSE(result.sound());
}

TEST(CellResult, SurvivesItsTextBitByBit) {
  CellResult result;
  result.runs.push_back(
      {.seed = 18'446'744'073'709'551'615u, .values = {}, .trouble = "a \"b\"\n", .broken = {"x", "y"}});
  result.runs[0].values.fill(kNaN);
  result.runs[0].values[0] = 0.1 + 0.2;
  result.runs[0].values[1] = 5e-324;
  const std::string bytes = to_bytes(result);
  EXPECT_EQ(bytes.find('\n'), std::string::npos);
  const CellResult back = cell_result_from_bytes(bytes);
  ASSERT_EQ(back.runs.size(), 1u);
  EXPECT_EQ(back.runs[0].seed, result.runs[0].seed);
  EXPECT_EQ(back.runs[0].values[0], 0.1 + 0.2);
  EXPECT_EQ(back.runs[0].values[1], 5e-324);
  EXPECT_TRUE(std::isnan(back.runs[0].values[2]));
  EXPECT_EQ(back.runs[0].trouble, result.runs[0].trouble);
  EXPECT_EQ(back.runs[0].broken, result.runs[0].broken);
  EXPECT_EQ(to_bytes(back), bytes);
  for (const char* wrong : {"", "[", "[[1,[2],\"\",[]]]", "{\"a\":1}"})
    EXPECT_ANY_THROW((void)cell_result_from_bytes(wrong));
}

/// Law replica at any delay: between hand and bone there are the spring of the coupling, 372 N/m, and the bone.
TEST(MeasureCell, FeelsCouplingAndBoneInSeriesUnderTheDefaultLaw) {
  for (const double delay : {0.0, 100.0}) {
    Cell cell;
    cell.task = CellTask::kWall;
    cell.delay_ms = delay;
    const CellRun run = measure_cell(cell, {.scene = tandem::test::shipped("contact")}, 1);
    ASSERT_EQ(run.trouble, "");
    EXPECT_TRUE(run.broken.empty());
    EXPECT_NEAR(at(run.values, CellNumber::kStiffness), 1 / (1 / 372.0 + 1 / 20e3), 4) << delay;
    EXPECT_LT(at(run.values, CellNumber::kForceError), 0.05);
  }
}

/// Twin: with all authority at the leader, tracking and drag are those of the probe `free` on the same circle.
TEST(MeasureCell, AgreesWithTheProbeOfFreeMotion) {
  Cell cell;
  cell.law = LawKind::kSetPosition;
  cell.delay_ms = 50;
  const CellInput input{.scene = tandem::test::shipped("contact")};
  const CellRun run = measure_cell(cell, input, 1);
  const FeelValues probe = probe_free(setup_of(cell, input), 1).values;
  EXPECT_NEAR(at(run.values, CellNumber::kTracking), probe.at("leader_tool_05hz_m"),
              0.05 * probe.at("leader_tool_05hz_m"));
  EXPECT_NEAR(at(run.values, CellNumber::kDrag), probe.at("drag_05hz_n"), 0.05 * probe.at("drag_05hz_n"));
}

/// Negative control: the law without an energy ledger oscillates at this delay; the default does not.
TEST(MeasureCell, FindsTheUnstableLaw) {
  Cell cell;
  cell.delay_ms = 200;
  const CellInput input{.scene = tandem::test::shipped("contact")};
  EXPECT_EQ(at(measure_cell(cell, input, 1).values, CellNumber::kUnstable), 0);
  cell.law = LawKind::kRaw;
  EXPECT_EQ(at(measure_cell(cell, input, 1).values, CellNumber::kUnstable), 1);
}

/// The work of each tick adds up to force times motion, and every hand has its authority.
TEST(FeelTrace, HasTheWorkOfTheMotorsAndTheAuthorityOfEveryHand) {
  Cell cell;
  cell.hands = 3;
  cell.alpha = CellAlpha::kHalf;
  const CellInput input{.scene = tandem::test::shipped("contact")};
  const FeelSetup setup = setup_of(cell, input);
  const FeelTrace trace = run_probe(setup, run_of(cell, input, setup, 1), 1);
  ASSERT_EQ(trace.trouble, "");
  ASSERT_EQ(trace.hands.size(), 3u);
  EXPECT_NEAR(trace.hands[0].alpha.back(), 0.5, 1e-12);
  EXPECT_NEAR(trace.hands[2].alpha.back(), 0.25, 1e-12);
  for (const FeelTrace::Hand& hand : trace.hands) {
    double by_hand = 0, size = 0;
    for (std::size_t i = 1; i < trace.rows(); ++i) by_hand += hand.f[i].dot(hand.x[i] - hand.x[i - 1]);
    for (const double w : hand.work) size += std::abs(w);
    EXPECT_NEAR(std::accumulate(hand.work.begin(), hand.work.end(), 0.0), by_hand, 0.02 * size + 1e-6);
  }
}

TEST(MeasureCell, GivesTheSameBytesTwice) {
  Cell cell;
  cell.law = LawKind::kTdpa;
  cell.delay_ms = 20;
  cell.jitter_ms = 5;
  cell.loss_percent = 10;
  cell.task = CellTask::kGesture;
  const CellInput input{.scene = tandem::test::shipped("contact")};
  const auto bytes = [&](std::uint64_t seed) { return to_bytes(CellResult{{measure_cell(cell, input, seed)}}); };
  EXPECT_EQ(bytes(2), bytes(2));
  EXPECT_NE(bytes(2), bytes(3));
}

/// Every task and every authority runs and is judged.
TEST(MeasureCell, RunsEveryTaskAndAuthority) {
  const CellInput input{.scene = tandem::test::shipped("contact"),
                        .recording = DrawnHand{HandKind::kPlain, 1, 0}.move(kick_path, 4)};
  for (std::size_t task = 0; task < kCellTaskNames.size(); ++task)
    for (std::size_t alpha = 0; alpha < (task == 0 ? kCellAlphaNames.size() : 1); ++alpha) {
      Cell cell;
      cell.task = static_cast<CellTask>(task);
      cell.alpha = static_cast<CellAlpha>(alpha);
      cell.delay_ms = 20;
      const CellRun run = measure_cell(cell, input, 1);
      EXPECT_EQ(run.trouble, "") << condition_text(cell);
      EXPECT_TRUE(run.broken.empty()) << condition_text(cell) << " " << run.broken.front();
      EXPECT_FALSE(std::isnan(at(run.values, CellNumber::kUnstable)));
      const bool contact = cell.task == CellTask::kWall || cell.task == CellTask::kTissue;
      EXPECT_EQ(std::isnan(at(run.values, CellNumber::kTracking)), contact) << condition_text(cell);
      EXPECT_EQ(std::isnan(at(run.values, CellNumber::kStiffness)), !contact) << condition_text(cell);
    }
}

}  // namespace
}  // namespace tandem::netsim
