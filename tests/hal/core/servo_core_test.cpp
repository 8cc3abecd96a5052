#include "hal/core/servo_core.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/rng.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Driver of three orthogonal linear axes: joint effort is tip force. The test scripts the result of each exchange.
struct FakeDriver final : Driver {
  DeviceId name{"fake", "1"};
  DeviceCaps what;
  State next;
  std::expected<Exchange, Errc> how = Exchange::kFresh;
  Result<> up{};
  std::vector<ServoCommand> sent;
  int silences = 0;

  FakeDriver() {
    what.joints = 3;
    what.tip_axes = 3;
    for (AxisLimit& axis : what.axis) axis = {.peak = 8, .continuous = 2, .resolution = {}, .from = Provenance::kModel};
    next.J.leftCols<3>() = Eigen::Matrix3d::Identity();
    sent.reserve(100'000);
  }
  const DeviceId& id() const noexcept override { return name; }
  const DeviceCaps& caps() const noexcept override { return what; }
  Result<> bring_up(BringUp&) override { return up; }
  std::expected<Exchange, Errc> exchange(const ServoCommand& command, State& state) noexcept override {
    if (sent.size() < sent.capacity()) sent.push_back(command);
    if (how && *how != Exchange::kNothing) state = next;
    return how;
  }
  void send_zeros() noexcept override { ++silences; }
  [[nodiscard]] double force() const {
    const AxisArray& e = sent.back().effort;
    return std::hypot(e[0], e[1], e[2]);
  }
};

struct Wants final : ServoClient {
  AxisArray effort{};
  Duration lives = 5ms;
  Time now{};
  std::uint64_t seq = 0;
  std::vector<Errc> losses;
  State seen;
  Command tick(const State& state) noexcept override {
    seen = state;
    return {++seq, now + lives, CommandKind::kJointEffort, effort};
  }
  void lost(Errc why) noexcept override { losses.push_back(why); }
};

struct Nobody final : BringUp {
  void progress(std::string_view, double) override {}
  bool cancelled() const noexcept override { return false; }
};

class ServoCoreTest : public testing::Test {
 protected:
  ServoCoreTest() {
    auto made = std::make_unique<FakeDriver>();
    driver = made.get();
    core.emplace(std::move(made));
  }
  void bring_up() {
    Nobody nobody;
    ASSERT_TRUE(core->bring_up(nobody));
  }
  bool step(Duration by = 1ms) {
    now += by;
    client.now = now;
    return core->step(now, client);
  }
  void steps(int n) {
    for (int i = 0; i < n; ++i) step();
  }
  FakeDriver* driver;
  std::optional<ServoCore> core;
  Wants client;
  Time now{10s};
};

TEST_F(ServoCoreTest, GivesForcesOnlyWhenEnabledAndStartsThemSoftly) {
  bring_up();
  client.effort = {1, 0, 0};
  steps(100);
  EXPECT_EQ(core->phase(), Phase::kReady);
  EXPECT_EQ(driver->force(), 0.0);
  ASSERT_TRUE(core->enable());
  step();
  EXPECT_EQ(driver->force(), 0.0);
  steps(25);  // of 500 ms: 25/500 of 8 N allow 0.4 N
  EXPECT_NEAR(driver->force(), 0.4, 1e-9);
  steps(500);
  EXPECT_EQ(driver->force(), 1.0);
  core->disable();
  step();
  EXPECT_EQ(driver->force(), 0.0);
}

TEST_F(ServoCoreTest, ClampsAtThePeakAndKeepsTheDirection) {
  bring_up();
  ASSERT_TRUE(core->enable());
  steps(600);
  client.effort = {60, 80, 0};
  step();
  step();
  EXPECT_NEAR(driver->sent.back().effort[0], 4.8, 1e-9);
  EXPECT_NEAR(driver->sent.back().effort[1], 6.4, 1e-9);
  EXPECT_GE(core->counts().clamped, 1U);
}

// A motor at four times its continuous force (sixteen times the heat) must reduce to it. It may have its peak again
// only after it has cooled.
TEST_F(ServoCoreTest, ReducesForceToTheContinuousLimit) {
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {8, 0, 0};
  steps(560);  // by then 1.4 of the 4 N^2 that the motors sustain without time limit
  EXPECT_NEAR(driver->force(), 8.0, 1e-9);
  steps(60'000);
  EXPECT_NEAR(driver->force(), 2.0, 0.1);
  client.effort = {};
  steps(30'000);  // three time constants
  client.effort = {8, 0, 0};
  steps(2);
  EXPECT_NEAR(driver->force(), 8.0, 1e-6);
}

TEST_F(ServoCoreTest, ReleasesWithin20MillisecondsOfCommandExpiry) {
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {4, 0, 0};
  steps(600);
  EXPECT_EQ(driver->force(), 4.0);
  client.lives = -1ms;  // from now on commands have expired on arrival
  double before = 4.0;
  for (int i = 0; i < 30; ++i) {
    step();
    EXPECT_LE(driver->force(), before);
    before = driver->force();
  }
  EXPECT_EQ(driver->force(), 0.0);
  EXPECT_GE(core->counts().expired, 28U);
  // A thread that slept sends no old force on waking.
  client.lives = 5ms;
  steps(10);
  EXPECT_EQ(driver->force(), 4.0);
  step(200ms);
  EXPECT_EQ(driver->force(), 0.0);
}

TEST_F(ServoCoreTest, RestartsForcesAtZeroAfterAStall) {
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {2, 0, 0};
  steps(600);
  EXPECT_DOUBLE_EQ(driver->force(), 2);
  step(19ms);  // late, with a command that expired 14 ms ago: the force fades by the rule for expired commands
  EXPECT_NEAR(driver->force(), 2 * 0.3, 0.11);
  steps(600);
  EXPECT_DOUBLE_EQ(driver->force(), 2);
  step(500ms);
  EXPECT_EQ(driver->force(), 0);
  step();
  EXPECT_LT(driver->force(), 0.05);  // a five-hundredth of the peak, though 2 N are wanted
  steps(600);
  EXPECT_DOUBLE_EQ(driver->force(), 2);
}

TEST_F(ServoCoreTest, CountsNoMissingRepliesWhileTheHostIsStalled) {
  bring_up();
  ASSERT_TRUE(core->enable());
  steps(10);
  driver->how = Exchange::kNothing;
  step(500ms);  // of which 2 ms count; but a device must not stay without replies indefinitely because its host is slow
  EXPECT_EQ(core->phase(), Phase::kEnabled);
  steps(7);
  EXPECT_EQ(core->phase(), Phase::kEnabled);
  step();
  EXPECT_EQ(core->phase(), Phase::kFault);
}

TEST_F(ServoCoreTest, NeverSendsNonFiniteEffort) {
  bring_up();
  ASSERT_TRUE(core->enable());
  steps(600);
  RandomStream random{3};
  for (int i = 0; i < 20'000; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto kind = random.below(6);
      client.effort[a] = kind == 0   ? kNan
                         : kind == 1 ? std::numeric_limits<double>::infinity()
                         : kind == 2 ? random.uniform(-1e308, 1e308)
                                     : random.uniform(-10, 10);
      driver->next.x[static_cast<Eigen::Index>(a)] = random.below(50) == 0 ? kNan : 0.0;
    }
    driver->next.J(0, 0) = random.below(20) == 0 ? kNan : 1.0;
    step();
    ASSERT_TRUE(std::isfinite(driver->force())) << i;
    ASSERT_LE(driver->force(), 8.0 + 1e-9) << i;
    if (core->phase() == Phase::kFault) static_cast<void>(core->reset());
    if (core->phase() == Phase::kReady) static_cast<void>(core->enable());
  }
}

TEST_F(ServoCoreTest, RemovesForceAfterAJumpAndFaultsAfterMany) {
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {4, 0, 0};
  steps(600);
  driver->next.x[0] = 0.1;  // 100 m/s
  step();                   // the reading is evaluated after the command was sent
  step();
  EXPECT_LE(driver->force(), 8.0 / 500 + 1e-9);
  for (int i = 0; i < 3; ++i) {
    driver->next.x[0] = -driver->next.x[0];
    step();
  }
  EXPECT_EQ(core->phase(), Phase::kFault);
  step();
  EXPECT_EQ(driver->force(), 0.0);
  EXPECT_FALSE(core->enable());
  ASSERT_TRUE(core->reset());
  step();
  EXPECT_EQ(core->phase(), Phase::kReady);  // and not enabled automatically
}

TEST_F(ServoCoreTest, FaultsWithZerosAfterTenMillisecondsWithoutReplies) {
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {4, 0, 0};
  steps(600);
  driver->how = std::unexpected(Errc::kTimeout);
  steps(9);
  EXPECT_EQ(core->phase(), Phase::kEnabled);
  EXPECT_TRUE(client.seen.stale);
  step();
  EXPECT_EQ(core->phase(), Phase::kFault);
  driver->how = Exchange::kFresh;
  steps(50);
  EXPECT_EQ(driver->force(), 0.0);
  EXPECT_EQ(core->phase(), Phase::kFault);
  EXPECT_EQ(core->counts().unanswered, 10U);
}

// A stalled host sent no frames in that time. A reply that then comes late is one missing reply, not 30 ms of missing
// replies.
TEST_F(ServoCoreTest, DoesNotCountAHostStallAsDeviceSilence) {
  bring_up();
  ASSERT_TRUE(core->enable());
  steps(600);
  for (int i = 0; i < 20; ++i) {
    now += 30ms;
    driver->how = Exchange::kNothing;
    step();
    ASSERT_EQ(core->phase(), Phase::kEnabled);
    driver->how = Exchange::kFresh;
    step();
  }
  // A device that never replies is detected, however slow the host is.
  driver->how = Exchange::kNothing;
  for (int i = 0; i < 5; ++i) now += 30ms, step();
  EXPECT_EQ(core->phase(), Phase::kFault);
}

TEST_F(ServoCoreTest, LosesAnUnpluggedDeviceAtOnceAndForGood) {
  bring_up();
  ASSERT_TRUE(core->enable());
  steps(600);
  driver->how = std::unexpected(Errc::kUnplugged);
  EXPECT_FALSE(step());
  EXPECT_EQ(core->phase(), Phase::kLost);
  EXPECT_EQ(client.losses, std::vector{Errc::kUnplugged});
  driver->how = Exchange::kFresh;
  EXPECT_FALSE(step());
  EXPECT_EQ(client.losses.size(), 1U);
  EXPECT_FALSE(core->enable());
  EXPECT_FALSE(core->reset());
}

TEST_F(ServoCoreTest, GivesForceOnlyWhileHomed) {
  driver->what.homing = Homing::kManual;
  driver->next.homed = false;
  bring_up();
  client.effort = {1, 0, 0};
  steps(5);
  EXPECT_EQ(core->phase(), Phase::kUnhomed);
  EXPECT_TRUE(driver->sent.back().homing);
  EXPECT_EQ(core->enable().error().code, Errc::kNotHomed);
  driver->next.homed = true;
  driver->next.x[2] = 0.1346;  // the origin was reset: no jump
  steps(2);
  ASSERT_TRUE(core->enable());
  steps(600);
  EXPECT_EQ(driver->force(), 1.0);
  EXPECT_FALSE(driver->sent.back().homing);
  driver->next.homed = false;
  step();
  EXPECT_EQ(core->phase(), Phase::kUnhomed);
  step();
  EXPECT_EQ(driver->force(), 0.0);
  driver->next.homed = true;
  steps(600);
  EXPECT_EQ(core->phase(), Phase::kReady);  // only the user enables it again
  EXPECT_EQ(driver->force(), 0.0);
}

TEST_F(ServoCoreTest, LimitsForceToATenthWhileUncalibrated) {
  driver->what.force_calibrated = false;
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {8, 0, 0};
  steps(1000);
  EXPECT_LE(driver->force(), 0.8 + 1e-9);
  EXPECT_GT(driver->force(), 0.2 - 1e-9);
}

TEST_F(ServoCoreTest, GivesNoForceToADeviceThatDeclaresNone) {
  for (AxisLimit& axis : driver->what.axis) axis.peak.reset();
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {1, 1, 1};
  steps(1000);
  EXPECT_EQ(driver->force(), 0.0);
}

TEST_F(ServoCoreTest, RestartsForcesAfterAResyncWithoutAJump) {
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {4, 0, 0};
  steps(600);
  driver->how = Exchange::kResynced;
  driver->next.x[0] = 0.05;
  step();
  driver->how = Exchange::kFresh;
  step();
  EXPECT_LT(driver->force(), 0.1);
  EXPECT_EQ(core->phase(), Phase::kEnabled);
  EXPECT_EQ(core->counts().resyncs, 1U);
}

TEST_F(ServoCoreTest, ReportsAFailedBringUpAndIsNotReady) {
  driver->up = std::unexpected(DeviceError{Errc::kFirmware, "no firmware"});
  Nobody nobody;
  EXPECT_EQ(core->bring_up(nobody).error().message, "no firmware");
  EXPECT_EQ(core->phase(), Phase::kFault);
  EXPECT_FALSE(core->enable());
}

TEST_F(ServoCoreTest, ReloadsDeadFirmwareAndStaysDisabled) {
  driver->what.homing = Homing::kManual;
  driver->next.homed = false;
  bring_up();
  steps(5);
  driver->how = std::unexpected(Errc::kFirmware);
  EXPECT_TRUE(step());
  EXPECT_EQ(core->phase(), Phase::kBooting);
  const auto sent = driver->sent.size();
  EXPECT_TRUE(step());
  EXPECT_EQ(driver->sent.size(), sent);  // no exchange takes place
  EXPECT_FALSE(core->enable());
  driver->how = Exchange::kFresh;
  bring_up();
  steps(2);
  EXPECT_EQ(core->phase(), Phase::kUnhomed);
}

TEST_F(ServoCoreTest, StepsWithoutHeap) {
  bring_up();
  ASSERT_TRUE(core->enable());
  client.effort = {1, 2, 3};
  steps(10);
  const test::AllocGuard guard;
  steps(5000);
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::hal
