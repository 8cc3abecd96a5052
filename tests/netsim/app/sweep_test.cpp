// Sweeps of delay, jitter and loss: independent of parallel runs, cells that could not run, lists of axes.
#include "netsim/app/sweep.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "netsim/app/scenario_loader.h"

namespace tandem::netsim {
namespace {

/// Two seconds on one axis.
SweepSpec small_sweep() {
  auto scenario = load_scenario_text("version: 1 scene: \"one_axis\" duration_s: 2", "some.textproto", false);
  if (!scenario) throw std::runtime_error(to_text(scenario.error()));
  SweepSpec spec;
  spec.scene = scenario->setup.scene;
  spec.scene_name = "one_axis";
  spec.options = "--duration 2";
  return spec;
}

TEST(Sweep, MapsAGridIndependentlyOfTheNumberOfJobs) {
  std::vector<std::string> all;
  for (const std::size_t jobs : {1u, 3u}) {
    SweepSpec spec = small_sweep();
    spec.delays_ms = {0, 40};
    spec.losses_percent = {0, 10};
    const Sweep sweep = run_sweep(spec, {.seed = 3, .seeds = 2, .jobs = jobs});
    EXPECT_TRUE(sweep.good());
    ASSERT_EQ(sweep.points.size(), 4u);
    EXPECT_EQ(sweep.points[1].loss_percent, 10) << "loss is innermost";
    EXPECT_EQ(sweep.points[2].delay_ms, 40);
    EXPECT_GT(sweep.points[2].worst, 2 * sweep.points[0].worst) << "delay costs tracking";
    EXPECT_GE(sweep.points[3].worst, sweep.points[3].median);
    EXPECT_EQ(sweep.runs.scenarios[0].seeds[0].seed, 3u);
    all.push_back(sweep_map(sweep) + sweep_csv(sweep) + sweep_json(sweep));
  }
  EXPECT_EQ(all[0], all[1]);
  EXPECT_NE(all[0].find("delay[ms],jitter[ms],loss[%],worst[m],median[m],worst_seed[1],broken[1],trouble[1]\n0,0,0,"),
            std::string::npos);
  EXPECT_NE(
      all[0].find("tandem-netsim run one_axis --delay 40 --jitter 0 --loss 10 --seed 4 --duration 2 --trace out.csv"),
      std::string::npos)
      << all[0];
}

TEST(Sweep, MarksCellsThatCouldNotRun) {
  SweepSpec spec = small_sweep();
  spec.delays_ms = {0, 5000};
  spec.metric = "rtt_p50_ms";
  const Sweep sweep = run_sweep(spec, {.seeds = 1});
  EXPECT_FALSE(sweep.good());
  EXPECT_FALSE(sweep.points[0].trouble);
  EXPECT_TRUE(sweep.points[1].trouble);
  EXPECT_NE(sweep_map(sweep).find(" T"), std::string::npos);
  EXPECT_NE(sweep_map(sweep).find("loop_age_max_ms"), std::string::npos) << sweep_map(sweep);
}

TEST(Sweep, AxesAreListsOfNumbersInRange) {
  EXPECT_EQ(*parse_axis("0,20,50.5", 0, 100, "ms"), (std::vector<double>{0, 20, 50.5}));
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{{"", "is not a number"},
                                                                                   {"1,,2", "\"\" is not a number"},
                                                                                   {"1,2x", "\"2x\" is not a number"},
                                                                                   {"nan", "is not a number"},
                                                                                   {"1,-1", "\"-1\" is out of range"},
                                                                                   {"101", "[0, 100] ms"},
                                                                                   {"1,2,1", "\"1\" is there twice"}}) {
    const auto axis = parse_axis(text, 0, 100, "ms");
    ASSERT_FALSE(axis) << text;
    EXPECT_NE(axis.error().find(says), std::string::npos) << axis.error();
  }
  EXPECT_EQ(sweep_metric("held_s"), Limit::Of::kTool);
  EXPECT_EQ(sweep_metric("tracking_rms_m"), Limit::Of::kSeat);
  EXPECT_NE(sweep_metric("traking_rms_m").error().find("did you mean tracking_rms_m?"), std::string::npos);
}

}  // namespace
}  // namespace tandem::netsim
