#include "hal/drivers/spacemouse/spacemouse_driver.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"
#include "hal/core/servo_core.h"
#include "tests/common/base/counts.h"
#include "tests/hal/emulation/devices/hid_model_pipe.h"
#include "tests/hal/emulation/devices/spacemouse_model.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal::spacemouse {
namespace {

using namespace std::chrono_literals;

struct SpaceMouseFixture {
  explicit SpaceMouseFixture(const emulation::SpaceMouseModelParams& params = {})
      : model(params), time(model), pipe(model, time), driver({"spacemouse", "1-1"}, pipe, time) {}
  Result<> bring_up() {
    test::QuietBringUp watcher;
    return driver.bring_up(watcher);
  }
  std::expected<Exchange, Errc> step(std::uint8_t leds = 0) {
    time.wait_until(time.now() + 1ms);
    return driver.exchange({.seq = ++seq, .effort = {}, .homing = false, .leds = leds}, state);
  }
  bool run(int exchanges) {
    for (int i = 0; i < exchanges; ++i) {
      if (step() != Exchange::kFresh) return false;
    }
    return true;
  }
  emulation::SpaceMouseModel model;
  test::HidModelClock time;
  test::HidModelPipe pipe;
  SpaceMouseDriver driver;
  State state;
  std::uint64_t seq = 0;
};

emulation::SpaceMouseModelParams wireless() {
  return {.combined = true, .vendor = 0x256F, .product = 0xC62E, .name = "SpaceMouse Wireless"};
}

TEST(SpaceMouse, IsARateDeviceWithoutMotors) {
  SpaceMouseFixture b;
  const DeviceCaps& caps = b.driver.caps();
  EXPECT_EQ(caps.input, InputKind::kRate);
  EXPECT_EQ(caps.joints, 6u);
  EXPECT_EQ(caps.homing, Homing::kNone);
  for (const AxisLimit& axis : caps.axis) EXPECT_FALSE(axis.peak.has_value()) << "unknown, not zero";
}

TEST(SpaceMouse, ReadsTheVelocityOfBothReportKinds) {
  for (const auto& params : {emulation::SpaceMouseModelParams{}, wireless()}) {
    SpaceMouseFixture b(params);
    ASSERT_TRUE(b.bring_up());
    ASSERT_TRUE(b.run(5));
    EXPECT_EQ(b.state.dx, Vec3::Zero());
    b.model.deflect({350, -70, 35, 70, 0, -350});
    for (int i = 0; i < 500; ++i) {
      ASSERT_TRUE(b.run(1));
      if (i < 34) continue;  // two complete rounds of reports
      ASSERT_LT((b.state.dx - Vec3(0.1, 0.02, -0.01)).norm(), 1e-12) << i;
      ASSERT_FALSE(b.state.stale) << i;
      EXPECT_NEAR(b.state.dq[0], 0.1, 1e-12);
      EXPECT_NEAR(b.state.dq[3], 0.1, 1e-12);
      EXPECT_NEAR(b.state.dq[5], 0.5, 1e-12);
    }
    EXPECT_EQ(b.state.x, Vec3::Zero()) << "where that leads is not the HAL's business";
    EXPECT_EQ(b.state.raw[0], 350);
    EXPECT_EQ(b.state.J.leftCols<3>(), Eigen::Matrix3d::Identity());
  }
}

TEST(SpaceMouse, StopsAtThreeZerosAndStaysAtRestInSilence) {
  SpaceMouseFixture b;
  ASSERT_TRUE(b.bring_up());
  b.model.deflect({350, 0, 0, 0, 0, 0});
  ASSERT_TRUE(b.run(100));
  ASSERT_GT(b.state.dx[0], 0.0);
  b.model.deflect({});
  ASSERT_TRUE(b.run(20));
  EXPECT_EQ(b.state.dx, Vec3::Zero());
  EXPECT_FALSE(b.state.stale);
  ASSERT_TRUE(b.run(2000));
  EXPECT_EQ(b.state.dx, Vec3::Zero());
  EXPECT_TRUE(b.state.stale);
}

TEST(SpaceMouse, HoldsTheVelocityFor50MillisecondsThenFadesIt) {
  SpaceMouseFixture b;
  ASSERT_TRUE(b.bring_up());
  b.model.deflect({350, 0, 0, 0, 0, 0});
  ASSERT_TRUE(b.run(100));
  b.model.faults.silent = true;
  const Time died = b.time.now();
  Duration zero_after{};
  double before = b.state.dx[0];
  while (zero_after == Duration{0} && b.time.now() - died < 1s) {
    ASSERT_TRUE(b.run(1));
    const Duration silent = b.time.now() - died;
    EXPECT_LE(b.state.dx[0], before);
    before = b.state.dx[0];
    if (silent > 51ms) {
      EXPECT_LT(b.state.dx[0], 0.1) << "held no longer";
      EXPECT_TRUE(b.state.stale);
    }
    if (b.state.dx[0] == 0.0) zero_after = silent;
  }
  EXPECT_GT(zero_after, 50ms);
  EXPECT_LE(zero_after, 101ms);
}

TEST(SpaceMouse, IgnoresMalformedAndUnknownReports) {
  SpaceMouseFixture b;
  ASSERT_TRUE(b.bring_up());
  b.model.deflect({350, 0, 0, 0, 0, 0});
  ASSERT_TRUE(b.run(50));
  b.model.faults.odd_reports = 3;
  b.model.faults.strange_ids = 3;
  b.model.deflect({-350, 0, 0, 0, 0, 0});
  ASSERT_TRUE(b.run(20));
  EXPECT_EQ(b.state.dx[0], 0.1);
  EXPECT_GT(b.driver.odd_reports() + static_cast<unsigned>(3 - b.model.faults.strange_ids), 0u);
  ASSERT_TRUE(b.run(60));
  EXPECT_EQ(b.state.dx[0], -0.1);
}

TEST(SpaceMouse, ReportsButtonsAndBattery) {
  for (const std::size_t bytes : {2u, 3u, 4u}) {
    emulation::SpaceMouseModelParams params;
    params.button_bytes = bytes;
    SpaceMouseFixture b(params);
    ASSERT_TRUE(b.bring_up());
    b.model.press(3);
    ASSERT_TRUE(b.run(1));
    EXPECT_EQ(b.state.buttons, 3u);
    b.model.press(0);
    b.model.tell_battery(77, true);
    ASSERT_TRUE(b.run(1));
    EXPECT_EQ(b.state.buttons, 0u);
    EXPECT_EQ(b.driver.battery_percent(), 77);
  }
}

TEST(SpaceMouse, SwitchesTheLightOnInUseAndOffAfterwards) {
  for (const bool quirk : {false, true}) {
    emulation::SpaceMouseModelParams params;
    params.light_needs_on_first = quirk;
    SpaceMouseFixture b(params);
    ASSERT_TRUE(b.bring_up());
    EXPECT_TRUE(b.model.light());
    ASSERT_TRUE(b.run(3));
    EXPECT_TRUE(b.model.light());
    ASSERT_TRUE(b.step(1));
    EXPECT_TRUE(b.model.light());
    ASSERT_TRUE(b.step(0));
    EXPECT_FALSE(b.model.light()) << "the program that switched it on may switch it off";
    ASSERT_TRUE(b.step(1));
    b.driver.send_zeros();
    EXPECT_FALSE(b.model.light());
  }
}

TEST(SpaceMouse, DiscardsReportsFromBeforeTheStart) {
  SpaceMouseFixture b;
  b.model.deflect({350, 350, 350, 0, 0, 0});
  b.time.wait_until(b.time.now() + 2s);  // more than the queue holds
  b.model.faults.silent = true;
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.run(1));
  EXPECT_EQ(b.state.dx, Vec3::Zero());
}

