#include "server/app/process/tick_watchdog.h"

#include <gtest/gtest.h>

#include <array>

namespace tandem::server {
namespace {

using Counts = std::array<std::optional<std::uint64_t>, 2>;

TEST(TickWatchdog, SeesABusyShardThatStopsBesideAnIdleOne) {
  TickWatchdog watchdog;
  EXPECT_TRUE(watchdog.update(Counts{1'000'000, 50'000}));
  EXPECT_TRUE(watchdog.update(Counts{1'000'250, 50'013}));
  EXPECT_FALSE(watchdog.update(Counts{1'000'250, 50'026})) << "the busy shard stopped, far ahead of the idle one";
  EXPECT_FALSE(watchdog.update(Counts{1'000'250, 2'000'000}));
  EXPECT_TRUE(watchdog.update(Counts{1'000'251, 2'000'001}));
}

TEST(TickWatchdog, WaitsForTheSlowestShard) {
  TickWatchdog watchdog;
  EXPECT_TRUE(watchdog.update(Counts{10, 10}));
  EXPECT_FALSE(watchdog.update(Counts{11, 10}));
  EXPECT_TRUE(watchdog.update(Counts{11, 11})) << "both ticked since the last time, though not in one interval";
}

TEST(TickWatchdog, ExpectsNothingOfAShardThatHasEnded) {
  TickWatchdog watchdog;
  EXPECT_TRUE(watchdog.update(Counts{10, 10}));
  EXPECT_TRUE(watchdog.update(Counts{11, std::nullopt}));
  EXPECT_TRUE(watchdog.update(Counts{12, std::nullopt}));
  EXPECT_FALSE(watchdog.update(Counts{12, std::nullopt}));
}

TEST(TickWatchdog, CountsAShardThatWasAdded) {
  TickWatchdog watchdog;
  EXPECT_TRUE(watchdog.update(Counts{10, std::nullopt}));
  const std::array<std::optional<std::uint64_t>, 3> three{11, std::nullopt, 0};
  EXPECT_FALSE(watchdog.update(three)) << "it has not ticked yet";
}

}  // namespace
}  // namespace tandem::server
