// The pulses that find a motor's direction, in virtual time: the real driver and guard on the wire model of a board whose motors are
// as its file says, reversed, or jammed.
#include "client/motor_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "hal/servo_core.h"
#include "hal/wire/woodenhaptics_model.h"
#include "hal/woodenhaptics/woodenhaptics_driver.h"
#include "tests/hal/woodenhaptics/bench.h"
#include "tests/support/alloc_guard.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using hal::Vec3;
using hal::woodenhaptics::WoodenHapticsDriver;
using Verdict = MotorCheck::Verdict;
using Why = MotorCheck::Why;

/// Looks at the wire: how long and how strong each pulse was.
struct Board {
  struct Pulse {
    int motor = -1;
    Time from{}, to{};
    int strongest = 0;  ///< [mA]
    bool positive = false;
  };
  /// @param truth  what hangs on the board; the host has a file that says `told`
  Board(const WoodenHapticsSpec& told, const WoodenHapticsSpec& truth, const hal::wire::WoodenHapticsModelParams& params, bool held)
      : model(test::WoodenBench::at_calibration(truth, params)), time(model), pipe(model, time) {
    auto driver = std::make_unique<WoodenHapticsDriver>(
        hal::DeviceId{"woodenhaptics", "0001"}, pipe, time,
        hal::woodenhaptics::WoodenHapticsOptions{.spec = told, .energise = true, .home_at_start = true});
    model.place(model.tip());
    core = std::make_unique<hal::ServoCore>(std::move(driver), hal::MotorSigns::kBeingConfirmed);
    test::QuietBringUp quiet;
    EXPECT_TRUE(core->bring_up(quiet));
    for (int i = 0; i < 20; ++i) step(idle);
    // Somebody carries the arm into the middle and lets go of it, or holds it fast.
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

  hal::wire::WoodenHapticsModel model;
  test::WireTime time;
  test::HidWirePipe pipe;
  std::unique_ptr<hal::ServoCore> core;
  Time next{};
  std::vector<Pulse> pulses;
};

struct Pulser final : hal::ServoClient {
  Pulser(const hal::DeviceCaps& caps, test::WireTime& t) : time(t), check(caps.joints, hal::peak_of(caps), t.now()) {}
  hal::Command tick(const hal::State& state) noexcept override {
    return {++seq, time.now() + 5ms, hal::CommandKind::kJointEffort, check.step(time.now(), state)};
  }
  void lost(hal::Errc) noexcept override {}
  test::WireTime& time;
  MotorCheck check;
  std::uint64_t seq = 0;
};

WoodenHapticsSpec arm(WoodenProtocol protocol = WoodenProtocol::kV2) {
  WoodenHapticsSpec spec = test::wooden_2015();
  spec.protocol = protocol;
  return spec;
}

/// Runs the check to its end. @return how long it took
Duration run(Board& board, Pulser& pulser, Duration limit = 60s) {
  EXPECT_TRUE(board.core->enable());
  const Time begin = board.time.now();
  while (!pulser.check.over() && board.time.now() - begin < limit) board.step(pulser);
  EXPECT_TRUE(pulser.check.over());
  for (int i = 0; i < 100; ++i) board.step(pulser);
  return board.time.now() - begin;
}

/// What a person was promised of every pulse, whatever the motors did.
void expect_promised(const Board& board) {
  ASSERT_FALSE(board.pulses.empty());
  for (const auto& pulse : board.pulses) {
    ASSERT_NE(pulse.to, Time{}) << "still on";
    EXPECT_LE(seconds(pulse.to - pulse.from), 0.030 + 1e-9) << "motor " << pulse.motor;
  }
  EXPECT_EQ(board.model.motor_effort(), Vec3::Zero());
}

class EveryBoard : public testing::TestWithParam<WoodenProtocol> {};
INSTANTIATE_TEST_SUITE_P(Protocols, EveryBoard, testing::Values(WoodenProtocol::kV1, WoodenProtocol::kV2, WoodenProtocol::kRaw64));

TEST_P(EveryBoard, MotorsThatPushAsTheyAreToldAreConfirmedWithSmallPulses) {
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

TEST_P(EveryBoard, AReversedMotorIsFoundAndSwitchedOffAtOnce) {
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
    EXPECT_EQ(pulser.check.motor(wrong).moved[1], 0) << "the first pulse told; there was no second";
    EXPECT_GE(pulser.check.motor(wrong).moved[0], -3 * MotorCheck::kCounts) << "at once";
  }
}

TEST(MotorCheck, AJammedArmStaysUnconfirmedAfterAllThreeStrengths) {
  Board board(arm(), arm(), {}, true);
  Pulser pulser(board.core->caps(), board.time);
  run(board, pulser);
  EXPECT_FALSE(pulser.check.all_right());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pulser.check.motor(i).verdict, Verdict::kUnconfirmed);
    EXPECT_EQ(pulser.check.motor(i).why, Why::kDidNotMove);
  }
  expect_promised(board);
  ASSERT_EQ(board.pulses.size(), 18u) << "three motors, three strengths, two directions";
  for (std::size_t i = 0; i < 18; i += 6) {
    EXPECT_NEAR(board.pulses[i + 2].strongest, 2.0 * board.pulses[i].strongest, 2) << "20 % after 10";
    EXPECT_NEAR(board.pulses[i + 4].strongest, 3.0 * board.pulses[i].strongest, 3) << "then 30";
  }
}

