#include "hal/drivers/falcon/falcon_driver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/hal/drivers/falcon/falcon_fixture.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal {
namespace {

using falcon::FalconFixture;
using falcon::Watcher;

ServoCommand effort(double a, double b, double c, std::uint64_t seq = 1) {
  ServoCommand command{.seq = seq};
  command.effort[0] = a;
  command.effort[1] = b;
  command.effort[2] = c;
  return command;
}

struct FalconDriverTest : testing::Test {
  FalconFixture ready(const FalconSpec& spec = falcon::calibrated()) {
    return FalconFixture(falcon::ready_model(), spec);
  }
  void up(FalconFixture& bench) {
    Watcher watcher;
    const auto result = bench.driver.bring_up(watcher);
    ASSERT_TRUE(result) << result.error().message;
    bench.begin();
  }
};

TEST_F(FalconDriverTest, DeclaresWhatItIs) {
  FalconFixture bench = ready();
  const DeviceCaps& caps = bench.driver.caps();
  EXPECT_EQ(caps.joints, 3u);
  EXPECT_EQ(caps.timing, Timing::kLockStep);
  EXPECT_EQ(caps.homing, Homing::kManual);
  EXPECT_TRUE(caps.needs_firmware);
  EXPECT_TRUE(caps.force_calibrated);
  EXPECT_FALSE(caps.watchdog);
  EXPECT_FALSE(caps.axis[0].continuous);
  EXPECT_EQ(caps.axis[0].from, Provenance::kConfig);
  ASSERT_TRUE(caps.axis[1].peak);
  EXPECT_GT(*caps.axis[1].peak, 10);
  FalconFixture guess(falcon::ready_model(), FalconSpec{});
  EXPECT_FALSE(guess.driver.caps().force_calibrated);
  EXPECT_EQ(guess.driver.caps().axis[0].from, Provenance::kUnknown);
  // The peak of the motors; the driver's ceiling and the guard limit the force far below it.
  EXPECT_NEAR(*guess.driver.caps().axis[1].peak, 5 * *caps.axis[1].peak, 1e-9);
}

TEST_F(FalconDriverTest, ReportsTheTipPosition) {
  emulation::FalconModelSpec spec = falcon::ready_model();
  spec.mechanics.start = Vec3(0.02, -0.01, 0.015);
  FalconFixture bench(spec);
  up(bench);
  ASSERT_EQ(*bench.tick(), Exchange::kFresh);
  EXPECT_TRUE(bench.state.homed);
  EXPECT_LE((bench.state.x - spec.mechanics.start).norm(), 60e-6) << "half a count per leg";
  EXPECT_EQ(bench.state.raw[0], bench.model.mechanics().encoder()[0]);
  EXPECT_LE((bench.state.J.leftCols<3>() - falcon_pose_at(bench.state.x)->J).norm(), 1e-9);
}

TEST_F(FalconDriverTest, RendersTipEffortAtTheTip) {
  FalconFixture bench = ready();
  up(bench);
  ASSERT_TRUE(bench.tick());
  const Vec3 wanted(1.5, -2, 0.7);
  const Vec3 tau = bench.state.J.leftCols<3>().transpose() * wanted;
  bench.model.mechanics().set_pull({.k = 1e6, .b = 1000, .m = 1, .x = bench.model.mechanics().tip()});
  ASSERT_TRUE(bench.tick(effort(tau[0], tau[1], tau[2], 7)));
  EXPECT_LE((bench.model.mechanics().motor_force() - wanted).norm(), 0.02) << "one count of 10000 per N m";
  EXPECT_EQ(bench.state.tau_out[0], 0.0) << "this reading was made before the effort acted";
  ASSERT_TRUE(bench.tick(effort(0, 0, 0, 8)));
  EXPECT_EQ(bench.state.echo_command, 7u);
  EXPECT_NEAR(bench.state.tau_out[0], tau[0], 0.5e-4);
  EXPECT_NE(bench.state.tau_out[0], tau[0]) << "the reported effort is that of the integers";
  EXPECT_LE((bench.state.f_out - wanted).norm(), 0.02);
  ASSERT_TRUE(bench.tick(effort(0, 0, 0, 9)));
  EXPECT_EQ(bench.state.echo_command, 8u);
  EXPECT_EQ(bench.state.f_out.norm(), 0.0);
}

TEST_F(FalconDriverTest, SendsNoForceBeforeAllLegsAreHomed) {
  FalconFixture bench;
  up(bench);
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(bench.tick(effort(0.1, 0.1, 0.1)));
  EXPECT_FALSE(bench.state.homed);
  EXPECT_EQ(bench.model.order(), FalconCommand{});
  bench.home();
  EXPECT_EQ(bench.model.homed(), kFalconAllHomed);
  ASSERT_TRUE(bench.tick());
  EXPECT_TRUE(bench.state.homed);
  EXPECT_LE((bench.state.x - bench.model.mechanics().tip()).norm(), 2e-4);
  ASSERT_TRUE(bench.tick(effort(0.1, 0.1, 0.1)));
  EXPECT_NE(bench.model.order().motor[0], 0);
  EXPECT_EQ(bench.model.unsafe_frames(), 0u);
  EXPECT_EQ(bench.model.bad_frames(), 0u);
}

TEST_F(FalconDriverTest, KeepsTheHomingBitInEveryFrameOnceAsked) {
  FalconFixture bench;
  up(bench);
  ASSERT_TRUE(bench.tick());
  EXPECT_FALSE(bench.model.order().homing) << "off until asked for";
  ASSERT_TRUE(bench.tick({.homing = true}));
  EXPECT_TRUE(bench.model.order().homing);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(bench.tick());
    ASSERT_TRUE(bench.model.order().homing);
  }
}

