#include "client/seat/seat_guards.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

SeatGuards guards_of(SeatKind kind = SeatKind::kMaster) {
  SeatSetup s;
  s.seat.kind = kind;
  return {s, 3};
}

/// Updates `guards` for `ticks` ms with one reading, after the reference has moved by `reference` [m].
void run(SeatGuards& guards, const hal::State& reading, int ticks, double reference = 0) {
  static Time now{1s};
  for (int k = 0; k < ticks; ++k, now += 1ms)
    guards.update(now, reading, {k == 0 ? 0 : reference}, {k == 0 ? 0 : 100 * reference}, true);
}

TEST(SeatGuards, InhibitWhileTheTipIsTooFast) {
  SeatGuards guards = guards_of();
  hal::State fast, calm;
  fast.dx[0] = 1.6;
  run(guards, fast, 2);
  EXPECT_FALSE(guards.inhibit());
  run(guards, fast, 1);
  EXPECT_TRUE(guards.inhibit());
  EXPECT_FALSE(guards.latched());
  run(guards, calm, 250);
  EXPECT_FALSE(guards.inhibit());
}

TEST(SeatGuards, InhibitWhileTheMotorsAreTooHot) {
  SeatGuards guards = guards_of();
  hal::State hot, cool;
  hot.heat = 1.1;
  cool.heat = 0.5;
  run(guards, hot, 3);
  EXPECT_TRUE(guards.inhibit());
  run(guards, cool, 1);
  EXPECT_FALSE(guards.inhibit());
}

TEST(SeatGuards, InhibitWhileTheSensorIsStuckExceptAtASlave) {
  for (const SeatKind kind : {SeatKind::kMaster, SeatKind::kSlave}) {
    SeatGuards guards = guards_of(kind);
    run(guards, {}, 150, 0.01);  // 10 mm and 1 N without a changed bit
    EXPECT_EQ(guards.inhibit(), kind == SeatKind::kMaster);
    EXPECT_EQ(guards.stuck_sensor().stuck(), kind == SeatKind::kMaster);
  }
}

TEST(SeatGuards, LatchAfterThreeTripsUntilReset) {
  SeatGuards guards = guards_of();
  hal::State fast;
  fast.dx[0] = 1.6;
  for (int trip = 0; trip < 3; ++trip) {
    EXPECT_FALSE(guards.latched());
    run(guards, fast, 3);
    run(guards, {}, 250);
  }
  EXPECT_TRUE(guards.latched() && guards.inhibit());
  guards.reset();
  EXPECT_FALSE(guards.latched() || guards.inhibit());
}

}  // namespace
}  // namespace tandem::client
