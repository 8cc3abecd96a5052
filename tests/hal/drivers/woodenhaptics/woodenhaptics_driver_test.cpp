#include "hal/drivers/woodenhaptics/woodenhaptics_driver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal::woodenhaptics {
namespace {

using namespace std::chrono_literals;
using test::WoodenHapticsFixture;
using Currents = std::array<std::int16_t, 3>;

const Vec3 kSomeEffort(0.2, -0.1, 0.15);

WoodenHapticsOptions options_of(WoodenProtocol protocol, bool energise = true) {
  WoodenHapticsOptions options{.spec = test::wooden_2015(), .enable_motors = energise};
  options.spec.protocol = protocol;
  return options;
}

bool only_zeros(const emulation::WoodenHapticsModel& model) {
  for (std::size_t i = 0; i < model.host_reports() && i < emulation::WoodenHapticsModel::kRemembered; ++i) {
    if (model.host_report(i).current_ma != Currents{} && !model.host_report(i).preset) return false;
  }
  return true;
}

class EveryProtocol : public testing::TestWithParam<WoodenProtocol> {};
INSTANTIATE_TEST_SUITE_P(Boards, EveryProtocol,
                         testing::Values(WoodenProtocol::kV1, WoodenProtocol::kV2, WoodenProtocol::kRaw64));

TEST_P(EveryProtocol, StartsUnhomedWithZeros) {
  WoodenHapticsFixture b(options_of(GetParam()));
  ASSERT_TRUE(b.bring_up());
  for (int i = 0; i < 50; ++i) ASSERT_EQ(b.step(kSomeEffort, true), Exchange::kFresh);
  EXPECT_FALSE(b.state.homed);
  EXPECT_TRUE(b.state.saturated) << "effort was asked for and not given";
  EXPECT_GT(b.model.host_reports(), 50u);
  EXPECT_TRUE(only_zeros(b.model));
}

TEST_P(EveryProtocol, SendsNoCurrentUnlessMotorsAreEnabled) {
  WoodenHapticsFixture b(options_of(GetParam(), false));
  ASSERT_TRUE(b.bring_up());
  b.driver.home_here();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(b.step());
  ASSERT_TRUE(b.state.homed);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(b.step(kSomeEffort));
  EXPECT_TRUE(only_zeros(b.model));
  EXPECT_EQ(b.state.f_out, Vec3::Zero());
}

TEST_P(EveryProtocol, FollowsTheArmOnceHomedByTheHost) {
  WoodenHapticsFixture b(options_of(GetParam()));
  ASSERT_TRUE(b.bring_up());
  b.driver.home_here();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step());
  ASSERT_TRUE(b.state.homed);
  EXPECT_LT((b.state.x - b.model.tip()).norm(), 1e-4);
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.05, -0.03, 0.04), Vec3(-0.06, 0.05, -0.02)}) {
    ASSERT_TRUE(b.walk_to(x));
    ASSERT_TRUE(b.step());
    EXPECT_LT((b.state.x - x).norm(), 1e-4) << "one count is 72 um at most";
    EXPECT_TRUE(b.state.homed);
    EXPECT_FALSE(b.state.resynced);
  }
}

TEST_P(EveryProtocol, GivesTheRequestedForce) {
  WoodenHapticsFixture b(options_of(GetParam()));
  ASSERT_TRUE(b.bring_up());
  b.driver.home_here();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step());
  ASSERT_TRUE(b.walk_to(Vec3::Zero()));
  const Vec3 wanted(0.5, -1.0, 0.8);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step(b.state.J.leftCols<3>().transpose() * wanted));
  EXPECT_LT((b.model.motor_force() - wanted).norm(), 0.01);
  EXPECT_LT((b.state.f_out - wanted).norm(), 0.01);
  EXPECT_FALSE(b.state.saturated);
  EXPECT_EQ(b.state.echo_command, b.seq - 1);
}

