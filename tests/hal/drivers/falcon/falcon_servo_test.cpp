#include <gtest/gtest.h>

#include <cmath>

#include "hal/core/servo_core.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

/// Client that holds the tip at a point with a spring and a damper.
struct Holder final : ServoClient {
  Command tick(const State& s) noexcept override {
    state = s;
    const Vec3 force = k * (target - s.x) - b * s.dx;
    const Vec3 tau = s.J.leftCols<3>().transpose() * force;
    Command command{.seq = ++seq, .expires = s.sampled_at + 5ms, .kind = CommandKind::kJointEffort};
    for (std::size_t i = 0; i < 3; ++i) command.effort[i] = tau[static_cast<int>(i)];
    return command;
  }
  void lost(Errc) noexcept override { gone = true; }
  double k = 300, b = 2;
  Vec3 target = Vec3::Zero();
  std::uint64_t seq = 0;
  State state;
  bool gone = false;
};

struct FalconServoTest : testing::Test {
  void make(const emulation::FalconModelSpec& spec, const FalconSpec& file = falcon::calibrated()) {
    model.emplace(spec);
    clock.emplace(*model);
    pipe.emplace(*model, *clock, kFalconOut, kFalconIn);
    core.emplace(std::make_unique<FalconDriver>(
        *FalconDriver::make({"falcon", "1-2"}, *pipe, *clock, {file, falcon::some_firmware()})));
  }
  void run(Duration length) {
    for (const Time end = clock->now() + length; clock->now() < end;) {
      const Time next = clock->now() + 1ms;
      if (!core->step(clock->now(), client)) return;
      clock->wait_until(next);
    }
  }
  void pull_out_and_in() {
    for (const double y : {-0.06, 0.03, 0.0}) {
      model->mechanics().set_pull({.k = 300, .b = 10, .m = 0.2, .x = Vec3(0, y, 0)});
      run(400ms);
    }
  }
  std::optional<emulation::FalconModel> model;
  std::optional<emulation::ModelClock> clock;
  std::optional<emulation::UsbModelPipe> pipe;
  std::optional<ServoCore> core;
  Holder client;
  falcon::Watcher watcher;
};

TEST_F(FalconServoTest, GivesForceAfterPowerUp) {
  make({});
  ASSERT_TRUE(core->bring_up(watcher));
  EXPECT_EQ(core->phase(), Phase::kUnhomed);
  run(100ms);
  EXPECT_EQ(core->enable().error().code, Errc::kNotHomed);
  EXPECT_EQ(model->order().motor, (std::array<std::int16_t, 3>{}));
  pull_out_and_in();
  ASSERT_EQ(core->phase(), Phase::kReady);
  EXPECT_EQ(model->order().motor, (std::array<std::int16_t, 3>{})) << "ready is zero force";
  ASSERT_TRUE(core->enable());
  // The hand's intended position is 20 mm away; the two springs share this distance.
  model->mechanics().set_pull({.k = 200, .b = 5, .m = 0.2, .x = Vec3(0.02, 0, 0)});
  run(3s);
  ASSERT_EQ(core->phase(), Phase::kEnabled);
  EXPECT_NEAR(client.state.x[0], 0.02 * 200 / 500, 4e-4);
  EXPECT_NEAR(model->mechanics().motor_force()[0], -300 * 0.008, 0.1);
  EXPECT_NEAR(client.state.f_out[0], model->mechanics().motor_force()[0], 0.05);
  EXPECT_EQ(model->unsafe_frames(), 0u);
  EXPECT_EQ(model->bad_frames(), 0u);
  EXPECT_EQ(core->counts().unanswered, 0u);
}

TEST_F(FalconServoTest, FaultsWithZerosWhenTheDeviceIsSilent) {
  make(falcon::ready_model());
  ASSERT_TRUE(core->bring_up(watcher));
  run(20ms);
  ASSERT_TRUE(core->enable());
  client.target = Vec3(0.01, 0, 0);
  model->mechanics().set_pull({.k = 500, .b = 10, .m = 0.2, .x = Vec3::Zero()});
  run(1s);
  ASSERT_NE(model->order().motor[0], 0);
  model->faults.silent = true;
  run(30ms);
  EXPECT_EQ(core->phase(), Phase::kFault);
  EXPECT_EQ(model->order().motor, (std::array<std::int16_t, 3>{}))
      << "the device hears zeros although it does not answer";
}

TEST_F(FalconServoTest, RemovesForceAfterALostFlagUntilHomedAndEnabled) {
  make(falcon::ready_model());
  ASSERT_TRUE(core->bring_up(watcher));
  run(20ms);
  ASSERT_TRUE(core->enable());
  run(600ms);
  model->drop_homed(7);
  run(5ms);
  EXPECT_EQ(core->phase(), Phase::kUnhomed);
  EXPECT_EQ(model->order().motor, (std::array<std::int16_t, 3>{}));
  EXPECT_TRUE(model->order().homing);
  const auto unsafe = model->unsafe_frames();
  pull_out_and_in();
  EXPECT_EQ(core->phase(), Phase::kReady);
  EXPECT_EQ(model->unsafe_frames(), unsafe);
  EXPECT_EQ(model->order().motor, (std::array<std::int16_t, 3>{}));
}

TEST_F(FalconServoTest, ReportsUnpluggingToTheClientAtOnce) {
  make(falcon::ready_model());
  ASSERT_TRUE(core->bring_up(watcher));
  run(20ms);
  model->unplug();
  run(5ms);
  EXPECT_EQ(core->phase(), Phase::kLost);
  EXPECT_TRUE(client.gone);
}

TEST_F(FalconServoTest, ReloadsFrozenFirmwareHereOrInTheNextProgram) {
  for (const bool here : {true, false}) {
    make({});
    model->faults.frozen_loads = 1;
    ASSERT_TRUE(core->bring_up(watcher));
    run(31s);
    ASSERT_EQ(core->phase(), Phase::kBooting);
    EXPECT_EQ(model->loads(), 1u);
    EXPECT_EQ(model->order().motor, (std::array<std::int16_t, 3>{}));
    if (!here) {
      core->send_zeros();
      EXPECT_FALSE(model->running());
      core.emplace(std::make_unique<FalconDriver>(
          *FalconDriver::make({"falcon", "1-2"}, *pipe, *clock, {falcon::calibrated(), falcon::some_firmware()})));
    }
    ASSERT_TRUE(core->bring_up(watcher));
    EXPECT_EQ(model->loads(), 2u);
    run(100ms);
    pull_out_and_in();
    EXPECT_EQ(core->phase(), Phase::kReady);
  }
}

TEST_F(FalconServoTest, KeepsUncalibratedForcesSmall) {
  make(falcon::ready_model(), FalconSpec{});
  ASSERT_TRUE(core->bring_up(watcher));
  run(20ms);
  ASSERT_TRUE(core->enable());
  client.target = Vec3(0.04, 0, 0);
  client.k = 2000;
  model->mechanics().set_pull({.k = 3000, .b = 20, .m = 0.2, .x = Vec3::Zero()});
  run(2s);
  EXPECT_GT(model->mechanics().motor_force().norm(), 0.05) << "there is some";
  for (const auto c : model->order().motor) EXPECT_LE(std::abs(c), kFalconCeilingGuess);
  EXPECT_TRUE(client.state.saturated);
}

}  // namespace
}  // namespace tandem::hal
