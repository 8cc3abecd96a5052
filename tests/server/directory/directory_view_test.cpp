#include "server/directory/directory_view.h"

#include <gtest/gtest.h>

#include <set>

#include "server/directory/model_store.h"

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;

TEST(DirectoryKeys, ReadsItsOwnNamesAndNoOthers) {
  const DirectoryKeys keys("/p/");
  EXPECT_EQ(keys.owner("s-1"), "/p/live/sessions/s-1/owner");
  EXPECT_EQ(keys.parse(keys.owner("s-1"))->name, "s-1");
  EXPECT_EQ(keys.parse(keys.standby("s-1"))->kind, DirectoryKeys::Parsed::Kind::kStandby);
  EXPECT_EQ(keys.parse(keys.server("a"))->kind, DirectoryKeys::Parsed::Kind::kServer);
  for (const char* foreign : {"", "/p/live/", "/p/live/servers/", "/p/live/sessions/s", "/p/live/sessions/s/owner/x",
                              "/p/live/sessions//owner", "/p/live/sessions/a b/owner", "/q/live/servers/a"})
    EXPECT_FALSE(keys.parse(foreign)) << foreign;
  EXPECT_FALSE(DirectoryKeys::valid_name(std::string(65, 'a')));
  EXPECT_FALSE(DirectoryKeys::valid_name("a/b"));
}

class DirectoryViewTest : public testing::Test {
 protected:
  void put(const std::string& key, const std::string& value) { run(Transaction{{}, {Put{key, value}}, {}}); }
  void erase(const std::string& key) { run(Transaction{{}, {Erase{key}}, {}}); }
  void run(const Request& request) {
    directory_.begin(1000 + operation_, request);
    settle();
  }
  void settle() {
    for (bool busy = true; busy;) {
      busy = false;
      if (auto request = view_.poll_request(now_, ++operation_, 1s)) {
        directory_.begin(operation_, *request);
        busy = true;
      }
      while (auto reply = directory_.poll()) {
        view_.on_reply(*reply);
        busy = true;
      }
    }
  }
  std::set<std::string> changed() {
    std::set<std::string> names;
    while (auto name = view_.poll_changed()) names.insert(*name);
    return names;
  }

  DirectoryKeys keys_;
  ModelStore store_;
  ModelDirectory directory_{store_};
  DirectoryView view_{keys_};
  Time now_{};
  OperationId operation_ = 0;
};

TEST_F(DirectoryViewTest, ReadsEverythingAndFollows) {
  put(keys_.owner("one"), "a");
  settle();
  EXPECT_TRUE(view_.follows());
  EXPECT_EQ(view_.session("one")->owner->name, "a");
  EXPECT_EQ(changed(), std::set<std::string>{"one"});
  put(keys_.server("a"), "text");
  put(keys_.standby("two"), "b");
  put("/tandem/v1/live/strange", "x");
  EXPECT_EQ(view_.server("a")->text, "text");
  EXPECT_FALSE(view_.session("two")->owner);
  EXPECT_EQ(view_.foreign_keys(), 1U);
  erase(keys_.owner("one"));
  erase(keys_.server("a"));
  EXPECT_EQ(view_.session("one"), nullptr);
  EXPECT_EQ(view_.server("a"), nullptr);
  EXPECT_EQ(changed(), (std::set<std::string>{"one", "two"}));
  EXPECT_EQ(view_.readings(), 1U);
  EXPECT_EQ(view_.revision(), store_.revision());
}

TEST_F(DirectoryViewTest, ReadsAgainWhenItsRevisionWasForgotten) {
  settle();
  put(keys_.owner("one"), "a");
  // The watch breaks; meanwhile keys change, and the store forgets how.
  Reply broken;
  for (broken.operation = 1; broken.operation < operation_; ++broken.operation) {
    broken.outcome = Outcome::kUnknown;
    if (view_.on_reply(broken)) break;
  }
  EXPECT_FALSE(view_.follows());
  erase(keys_.owner("one"));
  put(keys_.owner("two"), "b");
  EXPECT_EQ(view_.session("one"), nullptr);
  EXPECT_EQ(view_.session("two")->owner->name, "b");
  EXPECT_EQ(view_.readings(), 2U);
  EXPECT_EQ(changed(), (std::set<std::string>{"one", "two"}));
}

/// A store that permits no read refuses each at once.
TEST_F(DirectoryViewTest, PausesAfterAReadThatFailed) {
  int reads = 0;
  for (int n = 0; n < 100; ++n, now_ += 10ms) {
    if (!view_.poll_request(now_, ++operation_, 1s)) continue;
    ++reads;
    Reply refused;
    refused.operation = operation_;
    refused.outcome = Outcome::kRefused;
    EXPECT_TRUE(view_.on_reply(refused));
  }
  EXPECT_EQ(reads, 10);
  settle();
  EXPECT_TRUE(view_.follows());
}

// A watch at a revision that the store does not have yet would wait in silence.
TEST_F(DirectoryViewTest, ReadsAgainWhenTheStoreHasLostItsDataBeforeTheWatch) {
  for (int n = 0; n < 5; ++n)
    static_cast<void>(store_.execute(1, Transaction{{}, {Put{keys_.server("a"), std::to_string(n)}}, {}}));
  directory_.begin(5, *view_.poll_request(now_, 5, 1s));
  EXPECT_TRUE(view_.on_reply(*directory_.poll()));
  EXPECT_NE(view_.server("a"), nullptr);
  store_ = ModelStore{};
  directory_.begin(6, *view_.poll_request(now_, 6, 1s));
  EXPECT_TRUE(view_.on_reply(*directory_.poll()));
  EXPECT_FALSE(view_.follows());
  operation_ = 6;
  settle();
  EXPECT_TRUE(view_.follows());
  EXPECT_EQ(view_.server("a"), nullptr);
  EXPECT_EQ(view_.revision(), store_.revision());
}

}  // namespace
}  // namespace tandem::directory