TEST_P(EveryProtocol, ExchangesWithoutHeap) {
  WoodenHapticsFixture b(options_of(GetParam()));
  ASSERT_TRUE(b.bring_up());
  b.driver.home_here();
  const test::AllocGuard guard;
  for (int i = 0; i < 100; ++i) (void)b.step(kSomeEffort);
  b.driver.send_zeros();
  EXPECT_EQ(guard.count(), 0u);
}

TEST_P(EveryProtocol, SendsThreeZerosWhenSilenced) {
  WoodenHapticsFixture b(options_of(GetParam()));
  ASSERT_TRUE(b.bring_up());
  b.driver.home_here();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(b.step(i < 5 ? Vec3(Vec3::Zero()) : kSomeEffort));
  ASSERT_NE(b.model.motor_effort(), Vec3::Zero());
  const std::uint64_t before = b.model.host_reports();
  b.driver.send_zeros();
  EXPECT_EQ(b.model.host_reports(), before + 3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(b.model.host_report(i).current_ma, Currents{});
  EXPECT_EQ(b.model.motor_effort(), Vec3::Zero());
}

TEST_P(EveryProtocol, ReportsUnpluggingAtOnceAtAnyCall) {
  for (int calls = 0; calls < 120; ++calls) {
    SCOPED_TRACE(calls);
    WoodenHapticsFixture b(options_of(GetParam()));
    b.pipe.unplug_after(calls);
    const auto up = b.bring_up();
    if (!up) {
      EXPECT_EQ(up.error().code, Errc::kUnplugged);
      EXPECT_FALSE(b.model.plugged_in());
      continue;
    }
    b.driver.home_here();
    std::expected<Exchange, Errc> how = Exchange::kFresh;
    for (int i = 0; i < 100 && how; ++i) {
      how = b.step(i < 10 ? Vec3(Vec3::Zero()) : kSomeEffort);
      EXPECT_EQ(how.has_value(), b.model.plugged_in()) << "exchange " << i;
    }
    ASSERT_FALSE(how);
    EXPECT_EQ(how.error(), Errc::kUnplugged);
    b.driver.send_zeros();
    EXPECT_EQ(b.model.motor_effort(), Vec3::Zero());
    b.model.plug_in();
    EXPECT_FALSE(b.model.amplifiers_on());
  }
}

TEST_P(EveryProtocol, ReportsTheEffortAppliedBetweenReadings) {
  WoodenHapticsFixture b(options_of(GetParam()));
  ASSERT_TRUE(b.bring_up());
  b.driver.home_here();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step());
  ASSERT_TRUE(b.walk_to(Vec3::Zero()));
  RandomStream r(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 before = b.model.motor_effort();  // of the previous command, until the next one arrives
    const Time read = b.state.sampled_at;
    ASSERT_TRUE(b.step(Vec3(r.uniform(-0.9, 0.9), r.uniform(-0.7, 0.7), r.uniform(-0.7, 0.7))));
    const Vec3 told(b.state.tau_out[0], b.state.tau_out[1], b.state.tau_out[2]);
    // A board that replies samples on arrival of the command; one that sends unprompted samples after the command has
    // acted for a while.
    const double share = GetParam() == WoodenProtocol::kV1
                             ? seconds(b.model.host_report(0).at - read) / seconds(b.state.sampled_at - read)
                             : 1.0;
    const Vec3 given = share * before + (1 - share) * b.model.motor_effort();
    ASSERT_LT((told - given).norm(), 1e-12) << i;
    const Vec3 dq(b.state.dq[0], b.state.dq[1], b.state.dq[2]);
    ASSERT_NEAR(b.state.f_out.dot(b.state.dx), told.dot(dq), 1e-12);
  }
}

