#include <gtest/gtest.h>

#include "hal/core/servo_core.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"

namespace tandem::hal::woodenhaptics {
namespace {

using namespace std::chrono_literals;
using test::WoodenHapticsFixture;

WoodenHapticsOptions energised() { return {.spec = test::wooden_2015(), .enable_motors = true}; }

std::size_t presets(const emulation::WoodenHapticsModel& model) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < model.host_reports() && i < emulation::WoodenHapticsModel::kRemembered; ++i) {
    n += model.host_report(i).preset ? 1 : 0;
  }
  return n;
}

TEST(WoodenHoming, HomesAtTheButton) {
  WoodenHapticsFixture b;
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.step());
  EXPECT_EQ(presets(b.model), 0u);
  b.model.press_calibration();
  int exchanges = 0;
  while (!b.driver.homed() && ++exchanges < 20) ASSERT_TRUE(b.step());
  EXPECT_LE(exchanges, 3);
  EXPECT_TRUE(b.state.resynced) << "the origin moved";
  EXPECT_EQ(b.state.raw[2], 6000);
  EXPECT_LT((b.state.x - Vec3(0, -0.025, 0.205)).norm(), 1e-12);
  ASSERT_EQ(b.step(), Exchange::kFresh);
  EXPECT_EQ(b.state.buttons, 0u) << "the latch is released";
}

TEST(WoodenHoming, IgnoresAButtonPressedBeforeTheStart) {
  WoodenHapticsFixture b;
  b.model.press_calibration();
  ASSERT_TRUE(b.bring_up());
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(b.step());
  EXPECT_FALSE(b.driver.homed());
  EXPECT_EQ(b.state.buttons, 0u);
  EXPECT_TRUE(b.home()) << "the next press counts";
}

TEST(WoodenHoming, IgnoresAButtonPressWhileHomed) {
  WoodenHapticsFixture b;
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  ASSERT_TRUE(b.walk_to(Vec3::Zero()));
  const std::size_t before = presets(b.model);
  b.model.press_calibration();
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(b.step(Vec3(0.1, 0, 0)), Exchange::kFresh);
    ASSERT_TRUE(b.state.homed);
    ASSERT_LT((b.state.x - b.model.tip()).norm(), 1e-4);
  }
  EXPECT_EQ(presets(b.model), before);
  // The reference is lost with the latch still set: this is no new press, so there is no origin.
  b.model.place(b.model.tip() + Vec3(0.06, 0, 0));
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(b.step(Vec3(0.1, 0, 0)));
  EXPECT_FALSE(b.driver.homed());
  EXPECT_EQ(b.state.buttons, 0u);
  EXPECT_EQ(b.model.motor_effort(), Vec3::Zero());
}

TEST(WoodenHoming, AcceptsHomeHereOnlyWithoutEffort) {
  WoodenHapticsFixture b(energised());
  ASSERT_TRUE(b.bring_up());
  b.driver.home_here();
  ASSERT_TRUE(b.step(Vec3(0.1, 0, 0)));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(b.step());
  EXPECT_FALSE(b.driver.homed()) << "and is forgotten, not kept for later";
  b.driver.home_here();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step());
  EXPECT_TRUE(b.driver.homed());
}

TEST(WoodenHoming, AppliesHomeAtStartOnce) {
  WoodenHapticsOptions options = energised();
  options.home_at_start = true;
  WoodenHapticsFixture b(options);
  ASSERT_TRUE(b.bring_up());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step());
  EXPECT_TRUE(b.driver.homed());
  ASSERT_TRUE(b.bring_up()) << "brought up again after trouble";
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(b.step());
  EXPECT_FALSE(b.driver.homed());
}

