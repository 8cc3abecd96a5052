// The table of cost and error: the reference against a closed form, orders of the errors, the front, determinism.
#include "netsim/tradeoff/tradeoff.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "netsim/tradeoff/reference.h"

namespace tandem::netsim::tradeoff {
namespace {

using control::Integrator;
using control::Numerics;
using control::Precision;

ToolTask free_task() { return {.tool = {}, .axes = 1, .contacts = {}}; }
SceneSpec scene_on_bone() {
  SceneSpec scene;
  scene.name = "bone";
  scene.dof = 1;
  scene.seats.emplace_back();
  scene.tools.emplace_back();
  scene.tools[0].environment.wall.emplace();
  return scene;
}
Grid small_grid() { return {.ticks_hz = {500, 1000}, .substeps = {1, 2}}; }
Cost some_cost(const Numerics& numerics) {
  return {.tool_instructions = 900.0 * numerics.substeps,
          .seat_instructions = 2000 + 900.0 * numerics.substeps,
          .tool_ns = {},
          .seat_ns = {}};
}
Tradeoff measured() {
  return run_tradeoff(scene_on_bone(), small_grid(), some_cost, [](std::size_t, std::size_t) { return true; });
}

/// Error against a reference with held input: of the integrator only.
double integrator_error(Integrator how, const std::vector<ToolSample>& held, double tick_hz, std::uint8_t substeps) {
  return measure(free_task(), tick_hz, {how, Precision::kDouble, substeps}, held, held).integrator_rms_m;
}
double integrator_error(Integrator how, double tick_hz, std::uint8_t substeps) {
  return integrator_error(how, reference(free_task(), tick_hz, HandInput::kHeld), tick_hz, substeps);
}

// A held hand pulls a free tool linearly, where the matrix exponential is exact: two codes and two methods, one number.
TEST(TradeoffReference, AgreesWithTheMatrixExponentialInFreeMotion) {
  EXPECT_LT(integrator_error(Integrator::kExact, 1000, 1), 1e-13);
  EXPECT_LT(integrator_error(Integrator::kExact, 100, 4), 1e-9);
}

TEST(TradeoffReference, IsTheSameForContinuousAndHeldInputOnlyInTheLimit) {
  const ToolTask task = free_task();
  const auto error = [&](double tick_hz) {
    const auto truth = reference(task, tick_hz, HandInput::kContinuous),
               held = reference(task, tick_hz, HandInput::kHeld);
    double worst = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) worst = std::max(worst, std::abs(truth[k].x[0] - held[k].x[0]));
    return worst;
  };
  EXPECT_NEAR(error(1000) / error(2000), 2, 0.05) << "sampling the hand is an error of first order";
}

TEST(Tradeoff, ShowsTheOrderOfEachIntegrator) {
  const auto held = reference(free_task(), 1000, HandInput::kHeld);
  const auto order = [&](Integrator how) {
    return std::log2(integrator_error(how, held, 1000, 4) / integrator_error(how, held, 1000, 8));
  };
  EXPECT_NEAR(order(Integrator::kImplicitEuler), 1, 0.1);
  EXPECT_NEAR(order(Integrator::kSemiImplicitEuler), 1, 0.1);
  EXPECT_NEAR(order(Integrator::kImplicitMidpoint), 2, 0.1);
  EXPECT_NEAR(order(Integrator::kRk4), 4, 0.3);
}

TEST(Tradeoff, MarksUnstableRows) {
  const ToolTask task = free_task();
  const auto truth = reference(task, 100, HandInput::kContinuous), held = reference(task, 100, HandInput::kHeld);
  EXPECT_FALSE(measure(task, 100, {Integrator::kRk4, Precision::kDouble, 1}, truth, held).stable);
  EXPECT_TRUE(measure(task, 100, {Integrator::kRk4, Precision::kDouble, 8}, truth, held).stable);
}

TEST(Tradeoff, MarksExactlyTheRowsThatNoOtherBeats) {
  std::vector<Row> rows(5);
  const std::array<std::array<double, 2>, 5> force_and_work{{{1, 10}, {2, 5}, {2, 6}, {0.5, 20}, {0.1, 1}}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].force_rms_n = force_and_work[i][0];
    rows[i].tick_hz = 1;
    rows[i].cost.seat_instructions = force_and_work[i][1];
  }
  rows[4].stable = false;
  mark_pareto(rows);
  EXPECT_TRUE(rows[0].pareto && rows[1].pareto && rows[3].pareto);
  EXPECT_FALSE(rows[2].pareto) << "worse than row 1 in work";
  EXPECT_FALSE(rows[4].pareto) << "unstable";
}

