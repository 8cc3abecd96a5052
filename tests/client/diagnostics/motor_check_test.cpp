// Motor checks in virtual time with the real driver and guard. The motors of the emulated board match the device file,
// are reversed, or are jammed.
#include "client/diagnostics/motor_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "hal/core/servo_core.h"
#include "hal/drivers/woodenhaptics/woodenhaptics_driver.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"
#include "tests/hal/emulation/devices/woodenhaptics_model.h"
#include "tests/support/alloc_guard.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using hal::Vec3;
using hal::woodenhaptics::WoodenHapticsDriver;
using Verdict = MotorCheck::Verdict;
using Reason = MotorCheck::Reason;

/// An emulated board that records the duration and strength of each pulse on the wire.
struct Board {
  struct Heartbeat {
    int motor = -1;
    Time from{}, to{};
    int strongest = 0;  ///< [mA]
    bool positive = false;
  };
  /// @param stated content of the device file on the host
  /// @param truth  actual properties of the emulated device
  Board(const WoodenHapticsSpec& stated, const WoodenHapticsSpec& truth,
        const hal::emulation::WoodenHapticsModelParams& params, bool held)
      : model(test::WoodenHapticsFixture::at_calibration(truth, params)), time(model), pipe(model, time) {
    auto driver = std::make_unique<WoodenHapticsDriver>(
        hal::DeviceId{"woodenhaptics", "0001"}, pipe, time,
        hal::woodenhaptics::WoodenHapticsOptions{.spec = stated, .enable_motors = true, .home_at_start = true});
    model.place(model.tip());
    core = std::make_unique<hal::ServoCore>(std::move(driver), hal::MotorSigns::kBeingConfirmed);
    test::QuietBringUp quiet;
    EXPECT_TRUE(core->bring_up(quiet));
    for (int i = 0; i < 20; ++i) step(idle);
    // A user moves the arm to the middle, then releases or holds it.
    const Vec3 start = model.tip();
    for (int i = 1; i <= 1000; ++i) {
      model.place(start * (1 - i / 1000.0));
      step(idle);
    }
    if (!held) model.let_go();
  }
  void step(hal::ServoClient& client) {
    next = std::max(next + 1ms, time.now());
    time.wait_until(next);
    ASSERT_TRUE(core->step(time.now(), client));
    watch();
  }
  void watch() {
    const auto& now = model.host_report(0);
    for (int m = 0; m < 3; ++m) {
      const int ma = now.preset ? 0 : now.current_ma[static_cast<std::size_t>(m)];
      const bool open = !pulses.empty() && pulses.back().motor == m && pulses.back().to == Time{};
      if (open && ma != 0) pulses.back().strongest = std::max(pulses.back().strongest, std::abs(ma));
      if (open && ma == 0) pulses.back().to = now.at;
      if (!open && ma != 0) pulses.push_back({m, now.at, {}, std::abs(ma), ma > 0});
    }
  }
  struct Idle final : hal::ServoClient {
    hal::Command tick(const hal::State&) noexcept override { return {}; }
    void lost(hal::Errc) noexcept override {}
  } idle;

  hal::emulation::WoodenHapticsModel model;
  test::HidModelClock time;
  test::HidModelPipe pipe;
  std::unique_ptr<hal::ServoCore> core;
  Time next{};
  std::vector<Heartbeat> pulses;
};

struct Pulser final : hal::ServoClient {
  Pulser(const hal::DeviceCaps& caps, test::HidModelClock& t)
      : time(t), check(caps.joints, hal::peak_of(caps), t.now()) {}
  hal::Command tick(const hal::State& state) noexcept override {
    return {++seq, time.now() + 5ms, hal::CommandKind::kJointEffort, check.step(time.now(), state)};
  }
  void lost(hal::Errc) noexcept override {}
  test::HidModelClock& time;
  MotorCheck check;
  std::uint64_t seq = 0;
};

WoodenHapticsSpec arm(WoodenProtocol protocol = WoodenProtocol::kV2) {
  WoodenHapticsSpec spec = test::wooden_2015();
  spec.protocol = protocol;
  return spec;
}

/// Runs the check to its end. @return its duration
Duration run(Board& board, Pulser& pulser, Duration limit = 60s) {
  EXPECT_TRUE(board.core->enable());
  const Time begin = board.time.now();
  while (!pulser.check.finished() && board.time.now() - begin < limit) board.step(pulser);
  EXPECT_TRUE(pulser.check.finished());
  for (int i = 0; i < 100; ++i) board.step(pulser);
  return board.time.now() - begin;
}

/// Expects the limits that the user interface promises for every pulse, independent of the motors.
void expect_promised(const Board& board) {
  ASSERT_FALSE(board.pulses.empty());
  for (const auto& pulse : board.pulses) {
    ASSERT_NE(pulse.to, Time{}) << "still on";
    EXPECT_LE(seconds(pulse.to - pulse.from), 0.030 + 1e-9) << "motor " << pulse.motor;
  }
  EXPECT_EQ(board.model.motor_effort(), Vec3::Zero());
}