TEST_F(FalconDriverTest, ReportsAJumpAtANewOriginAndGivesNoForceWhileHoming) {
  FalconFixture bench;
  up(bench);
  int resynced = 0;
  for (const double y : {-0.06, 0.03, 0.0}) {
    for (int i = 0; i < 300; ++i) {
      bench.model.mechanics().set_pull({.k = 300, .b = 10, .m = 0.2, .x = Vec3(0, y, 0)});
      ServoCommand command = effort(0.1, 0.1, 0.1);
      command.homing = true;
      const auto result = bench.tick(command);
      ASSERT_TRUE(result);
      resynced += *result == Exchange::kResynced ? 1 : 0;
      ASSERT_EQ(bench.model.order().motor, (std::array<std::int16_t, 3>{}));
    }
  }
  EXPECT_GE(resynced, 1);
  EXPECT_TRUE(bench.state.homed);
}

TEST_F(FalconDriverTest, RemovesForceAfterALostHomingFlagUntilTheNextEdge) {
  FalconFixture bench;
  up(bench);
  bench.home();
  ASSERT_TRUE(bench.tick(effort(0.1, 0.1, 0.1)));
  ASSERT_NE(bench.model.order().motor[0], 0);
  bench.model.drop_homed(0x2);
  const std::uint64_t unsafe_before = bench.model.unsafe_frames();
  ASSERT_TRUE(bench.tick(effort(0.1, 0.1, 0.1)));  // its reply reports the loss; the frame itself was sent before
  EXPECT_FALSE(bench.state.homed);
  EXPECT_TRUE(bench.state.resynced);
  ASSERT_TRUE(bench.tick(effort(0.1, 0.1, 0.1)));
  EXPECT_EQ(bench.model.order().motor, (std::array<std::int16_t, 3>{}));
  EXPECT_FALSE(bench.model.order().homing) << "one frame without: the edge";
  EXPECT_EQ(bench.model.unsafe_frames(), unsafe_before + 1);
  ASSERT_TRUE(bench.tick());
  EXPECT_TRUE(bench.model.order().homing);
  bench.home();
  EXPECT_EQ(bench.model.homed(), kFalconAllHomed);
}

