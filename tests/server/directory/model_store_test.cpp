#include "server/directory/model_store.h"

#include <gtest/gtest.h>

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;

class ModelStoreTest : public testing::Test {
 protected:
  Reply run(const Request& request) { return store_.execute(++newest_, request); }
  Reply put(const std::string& key, const std::string& value, LeaseId lease = 0) {
    return run(Transaction{{}, {Put{key, value, lease}}, {}});
  }
  std::vector<KeyValue> read(const std::string& key, bool prefix = false) {
    return run(Transaction{{}, {Read{key, prefix}}, {}}).found.at(0);
  }
  LeaseId grant(Duration ttl = 3s) { return run(Grant{ttl}).lease; }

  ModelStore store_;
  OperationId newest_ = 0;
};

TEST_F(ModelStoreTest, CountsARevisionPerWritingTransaction) {
  EXPECT_EQ(store_.revision(), 1);
  EXPECT_EQ(put("a", "1").revision, 2);
  EXPECT_EQ(run(Transaction{{}, {Put{"b", "1"}, Put{"c", "1"}}, {}}).revision, 3);
  EXPECT_EQ(run(Transaction{{}, {Erase{"none"}}, {}}).revision, 3);
  EXPECT_EQ(run(Transaction{{}, {Read{"a"}}, {}}).revision, 3);
  EXPECT_EQ(put("a", "2").revision, 4);
  EXPECT_EQ(read("a"), (std::vector<KeyValue>{{"a", "2", 2, 4, 0}}));
  EXPECT_EQ(read("", true).size(), 3U);
}

TEST_F(ModelStoreTest, ChoosesTheBranchByRevisionsAndLeases) {
  const LeaseId lease = grant();
  const Transaction claim{{{"k", Condition::Of::kCreated, 0}}, {Put{"k", "one", lease}}, {Read{"k"}}};
  EXPECT_TRUE(run(claim).held);
  const Reply second = run(claim);
  EXPECT_FALSE(second.held);
  EXPECT_EQ(second.found.at(0).at(0).value, "one");
  EXPECT_TRUE(run(Transaction{{{"k", Condition::Of::kLease, lease}}, {}, {}}).held);
  EXPECT_TRUE(run(Transaction{{{"k", Condition::Of::kModified, 2}}, {}, {}}).held);
  EXPECT_FALSE(run(Transaction{{{"k", Condition::Of::kModified, 3}}, {}, {}}).held);
}

TEST_F(ModelStoreTest, RefusesAKeyThatIsWrittenTwiceAndALeaseThatIsGone) {
  EXPECT_EQ(run(Transaction{{}, {Put{"k", "1"}, Erase{"k"}}, {}}).outcome, Outcome::kRefused);
  EXPECT_EQ(run(Transaction{{}, {Put{"a", "1"}, Put{"k", "1", 99}}, {}}).outcome, Outcome::kNoLease);
  EXPECT_TRUE(read("a").empty());
  EXPECT_EQ(run(Renew{99}).outcome, Outcome::kNoLease);
  EXPECT_EQ(run(Revoke{99}).outcome, Outcome::kNoLease);
  EXPECT_EQ(store_.revision(), 1);
}

TEST_F(ModelStoreTest, EndsALeaseExactlyAtItsTimeWithAllItsKeysInOneRevision) {
  const LeaseId lease = grant(3s);
  put("a", "1", lease);
  put("b", "1", lease);
  put("b", "2");  // leaves the lease
  put("c", "1", lease);
  store_.advance(Time{} + 2s);
  EXPECT_EQ(run(Renew{lease}).ttl, 3s);
  store_.advance(Time{} + 5s - 1ns);
  EXPECT_EQ(read("a").size(), 1U);
  store_.advance(Time{} + 5s);
  EXPECT_EQ(store_.revision(), 6);
  EXPECT_EQ(read("", true), (std::vector<KeyValue>{{"b", "2", 3, 4, 0}}));
  EXPECT_EQ(store_.leases(), 0U);
}

TEST_F(ModelStoreTest, TellsTheRestOfALeaseWithoutExtendingIt) {
  const LeaseId lease = grant(3s);
  EXPECT_EQ(run(Remaining{lease}).ttl, 3s);
  store_.advance(Time{} + 1200ms);
  EXPECT_EQ(run(Remaining{lease}).ttl, 1s) << "whole seconds";
  store_.advance(Time{} + 3s - 1ns);
  EXPECT_EQ(run(Remaining{lease}).ttl, 0s);
  store_.advance(Time{} + 3s);
  EXPECT_EQ(run(Remaining{lease}).outcome, Outcome::kNoLease);
}

TEST_F(ModelStoreTest, GivesEveryLeaseItsWholeTimeAtAnElectionAndADeposedLeaderNone) {
  const LeaseId lease = grant(3s);
  store_.advance(Time{} + 2s);
  store_.elect();
  EXPECT_EQ(store_.term(), 2U);
  store_.advance(Time{} + 4s);
  const auto old = store_.execute_deposed(7, Renew{lease});
  ASSERT_TRUE(old);
  EXPECT_EQ(old->ttl, 3s);
  EXPECT_EQ(old->term, 1U);
  EXPECT_FALSE(store_.execute_deposed(8, Transaction{}));
  store_.advance(Time{} + 5s);
  EXPECT_EQ(run(Renew{lease}).outcome, Outcome::kNoLease);
}

TEST_F(ModelStoreTest, ReportsChangesFromTheAskedRevisionInOrder) {
  put("x/a", "1");
  put("y", "1");
  put("x/b", "1");
  run(Transaction{{}, {Erase{"x/a"}}, {}});
  EXPECT_EQ(run(Watch{"x/", 3}).outcome, Outcome::kDone);
  const auto changes = store_.take_changes(newest_);
  ASSERT_TRUE(changes);
  ASSERT_EQ(changes->changes.size(), 2U);
  EXPECT_EQ(changes->changes[0], (Change{{"x/b", "1", 4, 4, 0}, false}));
  EXPECT_EQ(changes->changes[1], (Change{{"x/a", "", 0, 5, 0}, true}));
  EXPECT_FALSE(store_.take_changes(newest_));
}

TEST_F(ModelStoreTest, RefusesWatchesOfCompactedRevisions) {
  for (int n = 0; n < 4; ++n) put("k", std::to_string(n));  // revisions 2 to 5
  const Reply watch = run(Watch{"", 2});
  EXPECT_EQ(run(Compact{9}).outcome, Outcome::kRefused);
  EXPECT_EQ(run(Compact{4}).outcome, Outcome::kDone);
  EXPECT_EQ(run(Compact{4}).outcome, Outcome::kCompacted);
  EXPECT_EQ(store_.take_changes(watch.operation)->outcome, Outcome::kCompacted);
  EXPECT_EQ(run(Watch{"", 3}).outcome, Outcome::kCompacted);
  EXPECT_EQ(run(Watch{"", 4}).outcome, Outcome::kDone);
  EXPECT_EQ(store_.take_changes(newest_)->changes.size(), 2U);
}

TEST_F(ModelStoreTest, AnswersADirectoryAtOnce) {
  ModelDirectory directory(store_);
  directory.begin(1, Watch{"k", 0});
  EXPECT_TRUE(directory.poll()->changes.empty());
  EXPECT_FALSE(directory.poll());
  directory.begin(2, Transaction{{}, {Put{"k", "1"}}, {}});
  EXPECT_EQ(directory.poll()->operation, 2U);
  EXPECT_EQ(directory.poll()->changes.size(), 1U);
}

}  // namespace
}  // namespace tandem::directory