class EveryBoard : public testing::TestWithParam<WoodenProtocol> {};
INSTANTIATE_TEST_SUITE_P(Protocols, EveryBoard,
                         testing::Values(WoodenProtocol::kV1, WoodenProtocol::kV2, WoodenProtocol::kRaw64));

TEST_P(EveryBoard, ConfirmsCorrectMotorsWithSmallPulses) {
  Board board(arm(GetParam()), arm(GetParam()), {}, false);
  Pulser pulser(board.core->caps(), board.time);
  const Vec3 before = board.model.tip();
  const Duration took = run(board, pulser);
  EXPECT_TRUE(pulser.check.all_right());
  EXPECT_LT(seconds(took), 10);
  expect_promised(board);
  EXPECT_EQ(board.pulses.size() % 2, 0u) << "in pairs";
  for (std::size_t i = 0; i < board.pulses.size(); i += 2) {
    EXPECT_EQ(board.pulses[i].motor, board.pulses[i + 1].motor);
    EXPECT_NE(board.pulses[i].positive, board.pulses[i + 1].positive) << "opposite ones";
  }
  EXPECT_LT((board.model.tip() - before).norm(), 0.01);
}

TEST_P(EveryBoard, FindsAReversedMotorAndSwitchesItOffAtOnce) {
  for (std::size_t wrong = 0; wrong < 3; ++wrong) {
    WoodenHapticsSpec truth = arm(GetParam());
    truth.motor_direction[wrong] = -1;
    Board board(arm(GetParam()), truth, {}, false);
    Pulser pulser(board.core->caps(), board.time);
    run(board, pulser);
    SCOPED_TRACE(wrong);
    EXPECT_FALSE(pulser.check.all_right());
    for (std::size_t i = 0; i < 3; ++i) {
      const Verdict expected = i < wrong ? Verdict::kRight : i == wrong ? Verdict::kReversed : Verdict::kUntested;
      EXPECT_EQ(pulser.check.motor(i).verdict, expected) << i;
    }
    expect_promised(board);
    EXPECT_EQ(board.pulses.back().motor, static_cast<int>(wrong)) << "no pulse after it";
    EXPECT_EQ(pulser.check.motor(wrong).moved[1], 0) << "the first pulse showed it; there was no second";
    EXPECT_GE(pulser.check.motor(wrong).moved[0], -3 * MotorCheck::kCounts) << "at once";
  }
}

TEST(MotorCheck, LeavesAJammedArmUnconfirmedAfterThreeStrengths) {
  Board board(arm(), arm(), {}, true);
  Pulser pulser(board.core->caps(), board.time);
  run(board, pulser);
  EXPECT_FALSE(pulser.check.all_right());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pulser.check.motor(i).verdict, Verdict::kUnconfirmed);
    EXPECT_EQ(pulser.check.motor(i).reason, Reason::kDidNotMove);
  }
  expect_promised(board);
  ASSERT_EQ(board.pulses.size(), 18u) << "three motors, three strengths, two directions";
  for (std::size_t i = 0; i < 18; i += 6) {
    EXPECT_NEAR(board.pulses[i + 2].strongest, 2.0 * board.pulses[i].strongest, 2) << "20 % after 10";
    EXPECT_NEAR(board.pulses[i + 4].strongest, 3.0 * board.pulses[i].strongest, 3) << "then 30";
  }
}

TEST(MotorCheck, KeepsPulsesWithinTheirShareOfThePeak) {
  Board board(arm(), arm(), {}, true);
  Pulser pulser(board.core->caps(), board.time);
  ASSERT_TRUE(board.core->enable());
  double most = 0;
  while (!pulser.check.finished()) {
    board.step(pulser);
    most = std::max(most, board.model.motor_force().norm());
  }
  EXPECT_LE(most, 0.3 * hal::peak_of(board.core->caps()) * 1.02);
  EXPECT_GT(most, 0.25 * hal::peak_of(board.core->caps()));
}

TEST(MotorCheck, ConfirmsAHeavyArmWithStrongerPulses) {
  Board board(arm(), arm(), {.spec = {}, .mass = 1.2, .damping = 15}, false);
  Pulser pulser(board.core->caps(), board.time);
  run(board, pulser);
  double strongest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pulser.check.motor(i).verdict, Verdict::kRight) << i;
    strongest = std::max(strongest, pulser.check.motor(i).share);
  }
  EXPECT_GT(strongest, 0.15) << "10 % did not move all of it";
  expect_promised(board);
}