TEST(WoodenHoming, HomesAMovingArmAtItsPosition) {
  WoodenHapticsFixture b;
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.step());
  b.model.press_calibration();
  const Vec3 start = b.model.tip();
  for (int i = 1; i <= 20; ++i) {  // 0.1 m/s
    b.model.place(start + Vec3(0.0001 * i, 0, 0));
    ASSERT_TRUE(b.step());
  }
  ASSERT_TRUE(b.driver.homed());
  EXPECT_LT((b.state.x - b.model.tip()).norm(), 5e-4) << "off by what it moved before the preset arrived";
}

TEST(WoodenHoming, BecomesUnhomedAtOnceAfterPowerLoss) {
  WoodenHapticsFixture b(energised());
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  ASSERT_TRUE(b.walk_to(Vec3::Zero()));
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step(Vec3(0.1, 0.1, 0.1)));
  ASSERT_NE(b.model.motor_effort(), Vec3::Zero());
  b.model.unplug();
  b.model.plug_in();  // too quickly for any call to notice: counters begin at zero
  ASSERT_EQ(b.step(Vec3(0.1, 0.1, 0.1)), Exchange::kResynced);
  EXPECT_FALSE(b.state.homed);
  ASSERT_TRUE(b.step(Vec3(0.1, 0.1, 0.1)));
  EXPECT_EQ(b.model.motor_effort(), Vec3::Zero());
}

struct Pusher final : ServoClient {
  Time now{};
  bool is_lost = false;
  Command tick(const State& state) noexcept override {
    Command c{.seq = state.seq, .expires = now + 5ms, .kind = CommandKind::kJointEffort};
    c.effort = {0.05, 0.02, 0.02};
    return c;
  }
  void lost(Errc) noexcept override { is_lost = true; }
};

TEST(WoodenHoming, WorksThroughoutUnderAServoCore) {
  WoodenHapticsOptions options = energised();
  options.spec.force_checked = true;
  emulation::WoodenHapticsModel model(WoodenHapticsFixture::at_calibration(options.spec, {}));
  model.place(model.tip());
  test::HidModelClock time(model);
  test::HidModelPipe pipe(model, time);
  ServoCore core(std::make_unique<WoodenHapticsDriver>(DeviceId{"woodenhaptics", "1"}, pipe, time, options),
                 MotorSigns::kConfirmed);
  test::QuietBringUp watcher;
  ASSERT_TRUE(core.bring_up(watcher));
  Pusher client;
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      time.wait_until(time.now() + 1ms);
      client.now = time.now();
      if (!core.step(time.now(), client)) return false;
    }
    return true;
  };
  ASSERT_TRUE(run(20));
  EXPECT_EQ(core.phase(), Phase::kUnhomed);
  EXPECT_FALSE(core.enable());
  model.press_calibration();
  ASSERT_TRUE(run(20));
  EXPECT_EQ(core.phase(), Phase::kReady);
  EXPECT_EQ(model.motor_effort(), Vec3::Zero());
  ASSERT_TRUE(core.enable());
  ASSERT_TRUE(run(1000));
  EXPECT_EQ(core.phase(), Phase::kEnabled);
  EXPECT_NEAR(model.motor_effort()[0], 0.05, 1e-3);

  model.faults.silent = true;
  ASSERT_TRUE(run(20));
  EXPECT_EQ(core.phase(), Phase::kFault);
  EXPECT_EQ(model.motor_effort(), Vec3::Zero()) << "still spoken to, with zeros";
  model.faults.silent = false;
  ASSERT_TRUE(core.reset());
  ASSERT_TRUE(run(20));
  EXPECT_EQ(core.phase(), Phase::kReady);
  ASSERT_TRUE(core.enable());
  ASSERT_TRUE(run(600));
  ASSERT_NE(model.motor_effort(), Vec3::Zero());

  model.unplug();
  EXPECT_FALSE(run(1));
  EXPECT_EQ(core.phase(), Phase::kLost);
  EXPECT_TRUE(client.is_lost);
  model.plug_in();
  EXPECT_FALSE(run(1)) << "the returning device counts as another one";
  EXPECT_FALSE(model.amplifiers_on());
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
