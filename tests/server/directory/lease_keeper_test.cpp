#include "server/directory/lease_keeper.h"

#include <gtest/gtest.h>

#include "server/directory/model_store.h"

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;

class LeaseKeeperTest : public testing::Test {
 protected:
  /// Sends the next request at `sent`, has it executed then and its answer delivered at `back`.
  bool exchange(Time sent, Time back) {
    const auto request = keeper_.poll_request(sent, ++operation_);
    if (!request) return false;
    store_.advance(sent);
    const Reply reply = store_.execute(operation_, *request);
    return keeper_.on_reply(back, reply);
  }
  /// Answers everything that is due at `now`, at once.
  void settle(Time now) {
    while (exchange(now, now)) {
    }
  }
  static Time at(Duration since) { return Time{} + since; }

  ModelStore store_;
  LeaseKeeper keeper_{"a", "text", LeaseTimes{}, DirectoryKeys{}};
  OperationId operation_ = 0;
};

TEST_F(LeaseKeeperTest, RegistersUnderItsLease) {
  EXPECT_LT(keeper_.quiet_at(), Time{});
  settle(at(0s));
  EXPECT_EQ(keeper_.poll_event(), LeaseKeeper::Event::kGranted);
  ASSERT_TRUE(keeper_.registered());
  EXPECT_EQ(store_.entries().at("/tandem/v1/live/servers/a").lease, keeper_.lease());
  keeper_.describe("new text");
  settle(at(0s));
  EXPECT_EQ(store_.entries().at("/tandem/v1/live/servers/a").value, "new text");
}

TEST_F(LeaseKeeperTest, CountsFromTheTimeOfSending) {
  settle(at(0s));
  EXPECT_EQ(keeper_.hold_at(), at(2s));
  EXPECT_EQ(keeper_.quiet_at(), at(2200ms));
  ASSERT_TRUE(exchange(at(500ms), at(1400ms)));  // the renewal: its answer is late
  EXPECT_EQ(keeper_.hold_at(), at(2s));          // not confirmed yet
  ASSERT_TRUE(exchange(at(1400ms), at(1900ms)));
  EXPECT_EQ(keeper_.hold_at(), at(2500ms));
}

TEST_F(LeaseKeeperTest, CountsNoRenewalAcrossAnElection) {
  settle(at(0s));
  ASSERT_TRUE(exchange(at(500ms), at(500ms)));
  store_.elect();
  ASSERT_TRUE(exchange(at(510ms), at(510ms)));
  EXPECT_EQ(keeper_.hold_at(), at(2s));
  EXPECT_EQ(keeper_.doubtful_renewals(), 1U);
  settle(at(1s));
  EXPECT_EQ(keeper_.hold_at(), at(3s));
}

TEST_F(LeaseKeeperTest, GivesUpALeaseThatTheStoreHasEnded) {
  settle(at(0s));
  (void)keeper_.poll_event();
  const LeaseId first = keeper_.lease();
  store_.advance(at(4s));
  ASSERT_TRUE(exchange(at(4s), at(4s)));
  EXPECT_EQ(keeper_.poll_event(), LeaseKeeper::Event::kLost);
  EXPECT_LT(keeper_.quiet_at(), Time{});
  settle(at(4s));
  EXPECT_NE(keeper_.lease(), first);
  EXPECT_EQ(keeper_.hold_at(), at(6s));
}

TEST_F(LeaseKeeperTest, AsksAgainWithoutAnAnswerAndIgnoresTheLateOne) {
  const auto lost = keeper_.poll_request(at(0s), 1);
  ASSERT_TRUE(lost);
  EXPECT_FALSE(keeper_.poll_request(at(999ms), 2));
  ASSERT_TRUE(keeper_.poll_request(at(1s), 3));
  EXPECT_FALSE(keeper_.on_reply(at(1100ms), store_.execute(1, *lost)));
  EXPECT_EQ(keeper_.lease(), 0);
}

TEST_F(LeaseKeeperTest, WaitsWhileItsNameIsTaken) {
  const LeaseId other = store_.execute(100, Grant{3s}).lease;
  (void)store_.execute(101, Transaction{{}, {Put{"/tandem/v1/live/servers/a", "other", other}}, {}});
  settle(at(0s));
  EXPECT_EQ(keeper_.poll_event(), LeaseKeeper::Event::kNameTaken);
  EXPECT_FALSE(keeper_.registered());
  for (Duration now = 0s; now <= 4s; now += 100ms) settle(at(now));
  EXPECT_TRUE(keeper_.registered());
}

TEST_F(LeaseKeeperTest, RegistersAgainWhenItsKeyWasErased) {
  settle(at(0s));
  (void)store_.execute(100, Transaction{{}, {Erase{"/tandem/v1/live/servers/a"}}, {}});
  settle(at(600ms));
  EXPECT_TRUE(keeper_.registered());
  EXPECT_TRUE(store_.entries().contains("/tandem/v1/live/servers/a"));
}

}  // namespace
}  // namespace tandem::directory