TEST(WoodenDriver, KeepsCurrentsInTheClampForAnyCommand) {
  WoodenHapticsFixture b(options_of(WoodenProtocol::kV2));
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  for (const double e : {1.0, 100.0, 1e6, 1e308}) {
    ASSERT_TRUE(b.step(Vec3(e, -e, e)));
    for (const auto ma : b.model.host_report(0).current_ma) EXPECT_LE(std::abs(ma), 2000) << e;
    ASSERT_TRUE(b.step());
    EXPECT_TRUE(b.state.saturated || e == 1.0 || b.model.host_report(0).current_ma == Currents{});
  }
}

TEST(WoodenDriver, RecoversFromLateRepliesWithoutLag) {
  WoodenHapticsFixture b(options_of(WoodenProtocol::kV2));
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  b.model.faults.late = 2500us;  // longer than the time-out of an exchange
  EXPECT_EQ(b.step(), Exchange::kNothing);
  b.model.faults.late = Duration{0};
  b.time.wait_until(b.time.now() + 3ms);  // it arrives between two exchanges and is queued
  int late = 0;
  for (int i = 0; i < 10; ++i) {
    const auto how = b.step();
    ASSERT_TRUE(how);
    late += *how == Exchange::kNothing ? 1 : 0;
  }
  EXPECT_LE(late, 2);
  b.time.wait_until(b.time.now() + 500us);  // a delayed reply would be in transit by now
  b.model.place(b.model.tip() + Vec3(0.004, 0, 0));
  ASSERT_EQ(b.step(), Exchange::kFresh);
  EXPECT_LT((b.state.x - b.model.tip()).norm(), 1e-4) << "the reading is of now, not of the exchange before";
}

TEST(WoodenDriver, TakesTheNewestReportOfAStreamingBoard) {
  WoodenHapticsFixture b(options_of(WoodenProtocol::kV1));
  b.time.wait_until(b.time.now() + 200ms);  // more than its queue holds
  ASSERT_TRUE(b.bring_up());
  b.driver.home_here();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step());
  ASSERT_TRUE(b.state.homed);
  for (int i = 1; i <= 40; ++i) {
    b.model.place(b.model.tip() + Vec3(0.0005, 0, 0));
    b.time.wait_until(b.time.now() + 1ms);
  }
  ASSERT_TRUE(b.step());
  EXPECT_LT((b.state.x - b.model.tip()).norm(), 1e-4);
}

/// Pipe that records when the last read report was sampled: 0.2 ms after power-up, then every millisecond.
struct DatingPipe final : HidPipe {
  DatingPipe(HidPipe& to, test::HidModelClock& at) : pipe(to), time(at) {}
  Moved write(std::span<const std::byte> report) noexcept override { return pipe.write(report); }
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override {
    const Moved moved = pipe.read(into, timeout);
    if (moved && *moved > 0) sampled = Time{} + 200us + (time.now() - Time{} - 200us) / 1ms * 1ms;
    return moved;
  }
  HidPipe& pipe;
  test::HidModelClock& time;
  Time sampled{};
};

// For every phase between the two clocks. A spring rendered on older readings pushes an arm that is not held.
TEST(WoodenDriver, UsesReadingsUnderOnePeriodOldOfAStreamingBoard) {
  Duration oldest{0};
  for (int phase = 0; phase < 20; ++phase) {
    WoodenHapticsFixture b(options_of(WoodenProtocol::kV1));
    DatingPipe pipe(b.pipe, b.time);
    WoodenHapticsDriver driver({"woodenhaptics", "1"}, pipe, b.time, options_of(WoodenProtocol::kV1));
    test::QuietBringUp watcher;
    ASSERT_TRUE(driver.bring_up(watcher));
    Time due = b.time.now() + phase * 50us;
    for (int i = 0; i < 50; ++i) {
      b.time.wait_until(due += 1ms);
      const Time sampled = pipe.sampled;  // the reading a client had when it chose the force
      ASSERT_EQ(driver.exchange({}, b.state), Exchange::kFresh);
      if (i > 2) oldest = std::max(oldest, b.model.host_report(0).at - sampled);
    }
  }
  EXPECT_LE(oldest, 1ms + 200us) << "and 0.1 ms for the write, 0.05 ms for the look";
}

