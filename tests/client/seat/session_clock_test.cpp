#include "client/seat/session_clock.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using wire::SessionState;

constexpr double kTick = 0.001;

wire::ForceMessage force(SessionState session, std::uint32_t tick, std::uint32_t stops = 0) {
  wire::ForceMessage f;
  f.session = session;
  f.session_tick = tick;
  f.stops = stops;
  return f;
}

TEST(SessionClock, StartsWithTheRunningSession) {
  SessionClock clock{kTick, false};
  clock.on_force(force(SessionState::kWaiting, 0), Time{1s});
  EXPECT_EQ(clock.server_time(Time{1s}), std::nullopt);
  EXPECT_EQ(clock.session_time(Time{1s}), std::nullopt);
  clock.on_force(force(SessionState::kRunning, 500), Time{10s});  // began at 9.5 s
  EXPECT_DOUBLE_EQ(*clock.server_time(Time{12s}), 2.5);
  EXPECT_DOUBLE_EQ(*clock.session_time(Time{12s}), 2.5);
  clock.on_force(force(SessionState::kRunning, 3000), Time{12s});  // 0.5 s earlier by this count
  EXPECT_DOUBLE_EQ(*clock.server_time(Time{12s}), 2.5) << "without a stop the start stays";
}

TEST(SessionClock, HoldsTheServersTickWhileStopped) {
  SessionClock clock{kTick, false};
  clock.on_force(force(SessionState::kRunning, 0), Time{10s});
  clock.on_force(force(SessionState::kPaused, 4000, 1), Time{14s});
  EXPECT_TRUE(clock.stopped());
  EXPECT_DOUBLE_EQ(*clock.server_time(Time{20s}), 4);
  EXPECT_DOUBLE_EQ(*clock.session_time(Time{20s}), 4);
  clock.on_force(force(SessionState::kRunning, 4000, 1), Time{20s});
  EXPECT_FALSE(clock.stopped());
  EXPECT_DOUBLE_EQ(*clock.server_time(Time{21s}), 5) << "the 6 s of the stop do not count";
  EXPECT_DOUBLE_EQ(*clock.session_time(Time{21s}), 5);
}

TEST(SessionClock, RunsOnThroughAStopWhereTheSceneSaysSo) {
  SessionClock clock{kTick, true};
  clock.on_force(force(SessionState::kRunning, 0), Time{10s});
  clock.on_force(force(SessionState::kStopped, 4000, 1), Time{14s});
  EXPECT_FALSE(clock.stopped());
  EXPECT_DOUBLE_EQ(*clock.server_time(Time{20s}), 10);
}

TEST(SessionClock, CountsAnOutageInSessionTimeOnly) {
  SessionClock clock{kTick, false};
  clock.on_force(force(SessionState::kRunning, 0), Time{10s});
  clock.on_reconnect();
  EXPECT_EQ(clock.server_time(Time{15s}), std::nullopt);
  EXPECT_DOUBLE_EQ(*clock.session_time(Time{15s}), 5) << "simulated devices continue";
  clock.on_force(force(SessionState::kRunning, 3000), Time{20s});  // the checkpoint was 7 s behind
  EXPECT_DOUBLE_EQ(*clock.server_time(Time{21s}), 4);
  EXPECT_DOUBLE_EQ(*clock.session_time(Time{21s}), 11);
}

}  // namespace
}  // namespace tandem::client
