#include "client/app/missing_session.h"

#include <gtest/gtest.h>

#include <vector>

#include "common/auth/limiter.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr auto kNone = SeatAnswer::kNone, kMissing = SeatAnswer::kMissing, kOther = SeatAnswer::kOther;

TEST(MissingSession, IsGivenUpAfter15SecondsOfTheSameAnswer) {
  MissingSession session;
  EXPECT_EQ(session.wait(), 0s) << "before any answer";
  Time now{10s};
  for (int i = 0; i < 5; ++i, now += session.wait()) EXPECT_FALSE(session.on_attempt(now, kMissing)) << i;
  EXPECT_EQ(now, Time{25s});
  EXPECT_TRUE(session.on_attempt(now, kMissing));
}

TEST(MissingSession, IsAwaitedFromTheBeginningAfterAnyOtherAnswer) {
  MissingSession session;
  for (Time now{0s}; now <= Time{12s}; now += 3s) EXPECT_FALSE(session.on_attempt(now, kMissing));
  EXPECT_FALSE(session.on_attempt(Time{14s}, kOther));
  EXPECT_EQ(session.wait(), 0s) << "the session may be back at any moment";
  for (Time now{15s}; now <= Time{27s}; now += 3s) EXPECT_FALSE(session.on_attempt(now, kMissing));
  EXPECT_TRUE(session.on_attempt(Time{30s}, kMissing));
}

TEST(MissingSession, IsNotGivenUpByAttemptsWithoutAnswerNorAskedForMoreOften) {
  MissingSession session;
  EXPECT_FALSE(session.on_attempt(Time{0s}, kNone));
  EXPECT_EQ(session.wait(), 0s) << "a dead server may be back at any moment";
  EXPECT_FALSE(session.on_attempt(Time{1s}, kMissing));
  EXPECT_FALSE(session.on_attempt(Time{4s}, kMissing));
  EXPECT_FALSE(session.on_attempt(Time{7s}, kMissing));
  for (Time now{10s}; now <= Time{40s}; now += 3s) {
    EXPECT_FALSE(session.on_attempt(now, kNone));
    EXPECT_EQ(session.wait(), 3s);
  }
  EXPECT_TRUE(session.on_attempt(Time{43s}, kMissing));
}

TEST(MissingSession, IsNotGivenUpByFewAnswersFarApart) {
  MissingSession session;
  EXPECT_FALSE(session.on_attempt(Time{0s}, kMissing));
  EXPECT_FALSE(session.on_attempt(Time{20s}, kMissing));
  EXPECT_FALSE(session.on_attempt(Time{40s}, kMissing));
  EXPECT_TRUE(session.on_attempt(Time{43s}, kMissing));
}

/// 30 clients come back to the network within half a second, and meanwhile one new client per second joins.
TEST(MissingSession, OfThirtyClientsLeavesJoinsFromTheirAddressTheirConnections) {
  const auth::Source lab = auth::Source::of(auth::Origin::v4(0x0a000001));
  auth::AcceptLimiter server;
  struct Client {
    Time next;
    MissingSession session{};
    bool ended = false;
  };
  std::vector<Client> clients;
  for (int i = 0; i < 30; ++i) clients.push_back({Time{i * 17ms}});
  int connections = 0;
  for (Time now{0s}; now < Time{20s}; now += 1ms) {
    for (Client& client : clients) {
      if (client.ended || now < client.next) continue;
      ++connections;
      ASSERT_TRUE(server.accept(lab, now));
      client.ended = client.session.on_attempt(now, kMissing);
      client.next = now + client.session.wait();
    }
    const bool joins = now.time_since_epoch() % 1s == 0ms;
    ASSERT_TRUE(!joins || server.accept(lab, now)) << "a join";
  }
  EXPECT_EQ(connections, 30 * 6) << "at 0, 3, 6, 9, 12 and 15 s";
}

}  // namespace
}  // namespace tandem::client
