#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;
using falcon::FalconFixture;
using falcon::Watcher;

struct FalconFaultsTest : testing::Test {
  FalconFaultsTest() : bench(falcon::ready_model()) {
    Watcher watcher;
    const auto up = bench.driver.bring_up(watcher);
    EXPECT_TRUE(up);
    bench.begin();
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(bench.tick());
  }
  /// Ticks until a fresh reading, at most `limit` times. @return the number of ticks
  int until_fresh(int limit = 20) {
    for (int i = 1; i <= limit; ++i) {
      const auto result = bench.tick(push);
      if (result && *result == Exchange::kFresh) return i;
    }
    return limit + 1;
  }
  FalconFixture bench;
  ServoCommand push{.seq = 1, .effort = {0.05, 0.05, 0.05}};
};

TEST_F(FalconFaultsTest, IgnoresShortReplies) {
  bench.model.set_buttons(0);
  bench.model.faults.short_replies = 3;
  for (int i = 0; i < 8; ++i) {
    const auto result = bench.tick(push);
    ASSERT_TRUE(result);
    EXPECT_EQ(bench.state.buttons, 0u);
    EXPECT_TRUE(bench.state.homed);
    EXPECT_EQ(*result == Exchange::kNothing, i < 3) << i;
    EXPECT_EQ(*result == Exchange::kResynced, i == 3) << i;
  }
}

TEST_F(FalconFaultsTest, TakesTheNewestOfConcatenatedReplies) {
  bench.model.faults.glued_replies = 2;
  bench.model.mechanics().set_pull({.k = 1000, .b = 10, .m = 0.1, .x = Vec3(0.03, 0, 0)});
  EXPECT_EQ(*bench.tick(), Exchange::kNothing);
  EXPECT_EQ(*bench.tick(), Exchange::kNothing);
  const auto seq = bench.state.seq;
  const auto before = bench.state.raw;
  EXPECT_EQ(*bench.tick(), Exchange::kFresh);
  EXPECT_EQ(bench.state.seq, seq + 1);
  EXPECT_NE(bench.state.raw, before);
  const auto now = bench.model.mechanics().encoder();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(bench.state.raw[i], now[i], 60) << "an old answer was taken";
}

TEST_F(FalconFaultsTest, JoinsRepliesInTwoPieces) {
  bench.model.faults.split_replies = 1;
  EXPECT_EQ(*bench.tick(), Exchange::kNothing);
  EXPECT_EQ(*bench.tick(), Exchange::kFresh);
}

TEST_F(FalconFaultsTest, DiscardsAndReportsNoise) {
  bench.model.faults.noise_bytes = 9;
  EXPECT_EQ(*bench.tick(), Exchange::kResynced);
  EXPECT_TRUE(bench.state.resynced);
  EXPECT_EQ(*bench.tick(), Exchange::kFresh);
  EXPECT_FALSE(bench.state.resynced);
}

TEST_F(FalconFaultsTest, ReportsBytesLostByTheBridge) {
  bench.model.faults.line_errors = 1;
  EXPECT_EQ(*bench.tick(), Exchange::kResynced);
  EXPECT_TRUE(bench.state.resynced);
  EXPECT_EQ(*bench.tick(), Exchange::kFresh);
}

TEST_F(FalconFaultsTest, RejectsIllegalReplies) {
  const auto seq = bench.state.seq;
  bench.model.faults.flipped_replies = 2;
  EXPECT_EQ(*bench.tick(), Exchange::kNothing);
  EXPECT_EQ(*bench.tick(), Exchange::kNothing);
  EXPECT_EQ(bench.state.seq, seq);
  EXPECT_LE(until_fresh(), 2);
}

TEST_F(FalconFaultsTest, ContinuesAfterLostReplies) {
  bench.model.faults.lost_replies = 4;
  const auto frames = bench.model.frames();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(*bench.tick(push), Exchange::kNothing);
  EXPECT_EQ(bench.model.frames(), frames + 4) << "frames go on: the device must hear of every change";
  EXPECT_EQ(until_fresh(), 1);
}

TEST_F(FalconFaultsTest, ReportsASilentDeviceAsNothingNotAsAnError) {
  bench.model.faults.silent = true;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(*bench.tick(), Exchange::kNothing);
  bench.model.faults.silent = false;
  EXPECT_EQ(until_fresh(), 1);
}

TEST_F(FalconFaultsTest, TakesLateRepliesInTheNextExchange) {
  bench.model.faults.late = 3ms;
  int fresh = 0;
  for (int i = 0; i < 50; ++i) {
    const auto result = bench.tick();
    ASSERT_TRUE(result);
    fresh += *result != Exchange::kNothing ? 1 : 0;
  }
  EXPECT_GE(fresh, 10) << "one per 3 ms or so, in 50 ms: exchanges do not outlast their period";
  bench.model.faults.late = Duration{0};
  EXPECT_LE(until_fresh(), 3);
  // No reply stays queued: the newest reading is the present one.
  bench.model.mechanics().set_pull({.k = 1000, .b = 30, .m = 0.1, .x = Vec3(0.02, 0, 0)});
  for (int i = 0; i < 500; ++i) ASSERT_TRUE(bench.tick());
  EXPECT_LE((bench.state.x - bench.model.mechanics().tip()).norm(), 1e-4);
}

TEST_F(FalconFaultsTest, ClearsAndCountsStalls) {
  for (int* which : {&bench.model.faults.stall_in, &bench.model.faults.stall_out}) {
    *which = 1;
    const auto result = bench.tick();
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error(), Errc::kProtocol);
    EXPECT_LE(until_fresh(), 3);
  }
}