// A program that stalled for some milliseconds takes the next two readings at nearly the same time.
TEST_P(EveryProtocol, DerivesNoVelocityFromAHostStall) {
  for (int stall = 1; stall <= 9; ++stall) {
    for (int soon = 0; soon < 10; ++soon) {
      WoodenHapticsFixture b(options_of(GetParam()));
      ASSERT_TRUE(b.bring_up());
      b.driver.home_here();
      for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step());
      ASSERT_TRUE(b.walk_to(Vec3(-0.02, 0, 0)));
      constexpr double kSpeed = 1.0;  // [m/s]
      const Time begin = b.time.now();
      const auto go_on = [&](Duration d) {  // the arm moves while the host sleeps
        for (const Time until = b.time.now() + d; b.time.now() < until; b.time.wait_until(b.time.now() + 10us)) {
          ASSERT_TRUE(b.model.place(Vec3(-0.02 + kSpeed * seconds(b.time.now() - begin), 0, 0)));
        }
      };
      const auto look = [&] {
        ASSERT_TRUE(b.driver.exchange({}, b.state));
        ASSERT_LT(b.state.dx.norm(), 3.0) << "beyond this the guard takes a reading for impossible: stall " << stall
                                          << " ms, then " << soon << " x 0.1 ms";
      };
      for (int i = 0; i < 8; ++i) go_on(1ms), look();
      go_on(stall * 1ms), look();
      go_on(soon * 100us), look();
      for (int i = 0; i < 3; ++i) go_on(1ms), look();
      EXPECT_NEAR(b.state.dx[0], kSpeed, 0.8);
    }
  }
}

TEST(WoodenDriver, ReportsASilentBoardAfter20Attempts) {
  WoodenHapticsFixture b(options_of(WoodenProtocol::kV2));
  b.model.faults.silent = true;
  const auto up = b.bring_up();
  ASSERT_FALSE(up);
  EXPECT_EQ(up.error().code, Errc::kTimeout);
  EXPECT_NE(up.error().message.find("silent"), std::string::npos);
  EXPECT_GE(b.model.host_reports(), 20u);
  EXPECT_TRUE(only_zeros(b.model));
  b.model.faults.silent = false;
  EXPECT_TRUE(b.bring_up()) << "a second try is a whole one";
}

TEST(WoodenDriver, NamesTheRightProtocolForForeignReports) {
  for (const auto& [there, said, word] : {std::tuple{WoodenProtocol::kV1, WoodenProtocol::kV2, "protocol: V1"},
                                          std::tuple{WoodenProtocol::kRaw64, WoodenProtocol::kV2, "protocol: RAW64"},
                                          std::tuple{WoodenProtocol::kV1, WoodenProtocol::kRaw64, "protocol: V1"}}) {
    emulation::WoodenHapticsModel model({.spec = options_of(there).spec});
    test::HidModelClock time(model);
    test::HidModelPipe pipe(model, time);
    WoodenHapticsDriver driver({"woodenhaptics", "1"}, pipe, time, options_of(said));
    test::QuietBringUp watcher;
    const auto up = driver.bring_up(watcher);
    ASSERT_FALSE(up);
    EXPECT_EQ(up.error().code, Errc::kProtocol);
    EXPECT_NE(up.error().message.find(word), std::string::npos) << up.error().message;
    EXPECT_EQ(model.motor_effort(), Vec3::Zero());
  }
}