TEST_F(FalconDriverTest, ReloadsTheFirmwareIfEncodersFreezeWhileHoming) {
  FalconFixture bench;
  bench.model.faults.frozen_loads = 1;
  up(bench);
  const Time begin = bench.clock.now();
  std::optional<Errc> error;
  int ticks = 0;
  for (; ticks < 31'000 && !error; ++ticks) {
    bench.model.mechanics().set_pull({.k = 300, .b = 10, .m = 0.2, .x = Vec3(0, ticks % 600 < 300 ? -0.06 : 0.03, 0)});
    const auto result = bench.tick({.homing = true});
    if (!result) error = result.error();
  }
  ASSERT_TRUE(error);
  EXPECT_EQ(*error, Errc::kFirmware);
  EXPECT_NEAR(seconds(bench.clock.now() - begin), 30, 0.01);
  EXPECT_EQ(bench.model.loads(), 1u);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(bench.tick().error(), Errc::kFirmware) << "until it is brought up again";
  up(bench);
  EXPECT_EQ(bench.model.loads(), 2u) << "running firmware was not believed";
  bench.home();
  EXPECT_EQ(bench.model.homed(), kFalconAllHomed);
}

TEST_F(FalconDriverTest, ReportsFrozenOnlyOnceForAStillHand) {
  FalconHoming homing;
  homing.begin();
  Time now{};
  int frozen = 0;
  const auto wait = [&](int s) {
    for (int i = 0; i < s * 10; ++i, now += std::chrono::milliseconds(100)) {
      (void)homing.bit(true);
      if (homing.read({.encoder = {5, 5, 5}, .buttons = 0, .homed = 0}, now) == FalconHoming::Verdict::kFrozen) {
        ++frozen;
        homing.begin();
      }
    }
  };
  wait(200);
  EXPECT_EQ(frozen, 1);
}

TEST_F(FalconDriverTest, RejectsHomingWithoutMovement) {
  FalconHoming homing;
  homing.begin();
  (void)homing.bit(true);
  EXPECT_EQ(homing.read({.encoder = {5, 5, 5}, .buttons = 0, .homed = 0}, Time{}), FalconHoming::Verdict::kUnhomed);
  EXPECT_EQ(homing.read({.encoder = {0, 0, 0}, .buttons = 0, .homed = 7}, Time{}), FalconHoming::Verdict::kFrozen);
  EXPECT_FALSE(homing.homed());
}

TEST_F(FalconDriverTest, FadesEffortOutNearSingularPoses) {
  emulation::FalconModelSpec spec = falcon::ready_model();
  spec.mechanics.start = Vec3(0, 0, 0);
  FalconFixture bench(spec);
  up(bench);
  bench.begin();
  double worst = 0, full = 0;
  for (int i = 0; i < 1500; ++i) {
    const double s = i / 1500.0;
    bench.model.mechanics().set_pull({.k = 5000, .b = 100, .m = 0.2, .x = s * Vec3(0.06, kFalconOrigin - 0.168, 0.05)});
    ASSERT_TRUE(bench.tick(effort(0.02, 0.02, 0.02)));
    const auto pose = falcon_pose_at(bench.state.x);
    ASSERT_TRUE(pose);
    const double sent = std::abs(bench.model.order().motor[0]) / 200.0;
    if (pose->condition < 6) full = std::max(full, sent);
    if (pose->condition > kConditionNone + 2) worst = std::max(worst, sent);
  }
  EXPECT_EQ(full, 1.0);
  EXPECT_EQ(worst, 0.0);
  EXPECT_GT(falcon_pose_at(bench.state.x)->condition, kConditionNone + 2) << "the hand did not get to a bad pose";
  EXPECT_TRUE(bench.state.saturated);
}

TEST_F(FalconDriverTest, EstimatesTheSpeedOfAMovingHand) {
  FalconFixture bench = ready();
  up(bench);
  bench.model.mechanics().set_pull({.k = 1e5, .b = 1000, .m = 0.1, .x = Vec3(-0.03, 0, 0), .v = Vec3(0.1, 0, 0)});
  double sum = 0;
  for (int i = 0; i < 400; ++i) {
    ASSERT_TRUE(bench.tick());
    if (i >= 100) sum += bench.state.dx[0];
  }
  EXPECT_NEAR(sum / 300, 0.1, 0.003);
}