TEST(MotorCheck, NoPulseIsStrongerThanItsShareOfThePeak) {
  Board board(arm(), arm(), {}, true);
  Pulser pulser(board.core->caps(), board.time);
  ASSERT_TRUE(board.core->enable());
  double most = 0;
  while (!pulser.check.over()) {
    board.step(pulser);
    most = std::max(most, board.model.motor_force().norm());
  }
  EXPECT_LE(most, 0.3 * hal::peak_of(board.core->caps()) * 1.02);
  EXPECT_GT(most, 0.25 * hal::peak_of(board.core->caps()));
}

TEST(MotorCheck, AHeavyArmIsConfirmedByStrongerPulses) {
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

TEST(MotorCheck, AnArmThatFallsIsNotPulsed) {
  Board board(arm(), arm(), {.spec = {}, .weight = true}, false);
  Pulser pulser(board.core->caps(), board.time);
  ASSERT_TRUE(board.core->enable());
  for (int i = 0; i < 650; ++i) board.step(pulser);
  EXPECT_TRUE(board.pulses.empty() || board.pulses.front().motor == 0) << "the base turns about the vertical: it rests";
  run(board, pulser);
  EXPECT_FALSE(pulser.check.all_right());
}

TEST(MotorCheck, AMotorWithoutPowerStaysUnconfirmed) {
  WoodenHapticsSpec truth = arm();
  truth.torque_constant[1] *= 1e-6;  // its cable is out
  Board board(arm(), truth, {}, false);
  Pulser pulser(board.core->caps(), board.time);
  run(board, pulser);
  EXPECT_EQ(pulser.check.motor(0).verdict, Verdict::kRight);
  EXPECT_EQ(pulser.check.motor(1).verdict, Verdict::kUnconfirmed);
  EXPECT_EQ(pulser.check.motor(2).verdict, Verdict::kRight);
  const auto findings = pulser.check.findings({"base", "shoulder", "elbow"});
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_NE(findings[1].words.find("shoulder: unconfirmed, it did not move"), std::string::npos) << findings[1].words;
}

TEST(MotorCheck, APulseThatTheGuardMadeSmallIsGivenAgain) {
  Board board(arm(), arm(), {}, false);
  Pulser pulser(board.core->caps(), board.time);
  ASSERT_TRUE(board.core->enable());
  for (int stalls = 0; !pulser.check.over() && board.time.now() < Time{} + 120s;) {
    board.step(pulser);
    // The program stands still between two pulses: the guard begins anew at zero.
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
  board.model.plug_in();  // the board lost its power: counters begin anew
  for (int i = 0; i < 200 && !pulser.check.over(); ++i) {
    board.time.wait_until(board.time.now() + 1ms);
    (void)board.core->step(board.time.now(), pulser);
  }
  EXPECT_FALSE(pulser.check.all_right());
}

TEST(MotorCheck, TakesNoHeapWhileItRuns) {
  Board board(arm(), arm(), {}, false);
  MotorCheck check(3, hal::peak_of(board.core->caps()), board.time.now());
  hal::State state = board.core->state();
  const test::AllocGuard guard;
  for (int i = 0; i < 2000; ++i) (void)check.step(board.time.now() + i * 1ms, state);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(MotorSigns, WithoutConfirmationACoreGivesNoForceWhateverIsOrdered) {
  struct Push final : hal::ServoClient {
    explicit Push(test::WireTime& t) : time(t) {}
    hal::Command tick(const hal::State&) noexcept override { return {++seq, time.now() + 5ms, hal::CommandKind::kJointEffort, {0.1, 0.1, 0.1}}; }
    void lost(hal::Errc) noexcept override {}
    test::WireTime& time;
    std::uint64_t seq = 0;
  };
  for (const auto signs : {hal::MotorSigns::kUnconfirmed, hal::MotorSigns::kConfirmed}) {
    hal::wire::WoodenHapticsModel model(test::WoodenBench::at_calibration(arm(), {}));
    model.place(model.tip());
    test::WireTime time(model);
    test::HidWirePipe pipe(model, time);
    hal::ServoCore core(std::make_unique<WoodenHapticsDriver>(
                            hal::DeviceId{"woodenhaptics", "1"}, pipe, time,
                            hal::woodenhaptics::WoodenHapticsOptions{.spec = arm(), .energise = true, .home_at_start = true}),
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
