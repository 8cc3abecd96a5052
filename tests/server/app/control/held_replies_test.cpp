// When held replies are given, and as what. The test sets the store and the clock.
#include "server/app/control/held_replies.h"

#include <gtest/gtest.h>

#include <optional>

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

struct Holding {
  /// Holds a reply to order number `orders`, for a second.
  std::size_t hold(std::uint32_t orders) {
    given.emplace_back();
    replies.hold(stored, orders, 1s, [this, n = given.size() - 1](const std::string& why) { given[n] = why; });
    return given.size() - 1;
  }
  /// Has the replies looked at several times.
  void look() {
    const auto until = replies.size() == 0 ? 0ms : 5 * HeldReplies::kLook;
    context.restart();
    context.run_for(until);
  }
  asio::io_context context;
  Time now = Time{} + 1h;
  std::shared_ptr<StoredOrders> stored = std::make_shared<StoredOrders>();
  std::vector<std::optional<std::string>> given;
  HeldReplies replies{context, [this] { return now; }};
};

TEST(HeldReplies, WaitUntilTheirOrderIsStored) {
  Holding h;
  const std::size_t first = h.hold(1), second = h.hold(2);
  h.now += 999ms;
  h.look();
  EXPECT_FALSE(h.given[first]) << "nothing is stored";
  h.stored->set_stored(0);
  h.look();
  EXPECT_FALSE(h.given[first]) << "a snapshot of before the order does not count";
  h.stored->set_stored(1);
  h.look();
  EXPECT_EQ(h.given[first], "");
  EXPECT_FALSE(h.given[second]);
  h.stored->set_stored(7);
  h.look();
  EXPECT_EQ(h.given[second], "") << "a later snapshot has the order too";
  EXPECT_EQ(h.replies.size(), 0u);
  h.hold(7);
  EXPECT_EQ(h.given.back(), "") << "at once, because it is stored already";
}

TEST(HeldReplies, SayAfterTheLimitThatTheOrderIsNotStored) {
  Holding h;
  h.hold(1);
  h.now += 1s;
  h.look();
  ASSERT_TRUE(h.given[0]);
  EXPECT_NE(h.given[0]->find("not written in time; check the disk"), std::string::npos) << *h.given[0];
  h.stored->set_problem("the directory is silent; check etcd");
  h.hold(1);
  h.look();
  EXPECT_FALSE(h.given[1]) << "the directory may answer within the limit";
  h.now += 1s;
  h.look();
  EXPECT_EQ(h.given[1], "the directory is silent; check etcd");
}

TEST(HeldReplies, SayAtOnceThatTheWriteOfTheOrderHasFailed) {
  Holding h;
  h.stored->set_failed(3, "an older failure");
  h.hold(4);
  h.look();
  EXPECT_FALSE(h.given[0]) << "a failure of before the order says nothing about it";
  h.stored->set_failed(4, "the disk is full");
  h.look();
  EXPECT_EQ(h.given[0], "the disk is full");
  h.stored->set_stored(4);
  EXPECT_EQ(h.stored->problem(), "");
  h.hold(4);
  EXPECT_EQ(h.given[1], "");
}

TEST(HeldReplies, AreGivenWhenTheServerEndsOrTooManyWait) {
  Holding h;
  for (std::size_t n = 0; n < HeldReplies::kMax; ++n) h.hold(1);
  EXPECT_EQ(h.replies.size(), HeldReplies::kMax);
  h.hold(1);
  EXPECT_TRUE(h.given.back()) << "one more is given at once, as not stored";
  h.replies.give_all();
  EXPECT_EQ(h.replies.size(), 0u);
  for (const auto& given : h.given) EXPECT_TRUE(given && !given->empty());
  h.context.restart();
  EXPECT_EQ(h.context.run_for(1ms), 1u) << "the cancelled wait; the context runs out of work";
  EXPECT_TRUE(h.context.stopped());
}

}  // namespace
}  // namespace tandem::server