TEST_F(FalconDriverTest, DerivesNoMotionFromOldRepliesAfterAStall) {
  FalconFixture bench = ready();
  up(bench);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(bench.tick());
  // The program is stopped. The watchdog sends zeros, and their replies stay unread while the grip moves by 20 mm.
  bench.model.mechanics().set_pull({.k = 1e4, .b = 100, .m = 0.1, .x = Vec3::Zero(), .v = Vec3(0.4, 0, 0)});
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(bench.pipe.write(encode(FalconCommand{}), std::chrono::milliseconds(2)));
    bench.clock.advance(std::chrono::milliseconds(1));
  }
  bench.model.mechanics().set_pull({.k = 1e4, .b = 100, .m = 0.1, .x = Vec3(0.02, 0, 0)});
  bench.clock.advance(std::chrono::milliseconds(400));
  bench.begin();
  bool resynced = false;
  for (int i = 0; i < 20; ++i) {
    const auto how = bench.tick();
    ASSERT_TRUE(how);
    resynced = resynced || how == Exchange::kResynced;
    ASSERT_TRUE(resynced || how == Exchange::kNothing) << "the first valid answer restarts the estimate";
    if (!resynced) continue;
    EXPECT_LT(bench.state.dx.norm(), 0.02) << "the first readings are of now, tick " << i;
    EXPECT_NEAR(bench.state.x[0], bench.model.mechanics().tip()[0], 1e-4);
  }
  EXPECT_TRUE(resynced);
}

TEST_F(FalconDriverTest, ForwardsButtonsAndLights) {
  FalconFixture bench = ready();
  up(bench);
  bench.model.set_buttons(0b1010);
  ServoCommand command;
  command.leds = 0b101;
  ASSERT_TRUE(bench.tick(command));
  EXPECT_EQ(bench.state.buttons, 0b1010u);
  EXPECT_EQ(bench.model.order().lights, 0b101);
}

TEST_F(FalconDriverTest, SendsAtLeastThreeZeroFramesWhenSilenced) {
  FalconFixture bench = ready();
  up(bench);
  ASSERT_TRUE(bench.tick());
  ASSERT_TRUE(bench.tick(effort(0.1, 0.1, 0.1)));
  ASSERT_NE(bench.model.order().motor[0], 0);
  const std::uint64_t before = bench.model.frames();
  bench.driver.send_zeros();
  bench.clock.advance(std::chrono::milliseconds(2));
  EXPECT_GE(bench.model.frames(), before + 3);
  EXPECT_EQ(bench.model.order().motor, (std::array<std::int16_t, 3>{}));
  bench.driver.send_zeros();
}

TEST_F(FalconDriverTest, ExchangesWithoutHeap) {
  FalconFixture bench = ready();
  up(bench);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(bench.tick());
  bench.model.faults.short_replies = 3;
  bench.model.faults.noise_bytes = 7;
  tandem::test::AllocGuard guard;
  for (int i = 0; i < 100; ++i) (void)bench.tick(effort(0.1, -5, 0.1));
  bench.driver.send_zeros();
  bench.model.unplug();
  (void)bench.tick();
  EXPECT_EQ(guard.count(), 0u);
}

TEST_F(FalconDriverTest, RunsAtAThousandHertzOnTheLine) {
  FalconFixture bench = ready();
  up(bench);
  const Time begin = bench.clock.now();
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(*bench.tick(), Exchange::kFresh) << i;
  // Virtual time: 16 bytes each way and the bridge's 1 ms timer; the servo's own period is the longer of both.
  const double period = seconds(bench.clock.now() - begin) / 2000;
  std::printf("[ measured ] %.3f ms per exchange in virtual time\n", 1e3 * period);
  EXPECT_LE(period, 1.5e-3);
}

}  // namespace
}  // namespace tandem::hal
