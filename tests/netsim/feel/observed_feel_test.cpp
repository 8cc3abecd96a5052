// Haptic measures of a run, from constructed records whose results are known.
#include "netsim/feel/observed_feel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "netsim/system/run_simulation.h"
#include "tests/support/simulation_run.h"

namespace tandem::netsim {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

using Fill = std::function<void(double t, server::TickRecord& record)>;

/// Returns the measures of `contact` for `length` seconds. Both hands are engaged and seat 0 leads, unless `fill`
/// changes that.
std::map<std::string, double> observed(double length, const Fill& fill, std::vector<std::uint32_t> trips = {0, 0}) {
  const SceneSpec scene = tandem::test::shipped("contact");
  ObservedFeel feel{scene};
  for (std::uint32_t tick = 1; tick <= length * scene.tick_hz; ++tick) {
    server::TickRecord record;
    record.tick = tick;
    record.running = true;
    record.seats[0].alpha = 1;
    record.seats[0].engaged = record.seats[1].engaged = true;
    record.tools[0].held = false;
    fill(tick / scene.tick_hz, record);
    feel.add(record);
  }
  std::map<std::string, double> out;
  for (const auto& [key, value] : feel.values(trips)) out[key] = value;
  return out;
}

TEST(ObservedFeel, FindsTheStiffnessOfAPressedSpring) {
  const auto v = observed(11, [](double t, server::TickRecord& r) {
    const double depth = 1e-3 * (t - 1);
    r.seats[0].x[0] = depth;
    r.seats[0].f_out[0] = -300 * depth;
    r.tools[0].f_env[0] = -300 * depth - 0.06;
  });
  EXPECT_NEAR(v.at("stiffness_felt_n_m"), 300, 1e-6);
  EXPECT_TRUE(std::isnan(v.at("drag_n"))) << "nothing moved freely";
}

TEST(ObservedFeel, FindsNoStiffnessWithoutContactOrDepth) {
  EXPECT_TRUE(std::isnan(observed(5, [](double, server::TickRecord&) {}).at("stiffness_felt_n_m")));
  EXPECT_TRUE(std::isnan(observed(5, [](double, server::TickRecord& r) {
                           r.tools[0].f_env[0] = -1;
                           r.seats[0].f_out[0] = -1;
                         }).at("stiffness_felt_n_m")));
}

TEST(ObservedFeel, TakesDragFromTheLeadersFreeMotionOnly) {
  const auto v = observed(10, [](double t, server::TickRecord& r) {
    r.seats[0].x[0] = 0.05 * std::cos(kTurn * 0.5 * t);
    r.seats[0].x[2] = 0.05 * std::sin(kTurn * 0.5 * t);
    r.seats[0].f_out[1] = 0.4;
    r.seats[1].x = r.seats[0].x;
    r.seats[1].f_out[1] = 2;  // a follower
    r.tools[0].x = r.seats[0].x;
  });
  EXPECT_NEAR(v.at("drag_n"), 0.4, 1e-9);
  EXPECT_NEAR(v.at("gain_max"), 1, 1e-6);
  EXPECT_NEAR(v.at("overshoot"), 0, 1e-3);
  EXPECT_TRUE(std::isnan(v.at("handover_bump_n")));
}

TEST(ObservedFeel, TakesGainAsToolOverHandAmplitude) {
  const auto v = observed(20, [](double t, server::TickRecord& r) {
    r.seats[0].x[0] = 0.03 * std::sin(kTurn * 0.5 * t) + 0.002 * std::sin(kTurn * 6 * t);
    r.tools[0].x[0] = 0.03 * std::sin(kTurn * 0.5 * t) + 0.009 * std::sin(kTurn * 6 * t - 1);
  });
  EXPECT_NEAR(v.at("gain_max"), 4.5, 0.02);
}

TEST(ObservedFeel, TakesOvershootBeyondTheHandsLastSecond) {
  const auto v = observed(4, [](double t, server::TickRecord& r) {
    r.seats[0].x[0] = t < 2 ? 0 : 0.02;
    r.tools[0].x[0] = t < 2.1 ? 0 : t < 2.3 ? 0.026 : 0.02;
  });
  EXPECT_NEAR(v.at("overshoot"), 0.3, 1e-6);
}

TEST(ObservedFeel, TakesTheFastForceAtRestAsLimitCycle) {
  const auto v =
      observed(12, [](double t, server::TickRecord& r) { r.seats[1].f_out[0] = 0.5 + 0.1 * std::sin(kTurn * 15 * t); });
  EXPECT_NEAR(v.at("limit_cycle_n"), 0.1 / std::sqrt(2.0), 0.002);
}

TEST(ObservedFeel, MeasuresATransferUntilHalfASecondAfterItsEnd) {
  const auto v = observed(10, [](double t, server::TickRecord& r) {
    r.seats[0].alpha = t < 5 ? 1 : std::max(0.0, 6 - t);
    r.seats[1].alpha = 1 - r.seats[0].alpha;
    r.seats[0].f_out[0] = t < 5.5 ? 1 : t < 6.8 ? 1.3 : 3;  // the last step does not count
  });
  EXPECT_NEAR(v.at("handover_bump_n"), 0.3, 1e-9);
  EXPECT_NEAR(v.at("handover_step_n_ms"), 0.3, 1e-9);
}

TEST(ObservedFeel, TakesSharesOfTheWorstSeat) {
  const auto v = observed(11,
                          [](double t, server::TickRecord& r) {
                            r.seats[1].engaged = t < 8.5;           // three quarters of 10 s
                            r.seats[0].f_out[0] = t < 6 ? 3.3 : 0;  // half of that time
                            r.seats[0].f_cmd[0] = r.seats[0].f_out[0] + 0.2;
                            r.tools[0].held = t > 10;
                          },
                          {1, 5});
  EXPECT_NEAR(v.at("engaged_share"), 0.75, 1e-3);
  EXPECT_NEAR(v.at("saturated_share"), 0.5, 1e-3);
  EXPECT_NEAR(v.at("held_share"), 0.1, 1e-3);
  EXPECT_NEAR(v.at("trips_per_min"), 30, 0.02);
  EXPECT_NEAR(v.at("delivered_error_n"), 0.2, 1e-9);
}

TEST(ObservedFeel, IsPartOfEverySimulationReport) {
  for (const auto& [scene, stiffness] :
       {std::pair{tandem::test::set_position("contact"), 112.0}, {tandem::test::shipped("contact"), 365.0}}) {
    const SimulationResult run = run_simulation({.scene = scene, .network = link_from(tandem::test::delayed(20))});
    ASSERT_EQ(run.report.feel.size(), ObservedFeel::keys().size());
    EXPECT_EQ(run.report.feel[0].first, "stiffness_felt_n_m");
    EXPECT_NEAR(run.report.feel[0].second, stiffness, 5) << "as measured independently and by `tandem-netsim feel`";
    EXPECT_NE(server::to_json(run.report).find("\"stiffness_felt_n_m\""), std::string::npos);
  }
}

}  // namespace
}  // namespace tandem::netsim
