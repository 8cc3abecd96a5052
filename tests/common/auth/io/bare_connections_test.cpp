#include <gtest/gtest.h>

#include "tests/common/auth/io/control_server_fixture.h"
#include "tests/common/auth/io/from_address.h"

/// Connections of enrolled workstations that have not joined, and the limits for all connections.
namespace tandem::server::test {
namespace {

using rpc::ErrorCode;

std::vector<auth::ControlClient> connections_of(ControlServerFixture& door, const auth::Identity& key, int count) {
  std::vector<auth::ControlClient> made;
  for (int i = 0; i < count; ++i) {
    auto client = door.connect(key);
    EXPECT_TRUE(client) << client.error().text;
    if (client) made.push_back(std::move(*client));
  }
  return made;
}
bool answers(auth::ControlClient& client) { return client.ask(rpc::Ping{1}, kTimeout).has_value(); }
long answering(std::vector<auth::ControlClient>& clients) { return std::ranges::count_if(clients, answers); }
std::optional<auth::ControlClient> joined(ControlServerFixture& door, const auth::Identity& key, unsigned ticket) {
  auto client = door.connect(key);
  if (!client) return std::nullopt;
  const auto welcome = client->ask(hello_with(door.ticket(key, ticket)), kTimeout);
  EXPECT_TRUE(welcome && std::holds_alternative<rpc::Welcome>(*welcome));
  return std::move(*client);
}

TEST(UnjoinedConnections, EndWhenIdleWhileJoinedOnesStay) {
  ControlLimits limits = ControlServerFixture::patient();
  EXPECT_EQ(ControlLimits{}.unjoined_idle, 10s);
  limits.unjoined_idle = 300ms;
  ControlServerFixture door(limits);
  const auto me = door.enrolled("me");
  auto seated = joined(door, me, 1);
  ASSERT_TRUE(seated);
  auto bare = connections_of(door, me, 1);
  (void)bare[0].ask(rpc::SessionListRequest{}, kTimeout);
  ASSERT_TRUE(door.told(ControlEvent::kIdle));
  EXPECT_FALSE(answers(bare[0]));
  EXPECT_TRUE(answers(*seated));
  EXPECT_EQ(door.plane->count(ControlEvent::kIdle), 1u);
  door.sessions->seat_is_held = false;  // taken by another connection, removed, or the session has ended
  ASSERT_TRUE(door.told(ControlEvent::kIdle, 2)) << "it has no more rights than one that never joined";
  EXPECT_FALSE(answers(*seated));
}

TEST(UnjoinedConnections, AreLimitedToFourPerKey) {
  ControlServerFixture door(ControlServerFixture::patient());
  EXPECT_EQ(ControlLimits{}.unjoined_per_key, 4u);
  const auto me = door.enrolled("me"), other = door.enrolled("other");
  auto seated = joined(door, me, 1);
  ASSERT_TRUE(seated);
  auto bystander = connections_of(door, other, 1);
  auto bare = connections_of(door, me, 12);
  ASSERT_TRUE(door.told(ControlEvent::kTooMany, 8));
  EXPECT_EQ(answering(bare), 4);
  EXPECT_TRUE(answers(*seated));
  EXPECT_TRUE(answers(bystander[0]));
  EXPECT_EQ(door.plane->count(ControlEvent::kTooMany), 8u);
}

TEST(UnjoinedConnections, AreLimitedToSixteenPerSource) {
  ControlServerFixture door(ControlServerFixture::patient());
  EXPECT_EQ(ControlLimits{}.unjoined_per_source, 16u);
  std::vector<auth::ControlClient> bare;
  for (int key = 0; key < 7; ++key)
    for (auto& client : connections_of(door, door.enrolled("desk-" + std::to_string(key)), 3))
      bare.push_back(std::move(client));
  ASSERT_TRUE(door.told(ControlEvent::kTooMany, 5));
  EXPECT_EQ(answering(bare), 16);
}

TEST(UnjoinedConnections, AreEvictedFirstAndJoinedOnesNever) {
  ControlLimits limits = ControlServerFixture::patient();
  limits.connections = 3;
  ControlServerFixture door(limits);
  const auto me = door.enrolled("me"), insider = door.enrolled("insider");
  auto first = joined(door, me, 1), second = joined(door, me, 2);
  auto bare = connections_of(door, insider, 10);
  ASSERT_TRUE(door.told(ControlEvent::kTooMany, 9)) << "one place is left";
  auto third = joined(door, me, 3);
  ASSERT_TRUE(first && second && third);
  EXPECT_TRUE(answers(*first));
  EXPECT_TRUE(answers(*second));
  EXPECT_TRUE(answers(*third));
  auto fourth = door.connect(me);
  ASSERT_TRUE(fourth) << "a place beyond them is kept for who comes back";
  const auto refused = fourth->ask(hello_with(door.ticket(me, 4)), kTimeout);
  EXPECT_EQ(reason_of(refused), ErrorCode::kFull);
  EXPECT_TRUE(door.told(ControlEvent::kRefused, 1)) << "the operator reads that places are short";
  EXPECT_NE(std::get<rpc::ErrorReply>(*refused).text.find("all 3 control connections"), std::string::npos);
  auto back = door.connect(me);
  ASSERT_TRUE(back);
  rpc::Hello resume = hello_with(door.ticket(me, 5));
  resume.credential = rpc::ResumeCredential{auth::test::secret_from<32>(9)};
  EXPECT_EQ(reason_of(back->ask(resume, kTimeout)), ErrorCode::kTicket)
      << "it is heard: whether its secret is right is the session's to say";
}

TEST(ReservedSlots, AreForAddressesOfJoinedSeats) {
  ControlLimits limits = ControlServerFixture::patient();
  limits.pending = 8;  // 32 may wait; 4 of these slots are reserved
  limits.accept = {1e4, 1e4, 1e4, 1e4};
  ControlServerFixture door(limits);
  auto seated = joined(door, door.enrolled("me"), 1);
  ASSERT_TRUE(seated);
  const std::uint64_t before = door.plane->count(ControlEvent::kAccepted);
  std::vector<io::Fd> strangers, own;
  for (int i = 0; i < 40; ++i) strangers.push_back(silent_from("127.20." + std::to_string(i) + ".1", door.address));
  ASSERT_TRUE(door.told(ControlEvent::kAccepted, before + 40));
  ASSERT_TRUE(door.told(ControlEvent::kEvicted, 12)) << "28 strangers at most";
  for (int i = 0; i < 4; ++i) own.push_back(silent_from("127.0.0.1", door.address));
  ASSERT_TRUE(door.told(ControlEvent::kAccepted, before + 44));
  EXPECT_EQ(door.plane->count(ControlEvent::kEvicted), 12u);
}

}  // namespace
}  // namespace tandem::server::test
