#include "client/app/server_watch.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

/// A watch that is updated every 100 ms.
struct Watch : ServerWatch {
  Watch() : ServerWatch(Time{10s}, 1s) {}
  std::optional<double> run(Duration length, bool present) {
    std::optional<double> ended;
    for (const Time until = now + length; now < until;) {
      now += 100ms;
      if (const auto outage = update(now, present)) ended = outage;
    }
    return ended;
  }
  Time now{10s};
};

TEST(ServerWatch, RequestsAReconnectAfterTheBackoffOfSilence) {
  Watch w;
  EXPECT_FALSE(w.run(5s, true));
  EXPECT_FALSE(w.reconnect_due(w.now));
  w.run(900ms, false);
  EXPECT_FALSE(w.reconnect_due(w.now));
  w.run(100ms, false);
  EXPECT_TRUE(w.reconnect_due(w.now));
  EXPECT_DOUBLE_EQ(w.absence(w.now), 1);
}

TEST(ServerWatch, WaitsLessForAServerThatAnnouncedItsEnd) {
  Watch w;
  w.run(300ms, false);
  w.hasten(400ms);
  EXPECT_FALSE(w.reconnect_due(w.now));
  w.hasten(900ms);
  w.run(100ms, false);
  EXPECT_TRUE(w.reconnect_due(w.now));
  w.on_reconnect(1s);
  w.on_connected(w.now);
  w.run(900ms, false);
  EXPECT_FALSE(w.reconnect_due(w.now)) << "the next reconnect waits as always";
}

TEST(ServerWatch, CountsAnOutageThatLastsUntilTheEnd) {
  Watch w;
  w.run(500ms, false);
  EXPECT_EQ(w.longest_s(), 0) << "a short silence";
  EXPECT_TRUE(w.on_reconnect(1s));
  w.run(60s, false);
  EXPECT_NEAR(w.longest_s(), 60.5, 1e-9);
}

TEST(ServerWatch, ReportsAnOutageOnlyAfterAReconnectBegan) {
  Watch w;
  w.run(500ms, false);
  EXPECT_FALSE(w.run(100ms, true)) << "a short silence";
  w.run(1s, false);
  EXPECT_TRUE(w.on_reconnect(2s));
  EXPECT_FALSE(w.on_reconnect(2s)) << "the outage lasts";
  w.run(1s, false);
  const auto outage = w.run(100ms, true);
  ASSERT_TRUE(outage);
  EXPECT_NEAR(*outage, 2.1, 1e-9);
  EXPECT_EQ(w.longest_s(), *outage);
  EXPECT_FALSE(w.run(100ms, true));
}

TEST(ServerWatch, GivesANewConnectionTimeForItsFirstForce) {
  Watch w;
  w.run(3s, false);
  w.on_connected(w.now);
  EXPECT_FALSE(w.reconnect_due(w.now));
  w.run(1s, false);
  EXPECT_TRUE(w.reconnect_due(w.now));
}

TEST(ServerWatch, KnowsStatusesOfBeforeTheNewestConnection) {
  Watch w;
  EXPECT_FALSE(w.outdated(0));
  w.on_connected(w.now);
  EXPECT_TRUE(w.outdated(0));
  EXPECT_FALSE(w.outdated(1));
}

TEST(ServerWatch, TakesAStallOfThisProgramForNoSilence) {
  Watch w;
  w.run(500ms, false);
  w.now += 60s;
  w.update(w.now, false);
  EXPECT_NEAR(w.absence(w.now), 0.5, 1e-9);
}

TEST(ServerWatch, KeepsTheLongestOutage) {
  Watch w;
  for (const Duration length : {3s, 2s}) {
    w.run(length, false);
    w.on_reconnect(1s);
    w.run(100ms, true);
  }
  EXPECT_NEAR(w.longest_s(), 3.1, 1e-9);
}

}  // namespace
}  // namespace tandem::client
