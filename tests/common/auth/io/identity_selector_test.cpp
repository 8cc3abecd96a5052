#include "common/auth/io/identity_selector.h"

#include <gtest/gtest.h>

#include "tests/common/auth/io/temporary_folder.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::Folder;
using test::kNow;

TEST(IdentitySelector, MatchesServerKeysThenTheRuntimeDirectory) {
  const Folder folder;
  ServerKeystore server = ServerKeystore::ephemeral(kNow);
  const KeyFingerprint fingerprint = server.identity().fingerprint();
  const auto choose = [&](const KeyFingerprint& seen) {
    auto own = ClientKeystore::open(folder.path("c"));
    EXPECT_TRUE(own);
    auto choice = std::make_unique<IdentitySelector>("h:1", std::move(*own), folder.path("run"));
    const auto got = (*choice)(PresentedKey(seen));
    return std::tuple{got.has_value() ? (*got)->fingerprint() : KeyFingerprint{}, choice->local() != nullptr,
                      got.has_value() ? std::string() : got.error()};
  };
  EXPECT_NE(std::get<2>(choose(fingerprint)).find("does not know the server"), std::string::npos);
  const auto client = ClientKeystore::open_or_make(folder.path("c"), kNow);
  ASSERT_TRUE(client);
  ASSERT_EQ(client->store_server({"h:1", test::counting<32>(3), "me"}), "");
  EXPECT_NE(std::get<2>(choose(fingerprint)).find("another key"), std::string::npos);
  {
    const auto local = publish_local_keys(server, folder.path("run"), kNow);
    ASSERT_TRUE(local) << local.error();
    const auto [shown, is_local, error] = choose(fingerprint);
    EXPECT_EQ(error, "");
    EXPECT_TRUE(is_local);
    EXPECT_EQ(server.registry().find(shown)->value().name, "local") << "the server knows the key that is shown";
  }
  EXPECT_NE(std::get<2>(choose(fingerprint)), "") << "gone with the server";
  ASSERT_EQ(client->store_server({"elsewhere:2", fingerprint.sha256, "me"}), "");
  const auto [shown, is_local, error] = choose(fingerprint);
  EXPECT_EQ(shown, client->identity().fingerprint()) << error;
  EXPECT_FALSE(is_local);
}

TEST(ServerKeystore, CreatesDistinctEphemeralKeysThatRedeemTickets) {
  ServerKeystore a = ServerKeystore::ephemeral(kNow), b = ServerKeystore::ephemeral(kNow);
  EXPECT_NE(a.identity().fingerprint(), b.identity().fingerprint());
  EXPECT_NE(a.ticket_key().verifier().key, b.ticket_key().verifier().key);
  EXPECT_FALSE(a.on_disk());
  ASSERT_EQ(a.begin_serving(kNow), "");
  const Ticket ticket = test::sample_ticket();
  const auto bytes = sign_ticket(ticket, a.ticket_key());
  EXPECT_TRUE(a.tickets().redeem(*bytes, test::sample_use(ticket)));
  EXPECT_FALSE(a.tickets().redeem(*bytes, test::sample_use(ticket)));
  EXPECT_EQ(b.tickets().redeem(*bytes, test::sample_use(ticket)).error().fault->rule, TicketCheck::kKey);
}

}  // namespace
}  // namespace tandem::auth