TEST_F(FalconFaultsTest, ReportsAJumpWithoutAVelocity) {
  bench.model.faults.jump_counts = 700;
  EXPECT_EQ(*bench.tick(), Exchange::kResynced);
  EXPECT_EQ(bench.state.dq[0], 0.0);
  EXPECT_TRUE(bench.state.resynced);
}

TEST_F(FalconFaultsTest, RejectsCountsWithoutAPoseAndGivesNoForce) {
  ASSERT_TRUE(bench.tick(push));
  ASSERT_NE(bench.model.order().motor[0], 0);
  bench.model.faults.jump_counts = 12000;
  const auto result = bench.tick(push);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error(), Errc::kProtocol);
  ASSERT_TRUE(bench.tick(push));
  EXPECT_EQ(bench.model.order().motor, (std::array<std::int16_t, 3>{})) << "the frame after a reading without pose";
  EXPECT_LE(until_fresh(), 2);
}

TEST_F(FalconFaultsTest, EndsEveryExchangeAtOnceWhenUnplugged) {
  const Time before = bench.clock.now();
  bench.model.unplug();
  const auto result = bench.driver.exchange(push, bench.state);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error(), Errc::kUnplugged);
  EXPECT_LE(bench.clock.now() - before, 1ms);
  bench.driver.send_zeros();
  Watcher watcher;
  EXPECT_EQ(bench.driver.bring_up(watcher).error().code, Errc::kUnplugged);
  bench.model.plug_in();
  ASSERT_TRUE(bench.driver.bring_up(watcher));
  EXPECT_EQ(bench.driver.boot_attempts(), 0) << "the supply kept the firmware";
  EXPECT_EQ(bench.model.order().motor, (std::array<std::int16_t, 3>{})) << "bring-up leaves zero effort";
  bench.begin();
  EXPECT_TRUE(bench.tick(push));
  bench.model.unplug();
  bench.model.lose_power();
  bench.model.plug_in();
  ASSERT_TRUE(bench.driver.bring_up(watcher));
  EXPECT_EQ(bench.driver.boot_attempts(), 1);
  bench.begin();
  ASSERT_TRUE(bench.tick(push));
  EXPECT_FALSE(bench.state.homed);
  EXPECT_EQ(bench.model.unsafe_frames(), 0u);
  EXPECT_EQ(bench.model.bad_frames(), 0u);
}

// Random faults at random times. There is never force while unhomed, except in frames sent before the loss was
// reported.
// Every number is finite, every kFresh reading is near the ground truth, and the servo recovers once the faults end.
TEST(FalconFaultSwarm, NeverPushesBlindlyAndAlwaysRecovers) {
  const std::uint64_t count = test::seeds(20);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    FalconFixture bench(falcon::ready_model());
    Watcher watcher;
    ASSERT_TRUE(bench.driver.bring_up(watcher));
    bench.begin();
    std::uint64_t drops = 0;
    for (int i = 0; i < 1500; ++i) {
      emulation::FalconFaults& f = bench.model.faults;
      switch (random.below(60)) {
        case 0:
          f.short_replies = static_cast<int>(random.below(4));
          break;
        case 1:
          f.glued_replies = static_cast<int>(random.below(4));
          break;
        case 2:
          f.split_replies = static_cast<int>(random.below(4));
          break;
        case 3:
          f.noise_bytes = static_cast<int>(random.below(40));
          break;
        case 4:
          f.flipped_replies = static_cast<int>(random.below(4));
          break;
        case 5:
          f.lost_replies = static_cast<int>(random.below(5));
          break;
        case 6:
          f.late = from_seconds(random.uniform(0, 4e-3));
          break;
        case 7:
          f.late = Duration{0};
          break;
        case 8:
          f.stall_in = 1;
          break;
        case 9:
          f.stall_out = 1;
          break;
        case 10:
          f.jump_counts = static_cast<int>(random.below(30000)) - 15000;
          break;
        case 11:
          bench.model.drop_homed(static_cast<std::uint8_t>(1 + random.below(7))), ++drops;
          break;
        case 12:
          bench.model.mechanics().set_pull(
              {.k = 500,
               .b = 5,
               .m = 0.1,
               .x = Vec3(random.uniform(-0.04, 0.04), random.uniform(-0.03, 0.03), random.uniform(-0.04, 0.04))});
          break;
        default:
          break;
      }
      ServoCommand command{.seq = static_cast<std::uint64_t>(i)};
      for (std::size_t k = 0; k < 3; ++k) command.effort[k] = random.uniform(-0.02, 0.02);
      const auto result = bench.tick(command);
      if (result) {
        ASSERT_TRUE(bench.state.x.allFinite() && bench.state.dx.allFinite() && bench.state.f_out.allFinite() &&
                    bench.state.J.allFinite());
      } else {
        ASSERT_TRUE(result.error() == Errc::kProtocol || result.error() == Errc::kFraming);
      }
      for (const auto c : bench.model.order().motor) ASSERT_LE(std::abs(c), kFalconMotorMax);
    }
    // Replies may be late by several frames or lost. Until a reply reports the drop, force continues. The guard's miss
    // limit, above the driver, ends it after 10 ms.
    ASSERT_LE(bench.model.unsafe_frames(), 12 * drops);
    bench.model.faults = {};
    for (int i = 0; i < 5; ++i) (void)bench.tick();
    for (int i = 0; i < 20; ++i) {
      const auto result = bench.tick();
      ASSERT_TRUE(result);
      ASSERT_EQ(*result, Exchange::kFresh) << i;
    }
  }
}

}  // namespace
}  // namespace tandem::hal