TEST(MotorCheck, SendsNoPulseToAFallingArm) {
  Board board(arm(), arm(), {.spec = {}, .weight = true}, false);
  Pulser pulser(board.core->caps(), board.time);
  ASSERT_TRUE(board.core->enable());
  for (int i = 0; i < 650; ++i) board.step(pulser);
  EXPECT_TRUE(board.pulses.empty() || board.pulses.front().motor == 0) << "the base turns about the vertical: it rests";
  run(board, pulser);
  EXPECT_FALSE(pulser.check.all_right());
}

TEST(MotorCheck, LeavesAnUnpoweredMotorUnconfirmed) {
  WoodenHapticsSpec truth = arm();
  truth.torque_constant[1] *= 1e-6;  // its cable is unplugged
  Board board(arm(), truth, {}, false);
  Pulser pulser(board.core->caps(), board.time);
  run(board, pulser);
  EXPECT_EQ(pulser.check.motor(0).verdict, Verdict::kRight);
  EXPECT_EQ(pulser.check.motor(1).verdict, Verdict::kUnconfirmed);
  EXPECT_EQ(pulser.check.motor(2).verdict, Verdict::kRight);
  const auto findings = pulser.check.findings({"base", "shoulder", "elbow"});
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_NE(findings[1].text.find("shoulder: unconfirmed, it did not move"), std::string::npos) << findings[1].text;
}

TEST(MotorCheck, RepeatsAPulseThatTheGuardReduced) {
  Board board(arm(), arm(), {}, false);
  Pulser pulser(board.core->caps(), board.time);
  ASSERT_TRUE(board.core->enable());
  for (int stalls = 0; !pulser.check.finished() && board.time.now() < Time{} + 120s;) {
    board.step(pulser);
    // The program stalls between two pulses, so the guard restarts its soft start at zero.
    if (stalls < 3 && pulser.check.motor(0).share > 0 && board.model.motor_effort() == Vec3::Zero()) {
      ++stalls;
      board.time.wait_until(board.time.now() + 25ms);
    }
  }
  EXPECT_TRUE(pulser.check.all_right());
  EXPECT_EQ(board.model.motor_effort(), Vec3::Zero());
}

TEST(MotorCheck, EndsWhenTheOriginIsLost) {
  Board board(arm(), arm(), {}, false);
  Pulser pulser(board.core->caps(), board.time);
  ASSERT_TRUE(board.core->enable());
  for (int i = 0; i < 700; ++i) board.step(pulser);
  board.model.unplug();
  board.model.plug_in();  // the board lost its power, so its counters restart
  for (int i = 0; i < 200 && !pulser.check.finished(); ++i) {
    board.time.wait_until(board.time.now() + 1ms);
    (void)board.core->step(board.time.now(), pulser);
  }
  EXPECT_FALSE(pulser.check.all_right());
}

TEST(MotorCheck, RunsWithoutHeap) {
  Board board(arm(), arm(), {}, false);
  MotorCheck check(3, hal::peak_of(board.core->caps()), board.time.now());
  hal::State state = board.core->state();
  const test::AllocGuard guard;
  for (int i = 0; i < 2000; ++i) (void)check.step(board.time.now() + i * 1ms, state);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(MotorSigns, UnconfirmedAllowNoForceForAnyCommand) {
  struct Push final : hal::ServoClient {
    explicit Push(test::HidModelClock& t) : time(t) {}
    hal::Command tick(const hal::State&) noexcept override {
      return {++seq, time.now() + 5ms, hal::CommandKind::kJointEffort, {0.1, 0.1, 0.1}};
    }
    void lost(hal::Errc) noexcept override {}
    test::HidModelClock& time;
    std::uint64_t seq = 0;
  };
  for (const auto signs : {hal::MotorSigns::kUnconfirmed, hal::MotorSigns::kConfirmed}) {
    hal::emulation::WoodenHapticsModel model(test::WoodenHapticsFixture::at_calibration(arm(), {}));
    model.place(model.tip());
    test::HidModelClock time(model);
    test::HidModelPipe pipe(model, time);
    hal::ServoCore core(
        std::make_unique<WoodenHapticsDriver>(
            hal::DeviceId{"woodenhaptics", "1"}, pipe, time,
            hal::woodenhaptics::WoodenHapticsOptions{.spec = arm(), .enable_motors = true, .home_at_start = true}),
        signs);
    test::QuietBringUp quiet;
    ASSERT_TRUE(core.bring_up(quiet));
    Push push(time);
    double most = 0;
    for (int i = 0; i < 2000; ++i) {
      time.wait_until(time.now() + 1ms);
      ASSERT_TRUE(core.step(time.now(), push));
      if (i == 100) {
        ASSERT_TRUE(core.enable());
      }
      most = std::max(most, model.motor_effort().norm());
    }
    if (signs == hal::MotorSigns::kUnconfirmed) {
      EXPECT_EQ(most, 0.0);
    } else {
      EXPECT_GT(most, 0.0);
    }
  }
}

}  // namespace
}  // namespace tandem::client
