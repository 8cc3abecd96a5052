#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <utility>

#include "common/base/rng.h"
#include "server/directory/directory_keys.h"
#include "server/directory/model_store.h"
#include "tests/common/base/counts.h"
#include "tests/io/etcd_process.h"

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;
using tandem::test::wait_for_reply;

/// The same requests to the model and to etcd of Debian; the answers must be the same. Leases have other ids in etcd: a
/// request names a lease by its number, and answers are compared by it.
class EtcdConformance : public testing::Test {
 protected:
  void SetUp() override {
    if (tandem::test::etcd_program("etcd").empty()) GTEST_SKIP() << tandem::test::kNoEtcd;
    etcd_ = std::make_unique<tandem::test::Etcd>();
    EtcdOptions options;
    options.endpoints = {etcd_->endpoint()};
    options.answer_limit = 10s;
    directory_ = std::make_unique<EtcdDirectory>(options);
    operation_ = etcd_->wait_until_ready(*directory_);
  }

  /// Sends a request to both and compares the answers. Returns the model's.
  Reply both(const Request& request) {
    const OperationId operation = operation_++;
    const Reply model = store_.execute(operation, request);
    directory_->begin(operation, translated(request));
    const Reply real = wait_for_reply(*directory_, operation, &others_);
    if (model.lease != 0) {
      to_etcd_[model.lease] = real.lease;
      to_model_[real.lease] = model.lease;
    }
    EXPECT_STREQ(to_text(real.outcome), to_text(model.outcome)) << real.reason;
    if (model.outcome != Outcome::kDone) return model;
    EXPECT_EQ(real.revision, model.revision);
    EXPECT_EQ(real.ttl, model.ttl);
    EXPECT_EQ(real.held, model.held);
    EXPECT_EQ(leases_of_model(real.found), model.found);
    EXPECT_GT(real.term, 0U);
    return model;
  }
  Reply put(const std::string& key, const std::string& value, LeaseId lease = 0) {
    return both(Transaction{{}, {Put{key, value, lease}}, {}});
  }
  Reply read_all() { return both(Transaction{{}, {Read{"", true}}, {}}); }

  /// Collects the changes of a watch in etcd, as many as the model has, and compares them.
  void compare_changes(OperationId watch) {
    std::vector<Change> model, real;
    while (auto reply = store_.take_changes(watch))
      model.insert(model.end(), reply->changes.begin(), reply->changes.end());
    const auto take = [&](const Reply& reply) {
      if (reply.operation == watch) real.insert(real.end(), reply.changes.begin(), reply.changes.end());
    };
    for (const Reply& reply : std::exchange(others_, {})) take(reply);
    const auto end = std::chrono::steady_clock::now() + tandem::test::Process::kTimeout;
    while (real.size() < model.size() && std::chrono::steady_clock::now() < end)
      if (auto reply = directory_->poll()) take(*reply);
    for (Change& change : real)
      if (change.entry.lease != 0) change.entry.lease = to_model_[change.entry.lease];
    EXPECT_EQ(real.size(), model.size());
    EXPECT_TRUE(real == model);
  }

  Request translated(Request request) {
    const auto lease = [this](LeaseId model) { return to_etcd_.contains(model) ? to_etcd_[model] : model; };
    if (auto* renew = std::get_if<Renew>(&request)) renew->lease = lease(renew->lease);
    if (auto* remaining = std::get_if<Remaining>(&request)) remaining->lease = lease(remaining->lease);
    if (auto* revoke = std::get_if<Revoke>(&request)) revoke->lease = lease(revoke->lease);
    if (auto* transaction = std::get_if<Transaction>(&request)) {
      for (Condition& condition : transaction->conditions)
        if (condition.of == Condition::Of::kLease) condition.equals = lease(condition.equals);
      for (auto* branch : {&transaction->then, &transaction->otherwise})
        for (Step& step : *branch)
          if (auto* one = std::get_if<Put>(&step)) one->lease = lease(one->lease);
    }
    return request;
  }
  std::vector<std::vector<KeyValue>> leases_of_model(std::vector<std::vector<KeyValue>> found) {
    for (auto& entries : found)
      for (KeyValue& entry : entries)
        if (entry.lease != 0) entry.lease = to_model_[entry.lease];
    return found;
  }

  std::unique_ptr<tandem::test::Etcd> etcd_;
  std::unique_ptr<EtcdDirectory> directory_;
  ModelStore store_;
  OperationId operation_ = 1;
  std::map<LeaseId, LeaseId> to_etcd_, to_model_;
  std::vector<Reply> others_;
};

