// Presets: shipped scenes for ways of teaching. The scenario of the same name states the limits of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "netsim/app/scenario_loader.h"
#include "netsim/app/seed_run.h"
#include "netsim/app/test_run.h"
#include "netsim/scenario/shipped_scenarios.h"
#include "tests/common/base/counts.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using netsim::Scenario;
using netsim::SeedOutcome;

class Preset : public ::testing::TestWithParam<std::string> {
 protected:
  Scenario scenario() {
    const EmbeddedFile* const file = netsim::find_shipped_scenario(GetParam());
    EXPECT_NE(file, nullptr);
    if (file == nullptr) return {};
    auto loaded = netsim::load_scenario_text(std::string(file->text), GetParam(), true);
    EXPECT_TRUE(loaded.has_value());
    if (!loaded) return {};
    std::string scene = loaded->setup.scene.name;
    std::ranges::replace(scene, '_', '-');
    EXPECT_EQ(scene, GetParam()) << "a preset and its limits have the same name";
    return *loaded;
  }
};

std::string text_of(const Scenario& scenario, const SeedOutcome& outcome) {
  std::string all = std::string(netsim::name(outcome.state)) + "\n";
  for (const std::string& cause : netsim::causes(scenario, outcome)) all += cause + "\n";
  return all;
}

/// The network of the scenario is the worst for which its limits hold; without delay, jitter and loss they hold too.
TEST_P(Preset, KeepsAllInvariantsAndItsLimitsOverDelaysAndSeeds) {
  const Scenario on_its_network = scenario();
  for (const double delay_ms : {0.0, 20.0}) {
    SCOPED_TRACE(delay_ms);
    Scenario one = on_its_network;
    if (delay_ms == 0) one.setup.network = netsim::link_from(test::delayed(0));
    for (std::uint64_t seed = 1, last = test::seeds(delay_ms == 0 ? 1 : 2); seed <= last; ++seed) {
      const SeedOutcome outcome = netsim::run_seed(one, seed, {});
      EXPECT_EQ(outcome.state, SeedOutcome::State::kPass)
          << text_of(one, outcome) << "tandem-netsim test " << GetParam() << " --seed " << seed << " --seeds 1";
      EXPECT_TRUE(outcome.violations.empty());
    }
  }
}

/// Negative control: law SET_POSITION, whose hands feel the network. In `guidance` both hands give way, so that its
/// error is as small; law RAW oscillates there.
TEST_P(Preset, BreaksALimitUnderAWorseLaw) {
  Scenario worse = scenario();
  worse.setup.scene.channel.law = GetParam() == "guidance" ? LawKind::kRaw : LawKind::kSetPosition;
  const SeedOutcome outcome = netsim::run_seed(worse, 1, {});
  EXPECT_EQ(outcome.state, SeedOutcome::State::kFail) << text_of(worse, outcome);
}

/// Negative control: three tenths of each tool's authority go to the last seat that may lead.
TEST_P(Preset, BreaksALimitWithWrongAuthority) {
  Scenario wrong = scenario();
  SceneSpec& scene = wrong.setup.scene;
  std::size_t last = 0;
  for (std::size_t i = 0; i < scene.masters(); ++i)
    if (scene.seats[i].role != Role::kEvaluator && scene.seats[i].role != Role::kObserver) last = i;
  if (last == 0) {  // a single seat leads: an evaluator gets the authority
    last = 1;
    scene.seats[1].role = Role::kTrainee;
  }
  const auto move = [&](AuthorityRow& row) {
    double moved = 0;
    for (double& alpha : row.alpha) {
      moved += 0.3 * alpha;
      alpha *= 0.7;
    }
    row.alpha[last] += moved;
  };
  std::ranges::for_each(scene.authority, move);
  for (TimedAuthority& change : scene.timeline) move(change.row);
  const SeedOutcome outcome = netsim::run_seed(wrong, 1, {});
  EXPECT_EQ(outcome.state, SeedOutcome::State::kFail) << text_of(wrong, outcome);
}

INSTANTIATE_TEST_SUITE_P(All, Preset,
                         ::testing::Values("demonstration", "guidance", "evaluation", "eight-evaluators",
                                           "seven-trainees", "two-by-two", "cooperative-slave"),
                         [](const auto& preset) {
                           std::string name = preset.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace tandem
