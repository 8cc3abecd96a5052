#include "common/trust/io/key_choice.h"

#include <gtest/gtest.h>

#include "tests/trust/io/folder.h"
#include "tests/trust/support.h"

namespace tandem::trust {
namespace {

using test::Folder;
using test::kNow;

TEST(KeyChoice, KnowsServersByTheirKeysThenLooksIntoTheRuntimeFolder) {
  const Folder folder;
  ServerTrust server = ServerTrust::throw_away(kNow);
  const Pin pin = server.identity().pin();
  const auto choose = [&](const Pin& seen) {
    auto own = ClientTrust::open(folder.path("c"));
    EXPECT_TRUE(own);
    auto choice = std::make_unique<KeyChoice>("h:1", std::move(*own), folder.path("run"));
    const auto got = (*choice)(seen);
    return std::tuple{got.has_value() ? (*got)->pin() : Pin{}, choice->local() != nullptr, got.has_value() ? std::string() : got.error()};
  };
  EXPECT_NE(std::get<2>(choose(pin)).find("does not know the server"), std::string::npos);
  const auto client = ClientTrust::open_or_make(folder.path("c"), kNow);
  ASSERT_TRUE(client);
  ASSERT_EQ(client->remember({"h:1", test::counting<32>(3), "me"}), "");
  EXPECT_NE(std::get<2>(choose(pin)).find("another key"), std::string::npos);
  {
    const auto local = let_local_in(server, folder.path("run"), kNow);
    ASSERT_TRUE(local) << local.error();
    const auto [shown, is_local, error] = choose(pin);
    EXPECT_EQ(error, "");
    EXPECT_TRUE(is_local);
    EXPECT_EQ(server.find(shown)->value().name, "local") << "the server knows the key that is shown";
  }
  EXPECT_NE(std::get<2>(choose(pin)), "") << "gone with the server";
  ASSERT_EQ(client->remember({"elsewhere:2", pin.sha256, "me"}), "");
  const auto [shown, is_local, error] = choose(pin);
  EXPECT_EQ(shown, client->identity().pin()) << error;
  EXPECT_FALSE(is_local);
}

TEST(ServerTrust, ThrownAwayKeysDifferEachTimeAndRedeemTickets) {
  ServerTrust a = ServerTrust::throw_away(kNow), b = ServerTrust::throw_away(kNow);
  EXPECT_NE(a.identity().pin(), b.identity().pin());
  EXPECT_NE(a.ticket_key().verifier().key, b.ticket_key().verifier().key);
  EXPECT_FALSE(a.on_disk());
  ASSERT_EQ(a.begin_serving(kNow), "");
  const Ticket ticket = test::sample_ticket();
  const auto bytes = sign_ticket(ticket, a.ticket_key());
  EXPECT_TRUE(a.redeem(*bytes, test::sample_use(ticket)));
  EXPECT_FALSE(a.redeem(*bytes, test::sample_use(ticket)));
  EXPECT_EQ(b.redeem(*bytes, test::sample_use(ticket)).error().fault->rule, TicketRule::kKey);
}

}  // namespace
}  // namespace tandem::trust