TEST_F(EtcdConformance, AnswersRandomRequestsAsTheModel) {
  RandomStream d(18);
  const char* const keys[] = {"a", "b", "c", "d/1", "d/2"};
  std::vector<LeaseId> leases{0, 0, 12345};
  const auto key = [&] { return std::string(keys[d.below(5)]); };
  const auto lease = [&] { return leases[d.below(leases.size())]; };
  const auto step = [&]() -> Step {
    const std::uint64_t kind = d.below(10);
    if (kind < 4) return Put{key(), std::to_string(d.below(100)), lease()};
    if (kind < 6) return Erase{key()};
    if (kind < 8) return Read{key()};
    return Read{d.below(2) == 0 ? "d/" : "", true};
  };
  const Reply watch = both(Watch{"d/", 1});
  const std::size_t count = tandem::test::draws(1000, 3000, 10'000);
  std::size_t held = 0, refused = 0;
  for (std::size_t n = 0; n < count && !HasFailure(); ++n) {
    const std::uint64_t kind = d.below(20);
    Reply reply;
    if (kind == 0) {
      reply = both(Grant{std::chrono::seconds(1000 + d.below(1000))});
      leases.push_back(reply.lease);
    } else if (kind == 1) {
      reply = both(Renew{lease()});
    } else if (kind == 2) {
      reply = both(Revoke{lease()});
    } else {
      Transaction transaction;
      for (std::uint64_t c = d.below(3); c > 0; --c) {
        const auto of = static_cast<Condition::Of>(d.below(3));
        const std::string of_key = key();
        const auto entry = store_.entries().find(of_key);
        const KeyValue now = entry == store_.entries().end() ? KeyValue{} : entry->second;
        const std::int64_t true_number = of == Condition::Of::kCreated    ? now.created
                                         : of == Condition::Of::kModified ? now.modified
                                                                          : now.lease;
        transaction.conditions.push_back({of_key, of, d.below(3) == 0 ? 0 : true_number});
      }
      for (std::uint64_t s = d.below(4); s > 0; --s) transaction.then.push_back(step());
      for (std::uint64_t s = d.below(4); s > 0; --s) transaction.otherwise.push_back(step());
      reply = both(transaction);
    }
    held += reply.held ? 1 : 0;
    refused += reply.outcome != Outcome::kDone ? 1 : 0;
  }
  read_all();
  compare_changes(watch.operation);
  std::printf(
      "[  etcd    ] %zu requests, the same answers: %zu transactions held, %zu requests refused, revision %lld\n",
      count, held, refused, static_cast<long long>(store_.revision()));
  EXPECT_GT(held, count / 10);
  EXPECT_GT(refused, count / 20);
}

TEST_F(EtcdConformance, EndsLeasesAsTheModelAndNeverBeforeTheirTime) {
  const auto sent = std::chrono::steady_clock::now();
  const LeaseId lease = both(Grant{1s}).lease;  // both give 2 s
  put("one", "1", lease);
  put("two", "2", lease);
  put("stays", "3");
  const Reply watch = both(Watch{"", store_.revision() + 1});
  for (bool there = true; there;) {
    directory_->begin(operation_, Transaction{{}, {Read{"one"}}, {}});
    there = !wait_for_reply(*directory_, operation_++, &others_).found.at(0).empty();
  }
  EXPECT_GE(std::chrono::steady_clock::now() - sent, 2s);
  store_.advance(Time{} + 2s);
  EXPECT_EQ(read_all().found.at(0).size(), 1U);
  both(Renew{lease});
  compare_changes(watch.operation);
}

TEST_F(EtcdConformance, TellsTheRestOfALeaseAsTheModel) {
  const LeaseId lease = both(Grant{100s}).lease;
  const auto rest_of = [&](LeaseId asked) {
    directory_->begin(operation_, translated(Remaining{asked}));
    return wait_for_reply(*directory_, operation_++, &others_);
  };
  const Reply rest = rest_of(lease);
  EXPECT_EQ(rest.outcome, Outcome::kDone);
  EXPECT_GT(rest.ttl, 0s);
  EXPECT_LE(rest.ttl, store_.execute(1, Remaining{lease}).ttl);
  both(Revoke{lease});
  EXPECT_EQ(rest_of(lease).outcome, Outcome::kNoLease);
  EXPECT_EQ(rest_of(lease).ttl, store_.execute(1, Remaining{lease}).ttl);
}

TEST_F(EtcdConformance, ForgetsCompactedRevisionsAsTheModel) {
  for (int n = 0; n < 6; ++n) put("k", std::to_string(n));  // revisions 2 to 7
  both(Compact{100});
  both(Compact{5});
  both(Compact{5});
  both(Compact{4});
  both(Compact{0});
  const Reply from_there = both(Watch{"k", 6});
  compare_changes(from_there.operation);
  // etcd accepts a watch of a forgotten revision and then ends it.
  EXPECT_EQ(store_.execute(operation_, Watch{"k", 3}).outcome, Outcome::kCompacted);
  directory_->begin(operation_, Watch{"k", 3});
  Reply real = wait_for_reply(*directory_, operation_);
  if (real.outcome == Outcome::kDone) real = wait_for_reply(*directory_, operation_);
  EXPECT_STREQ(to_text(real.outcome), "the revision has been compacted");
}

TEST_F(EtcdConformance, IsReadByEtcdctl) {
  const DirectoryKeys keys;
  const LeaseId lease = both(Grant{100s}).lease;
  both(Transaction{{{keys.owner("s"), Condition::Of::kCreated, 0}}, {Put{keys.owner("s"), "server-1", lease}}, {}});
  put(keys.ticket("t"), std::string("zero\0and \xff", 10));
  if (tandem::test::etcd_program("etcdctl").empty()) GTEST_SKIP() << tandem::test::kNoEtcd;
  EXPECT_EQ(etcd_->etcdctl({"get", "--prefix", "/tandem/v1/live/"}), "/tandem/v1/live/sessions/s/owner\nserver-1\n");
  const auto json = nlohmann::json::parse(etcd_->etcdctl({"get", keys.owner("s"), "--write-out", "json"}));
  EXPECT_EQ(json["kvs"][0]["lease"].get<std::int64_t>(), to_etcd_[lease]);
  EXPECT_EQ(json["kvs"][0]["create_revision"].get<std::int64_t>(), 2);
  // And we read what etcdctl wrote.
  (void)etcd_->etcdctl({"put", "/tandem/v1/live/servers/x", "text"});
  directory_->begin(operation_, Transaction{{}, {Read{"/tandem/v1/live/servers/x"}}, {}});
  EXPECT_EQ(wait_for_reply(*directory_, operation_).found.at(0).at(0).value, "text");
}

}  // namespace
}  // namespace tandem::directory
