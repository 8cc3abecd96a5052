// Tickets that are redeemed once, in memory and on disk.
#include "common/auth/io/ticket_redeemer.h"

#include <gtest/gtest.h>

#include "tests/common/auth/io/temporary_folder.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::Folder;
using test::kNow;

struct Signed {
  TicketKey key{test::secret_from<32>(1)};
  Ticket ticket = test::sample_ticket();
  TicketBytes bytes = *sign_ticket(ticket, key);
  [[nodiscard]] TicketUse use() const { return test::sample_use(ticket); }
};

TEST(TicketRedeemer, RedeemsOnceInMemoryUntilTheTicketIsRestored) {
  const Signed s;
  TicketRedeemer tickets(s.key.verifier(), nullptr);
  ASSERT_TRUE(tickets.redeem(s.bytes, s.use()));
  EXPECT_EQ(tickets.redeem(s.bytes, s.use()).error().fault->rule, TicketCheck::kUsed);
  EXPECT_EQ(tickets.restore(s.ticket.ticket_id), "");
  EXPECT_TRUE(tickets.redeem(s.bytes, s.use()));
}

TEST(TicketRedeemer, RejectsATicketOfAnotherKey) {
  const Signed s;
  TicketRedeemer tickets(TicketKey(test::secret_from<32>(2)).verifier(), nullptr);
  EXPECT_EQ(tickets.redeem(s.bytes, s.use()).error().fault->rule, TicketCheck::kKey);
}

TEST(TicketRedeemer, RestoresATicketAlsoOnDisk) {
  const Folder folder;
  const auto directory =
      std::make_shared<const StateDirectory>(*StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError));
  const Signed s;
  {
    TicketRedeemer tickets(s.key.verifier(), directory);
    EXPECT_FALSE(tickets.redeem(s.bytes, s.use()).error().fault) << "the list has not been read";
    ASSERT_EQ(tickets.begin(kNow), "");
    ASSERT_TRUE(tickets.redeem(s.bytes, s.use()));
    ASSERT_EQ(tickets.restore(s.ticket.ticket_id), "");
  }
  TicketRedeemer tickets(s.key.verifier(), directory);
  ASSERT_EQ(tickets.begin(kNow), "");
  EXPECT_TRUE(tickets.redeem(s.bytes, s.use()));
}

TEST(TicketRedeemer, NamesTheWrongLineAndTheRemedy) {
  const Folder folder;
  folder.write(TicketRedeemer::kFile, "nonsense\n");
  const auto directory = StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError);
  const auto used = TicketRedeemer::read(*directory);
  ASSERT_FALSE(used);
  EXPECT_NE(used.error().find("used_tickets: line 1: "), std::string::npos) << used.error();
  EXPECT_NE(used.error().find("; delete that line (its ticket is then valid again)"), std::string::npos)
      << used.error();
}

}  // namespace
}  // namespace tandem::auth
