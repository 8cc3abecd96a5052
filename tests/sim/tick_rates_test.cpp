// Forces and links at every tick rate of a scene, in virtual time.
#include <gtest/gtest.h>

#include "netsim/system/not_engaged_reason.h"
#include "proto/text/scene_text.h"
#include "tests/support/press_scene.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using test::PressScene;

SceneSpec parsed(const PressScene& press) {
  auto scene = parse_scene(press.text(), "press.textproto");
  if (!scene) throw std::runtime_error(to_text(scene.error()));
  return *scene;
}

std::unique_ptr<netsim::Simulation> simulation_config_of(const PressScene& press, double delay_ms = 0) {
  auto made = netsim::Simulation::make({parsed(press), netsim::link_from(test::delayed(delay_ms)), 1, {}});
  if (!made) throw std::runtime_error(made.error());
  return std::move(*made);
}

struct Pressed {
  double force = 0;      ///< mean that the motor gave after the hand came to rest [N]
  double commanded = 0;  ///< mean that the seat requested [N]
  std::uint64_t expired = 0;
  std::string trouble;
};

Pressed pressed(const PressScene& press, double delay_ms = 0) {
  const auto simulation = simulation_config_of(press, delay_ms);
  Pressed out;
  std::size_t n = 0;
  while (simulation->step()) {
    if (!press.rests(simulation->session().clock().time())) continue;
    ++n;
    out.force -= simulation->device(0).state().f_out[0];
    out.commanded -= simulation->seat(0)->sample().telemetry.f_cmd[0];
  }
  out.force /= static_cast<double>(std::max<std::size_t>(n, 1));
  out.commanded /= static_cast<double>(std::max<std::size_t>(n, 1));
  out.expired = simulation->device(0).counts().expired;
  out.trouble = simulation->trouble();
  return out;
}

class TickRates : public testing::TestWithParam<double> {};

// Four springs in series, and that of the hand: the force on a resting hand does not depend on the rate.
TEST_P(TickRates, GiveTheForceOfTheSpringsInSeries) {
  PressScene press;
  press.tick_hz = GetParam();
  const Pressed p = pressed(press);
  EXPECT_EQ(p.trouble, "");
  EXPECT_NEAR(p.force / press.force(), 1, 0.02)
      << p.force << " N delivered, " << p.commanded << " N commanded, " << press.force() << " N by the springs";
  EXPECT_EQ(p.expired, 0U) << "commands that died of age between two ticks";
}

// A loop of one second, which a gate with loop_age_max_ms = 2500 accepts.
TEST_P(TickRates, EngageOverALoopOfOneSecond) {
  PressScene press;
  press.tick_hz = GetParam();
  press.duration_s = 0.5;
  const auto simulation = simulation_config_of(press, 500);
  bool engaged = false;
  while (simulation->step() && simulation->now() < Time{} + 20s)
    engaged = engaged || simulation->seat(0)->gate().active();
  EXPECT_EQ(simulation->trouble(), "");
  EXPECT_TRUE(engaged);
  EXPECT_GT(simulation->session().clock().time(), 0.4);
  EXPECT_NEAR(seconds(simulation->seat(0)->link().timing().rtt_p50()), 1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(All, TickRates,
                         testing::Values(100, 150, 200, 250, 300, 400, 500, 1000, 2000, 4000, 6000, 10000),
                         [](const auto& rate) { return std::to_string(static_cast<int>(rate.param)) + "Hz"; });

// A device whose clock is ahead shortens the validity of every command.
TEST(TickRate, RunsASimulatedDeviceOnTheSimulationsClock) {
  PressScene press;
  press.tick_hz = 100;
  const auto simulation = simulation_config_of(press);
  for (int i = 0; i < 100; ++i) {
    const Time tick = simulation->now();
    ASSERT_TRUE(simulation->step());
    ASSERT_EQ(simulation->device(0).state().sampled_at, tick) << i;
  }
}

TEST(TickRate, EngagesAt10kHzOverTheOldestPermittedLoop) {
  PressScene press;
  press.tick_hz = 10000;
  press.duration_s = 0.2;
  const auto simulation = simulation_config_of(press, 1200);
  while (simulation->step() && simulation->now() < Time{} + 20s) {
  }
  EXPECT_EQ(simulation->trouble(), "");
  EXPECT_GT(simulation->session().clock().time(), 0.1);
}

/// Returns why a session does not begin within the start timeout.
std::string refusal(int loop_age_ms, double delay_ms) {
  PressScene press;
  press.tick_hz = 100;
  press.loop_age_ms = loop_age_ms;
  press.duration_s = 1;
  const auto simulation = simulation_config_of(press, delay_ms);
  while (simulation->step()) {
  }
  return simulation->trouble();
}

TEST(TickRate, AnErrorNamesTheKeyThatForbidsTheLoopAndWhatWasMeasured) {
  const std::string old = refusal(100, 150);
  EXPECT_NE(old.find("hand could not be engaged: its loop is 3"), std::string::npos) << old;
  EXPECT_NE(old.find("gate.loop_age_max_ms = 100 (20 to 2500)"), std::string::npos) << old;
  EXPECT_EQ(old.find("silence_limit"), std::string::npos) << old;

  const std::string beyond = refusal(2500, 2100);  // older than the stored history
  EXPECT_NE(beyond.find("none of its datagrams was answered within 4000 ms"), std::string::npos) << beyond;
  EXPECT_NE(beyond.find("gate.loop_age_max_ms = 2500"), std::string::npos) << beyond;
}

TEST(TickRate, AnErrorNamesTheSilenceLimitWhereDatagramsComeTooSeldom) {
  PressScene press;
  auto made = netsim::Simulation::make(
      {parsed(press), netsim::link_from(test::with_outages(test::delayed(5), 0.06, 1.5)), 1, {}});
  ASSERT_TRUE(made);
  netsim::Simulation& simulation = **made;
  while (simulation.step() && (simulation.seat(0) == nullptr || simulation.seat(0)->gate().trips() == 0)) {
  }
  for (int i = 0; i < 200; ++i) simulation.step();
  const std::string why = netsim::not_engaged_reason(simulation.scene(), 0, simulation.seat(0), simulation.session(),
                                                     simulation.now(), simulation.now());
  EXPECT_NE(why.find("gate.silence_limit_ms = 20"), std::string::npos) << why;
  EXPECT_NE(why.find("up to 6"), std::string::npos) << why;
  EXPECT_EQ(why.find("loop_age"), std::string::npos) << why;
}

}  // namespace
}  // namespace tandem