TEST(Tradeoff, AdvisesARowThatSatisfiesEachRule) {
  const Tradeoff result = measured();
  ASSERT_EQ(result.rows.size(), 2u * 2 * control::kIntegrators * 2);
  ASSERT_EQ(result.advice.size(), 3u);
  const Advice &lesson = result.advice[0], &many = result.advice[1], &figure = result.advice[2];
  ASSERT_TRUE(lesson.row && many.row && figure.row);
  EXPECT_TRUE(lesson.row->numerics.keeps_proof() && many.row->numerics.keeps_proof());
  EXPECT_LE(lesson.row->force_rms_n, std::max(kLessonError * result.force_rms_n, kLessonForce));
  EXPECT_GE(many.row->tick_hz, 1000);
  for (const Row& row : result.rows) {
    if (row.stable) {
      EXPECT_LE(figure.row->force_rms_n, (1 + kAdviceMargin) * row.force_rms_n);
    }
  }
  Tradeoff uncounted = result;
  for (Row& row : uncounted.rows) row.cost = {};
  EXPECT_FALSE(advice_for(uncounted)[1].row) << "a budget of instructions needs counted instructions";
}

/// Rows of one tick rate with these force errors and works: double, float, float.
Tradeoff three_rows(const std::array<double, 3>& force_n, const std::array<double, 3>& work) {
  Tradeoff out;
  out.rows.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    out.rows[i].tick_hz = 1000;
    out.rows[i].force_rms_n = force_n[i];
    out.rows[i].cost.seat_instructions = work[i];
    if (i > 0) out.rows[i].numerics.precision = Precision::kFloat;
  }
  return out;
}
bool figure_is_double(const Tradeoff& tradeoff) {
  return advice_for(tradeoff)[2].row->numerics.precision == Precision::kDouble;
}

TEST(TradeoffAdvice, PrefersDoubleUnlessFloatIsBetterByMoreThanTheMargin) {
  EXPECT_TRUE(figure_is_double(three_rows({1e-3, 0.998e-3, 1e-3}, {3000, 2990, 2900})));
  EXPECT_TRUE(figure_is_double(three_rows({1.049e-3, 1e-3, 1e-3}, {3000, 1000, 1000}))) << "at any work";
  EXPECT_FALSE(figure_is_double(three_rows({1.051e-3, 1e-3, 1e-3}, {3000, 3000, 3000})));
}

TEST(TradeoffAdvice, PrefersTheSmallerErrorAmongRowsOfEqualWork) {
  Tradeoff rows = three_rows({1e-3, 2e-3, 3e-3}, {1040, 1000, 2000});
  for (Row& row : rows.rows) row.numerics.precision = Precision::kDouble;
  EXPECT_EQ(advice_for(rows)[0].row->force_rms_n, 1e-3);
  rows.rows[0].cost.seat_instructions = 1051;
  EXPECT_EQ(advice_for(rows)[0].row->force_rms_n, 2e-3) << "more than 5 % dearer";
}

TEST(TradeoffAdvice, BreaksTiesByTheProofAndThenByWork) {
  Tradeoff rows = three_rows({1e-3, 1e-3, 1e-3}, {3000, 2000, 2500});
  for (Row& row : rows.rows) row.numerics.precision = Precision::kDouble;
  rows.rows[1].numerics.integrator = Integrator::kRk4;
  EXPECT_EQ(advice_for(rows)[2].row->work_per_s(), 2500e3) << "not rk4, which is cheaper";
}

TEST(Tradeoff, PrintsTheSameBytesTwice) {
  const Tradeoff first = measured(), second = measured();
  EXPECT_EQ(tradeoff_text(first, true, false), tradeoff_text(second, true, false));
  EXPECT_EQ(tradeoff_csv(first, false), tradeoff_csv(second, false));
  EXPECT_EQ(tradeoff_svg(first), tradeoff_svg(second));
  const std::string csv = tradeoff_csv(first, false);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 41);
  EXPECT_EQ(csv.find("[ns]"), std::string::npos);
  EXPECT_NE(tradeoff_csv(first, true).find("seat[ns]"), std::string::npos);
  EXPECT_NE(tradeoff_svg(first).find("semi_implicit_euler"), std::string::npos);
}

TEST(Tradeoff, StopsWhereItsCallerSays) {
  const Tradeoff result =
      run_tradeoff(scene_on_bone(), small_grid(), some_cost, [](std::size_t done, std::size_t) { return done < 3; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.rows.size(), 3u);
}

}  // namespace
}  // namespace tandem::netsim::tradeoff