TEST(WoodenDriver, IgnoresMalformedReports) {
  WoodenHapticsFixture b(options_of(WoodenProtocol::kV2));
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  const Vec3 x = b.state.x;
  b.model.faults.odd_reports = 1;
  const auto how = b.step();
  ASSERT_FALSE(how);
  EXPECT_EQ(how.error(), Errc::kFraming);
  EXPECT_EQ(b.state.x, x);
  EXPECT_EQ(b.step(), Exchange::kFresh);
  b.model.faults.lost_reports = 3;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(b.step(), Exchange::kNothing);
  EXPECT_EQ(b.step(), Exchange::kFresh);
  EXPECT_TRUE(b.state.homed);
}

TEST(WoodenDriver, ReportsAStalledEndpointAsAProtocolError) {
  WoodenHapticsFixture b(options_of(WoodenProtocol::kV2));
  ASSERT_TRUE(b.bring_up());
  b.model.faults.stalled_out = true;
  const auto how = b.step();
  ASSERT_FALSE(how);
  EXPECT_EQ(how.error(), Errc::kProtocol);
  b.model.faults.stalled_out = false;
  EXPECT_TRUE(b.step());
}

TEST(WoodenDriver, StopsBringUpWhenCancelled) {
  WoodenHapticsFixture b(options_of(WoodenProtocol::kV2));
  test::QuietBringUp watcher(true);
  const auto up = b.driver.bring_up(watcher);
  ASSERT_FALSE(up);
  EXPECT_EQ(up.error().code, Errc::kBadState);
}

TEST(WoodenDriver, ContinuesCountersPastTheirWrap) {
  WoodenHapticsOptions options = options_of(WoodenProtocol::kV2);
  options.spec.counts_per_turn = 40000;
  options.spec.calibration_counts = {32000, 30000, 27140};
  const Kinematics k(options.spec);
  WoodenHapticsFixture b(options);
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  EXPECT_NEAR(b.state.raw[0], 32000, 1);
  const Vec3 q0 = b.model.q();
  for (int i = 0; i < 400; ++i) {
    const Vec3 q = q0 + 0.001 * i * Vec3(1, 1, 1);
    ASSERT_TRUE(b.model.place(k.tip(q)));
    ASSERT_EQ(b.step(), Exchange::kFresh);
    for (std::size_t m = 0; m < 3; ++m) ASSERT_NEAR(b.state.q[m], b.model.q()[static_cast<int>(m)], 2e-5) << i;
  }
  EXPECT_GT(b.state.raw[0], 40000);
}

TEST(WoodenDriver, ReportsButtons) {
  WoodenHapticsOptions options = options_of(WoodenProtocol::kRaw64);
  options.spec.stylus_on_encoder_d = true;
  WoodenHapticsFixture b(options);
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.step());
  EXPECT_EQ(b.state.buttons, 0u);
  b.model.hold_stylus(true);
  ASSERT_TRUE(b.step());
  ASSERT_TRUE(b.step());
  EXPECT_EQ(b.state.buttons, 1u);
  EXPECT_EQ(b.state.raw[3], 0);
}

TEST(WoodenDriver, ReleasesByTheBoardsWatchdogAfterHalfASecond) {
  WoodenHapticsFixture b(options_of(WoodenProtocol::kV2));
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(b.step(kSomeEffort));
  const Vec3 held = b.model.motor_effort();
  ASSERT_NE(held, Vec3::Zero());
  b.time.wait_until(b.time.now() + 490ms);  // the program hangs
  EXPECT_EQ(b.model.motor_effort(), held) << "that long it pushes on: the host has to be faster";
  b.time.wait_until(b.time.now() + 20ms);
  EXPECT_FALSE(b.model.amplifiers_on());
  EXPECT_EQ(b.model.motor_effort(), Vec3::Zero());
  // A restarted program activates the amplifiers with its first report, which is therefore a zero.
  ASSERT_TRUE(b.bring_up());
  EXPECT_TRUE(b.model.amplifiers_on());
  EXPECT_EQ(b.model.motor_effort(), Vec3::Zero());
  EXPECT_FALSE(b.driver.homed());
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