TEST(SpaceMouse, ReportsUnpluggingAtOnceAtAnyCall) {
  for (int calls = 0; calls < 60; ++calls) {
    SCOPED_TRACE(calls);
    SpaceMouseFixture b;
    b.model.deflect({350, 0, 0, 0, 0, 0});
    b.pipe.unplug_after(calls);
    if (const auto up = b.bring_up(); !up) {
      EXPECT_EQ(up.error().code, Errc::kUnplugged);
      continue;
    }
    std::expected<Exchange, Errc> how = Exchange::kFresh;
    for (int i = 0; i < 100 && how; ++i) {
      how = b.step();
      EXPECT_EQ(how.has_value(), b.model.plugged_in());
    }
    ASSERT_FALSE(how);
    EXPECT_EQ(how.error(), Errc::kUnplugged);
    b.driver.send_zeros();
  }
}

TEST(SpaceMouse, ExchangesWithoutHeap) {
  SpaceMouseFixture b;
  ASSERT_TRUE(b.bring_up());
  b.model.deflect({1, 2, 3, 4, 5, 6});
  const test::AllocGuard guard;
  (void)b.run(200);
  b.driver.send_zeros();
  EXPECT_EQ(guard.count(), 0u);
}

struct Watcher final : ServoClient {
  State seen;
  Command tick(const State& state) noexcept override {
    seen = state;
    return {};
  }
  void lost(Errc) noexcept override {}
};

TEST(SpaceMouse, DoesNotFaultAServoCoreWhenSilent) {
  emulation::SpaceMouseModel model;
  test::HidModelClock time(model);
  test::HidModelPipe pipe(model, time);
  ServoCore core(std::make_unique<SpaceMouseDriver>(DeviceId{"spacemouse", "1"}, pipe, time));
  test::QuietBringUp quiet;
  ASSERT_TRUE(core.bring_up(quiet));
  EXPECT_EQ(core.phase(), Phase::kReady);
  Watcher client;
  for (int i = 0; i < 1000; ++i) {
    time.wait_until(time.now() + 1ms);
    ASSERT_TRUE(core.step(time.now(), client));
  }
  EXPECT_EQ(core.phase(), Phase::kReady);
  EXPECT_TRUE(client.seen.stale) << "told, and left to the client";
  EXPECT_EQ(client.seen.sampled_at, time.now()) << "its time runs on, so that a rate can be integrated";
}

}  // namespace
}  // namespace tandem::hal::spacemouse
