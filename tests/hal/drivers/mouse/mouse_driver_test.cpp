#include "hal/drivers/mouse/mouse_driver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "tests/hal/drivers/manual_clock.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

struct Hand {
  MouseMove next;
  bool gone = false;
};
struct HandPipe final : MousePipe {
  explicit HandPipe(Hand& h) : hand(&h) {}
  std::expected<MouseMove, Errc> read() noexcept override {
    if (hand->gone) return std::unexpected(Errc::kUnplugged);
    MouseMove now = hand->next;
    hand->next = {.buttons = now.buttons};
    return now;
  }
  Hand* hand;
};

struct Rig {
  explicit Rig(const MouseDriver::Params& params = {})
      : driver("event5", std::make_unique<HandPipe>(hand), clock, params) {
    Patient patient;
    EXPECT_TRUE(driver.bring_up(patient));
  }
  void run(Duration time) {
    for (const Time end = clock.at + time; clock.at < end;) {
      clock.at += 1ms;
      ASSERT_EQ(driver.exchange({}, state), Exchange::kFresh);
    }
  }
  Hand hand;
  ManualClock clock;
  MouseDriver driver;
  State state;
};

TEST(MouseDriver, MovesTheTipInAPlaneAndItsWheelInDepth) {
  for (const bool table : {false, true}) {
    SCOPED_TRACE(table);
    Rig rig{{.metres_per_count = 1e-4, .plane = table ? MouseDriver::Plane::kTable : MouseDriver::Plane::kVertical}};
    rig.hand.next = {.right = 100, .forward = 200, .wheel = 2, .buttons = 5};
    rig.run(1s);
    const double forward = 0.020, wheel = 2 * MouseDriver::kPerDetent;
    EXPECT_NEAR(rig.state.x[0], 0.010, 1e-9);
    EXPECT_NEAR(rig.state.x[1], table ? forward : wheel, 1e-9);
    EXPECT_NEAR(rig.state.x[2], table ? wheel : forward, 1e-9);
    EXPECT_LT(rig.state.dx.norm(), 1e-9) << "silence is rest";
    EXPECT_EQ(rig.state.buttons, 5u);
  }
}

TEST(MouseDriver, BoundsItsSpeedAndReportsTheMatchingVelocity) {
  const RandomKey random{3};
  Rig rig;
  Vec3 before = rig.state.x;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    if (random.bits(3 * i) % 8 == 0)
      rig.hand.next = {.right = static_cast<int>(random.bits(3 * i + 1) % 2001) - 1000,
                       .forward = static_cast<int>(random.bits(3 * i + 2) % 2001) - 1000,
                       .wheel = static_cast<int>(i % 7) - 3};
    const Vec3 v_before = rig.state.dx;
    rig.run(1ms);
    const Vec3 mean = (rig.state.x - before) / 1e-3;
    EXPECT_LE(rig.state.dx.cwiseAbs().maxCoeff(), MouseDriver::kSpeedMax * 1.001);
    EXPECT_LE(rig.state.x.cwiseAbs().maxCoeff(), MouseDriver::kReach * 1.001);
    // Within a step the velocity changes by at most 100 m/s^2 (1 m/s reversed within the filter's time). It deviates
    // from the mean by half of that.
    EXPECT_LT((mean - 0.5 * (rig.state.dx + v_before)).norm(), 0.02);
    before = rig.state.x;
  }
}

TEST(MouseDriver, DoesNotOvershoot) {
  Rig rig;
  rig.hand.next = {.right = 100};
  for (int i = 0; i < 500; ++i) {
    rig.run(1ms);
    EXPECT_LE(rig.state.x[0], 0.010 + 1e-12);
    EXPECT_GE(rig.state.dx[0], -1e-9);
  }
}

TEST(MouseDriver, SurvivesAStalledThread) {
  Rig rig;
  rig.hand.next = {.right = 1000};
  rig.clock.at += 10s;
  State s;
  ASSERT_TRUE(rig.driver.exchange({}, s));
  EXPECT_LE(s.x[0], MouseDriver::kSpeedMax * 0.05 + 1e-9) << "no jump, whatever time passed";
}

TEST(MouseDriver, DeclaresNoForce) {
  Rig rig;
  ServoCommand command;
  command.seq = 9;
  command.effort = {1, 2, 3};
  ASSERT_TRUE(rig.driver.exchange(command, rig.state));
  EXPECT_EQ(rig.state.f_out, Vec3(Vec3::Zero()));
  EXPECT_EQ(rig.state.echo_command, 9u);
  for (const AxisLimit& axis : rig.driver.caps().axis) EXPECT_FALSE(axis.peak);
}

TEST(MouseDriver, ReportsUnplugging) {
  Rig rig;
  rig.hand.gone = true;
  const auto gone = rig.driver.exchange({}, rig.state);
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error(), Errc::kUnplugged);
}

TEST(MouseDriver, ExchangesWithoutHeap) {
  Rig rig;
  const test::AllocGuard guard;
  for (int i = 0; i < 100; ++i) {
    rig.hand.next.right = 5;
    rig.clock.at += 1ms;
    ASSERT_TRUE(rig.driver.exchange({}, rig.state));
  }
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace tandem::hal
