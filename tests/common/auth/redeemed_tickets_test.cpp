#include "common/auth/redeemed_tickets.h"

#include <gtest/gtest.h>

#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::kNow;

Ticket ticket(std::uint32_t number, std::int64_t not_after = kNow + 100) {
  Ticket t = test::sample_ticket();
  for (std::size_t i = 0; i < 4; ++i) t.ticket_id[i] = static_cast<std::byte>(number >> (8 * i) & 0xff);
  t.not_after = not_after;
  return t;
}

TEST(RedeemedTickets, AcceptEachTicketOnce) {
  RedeemedTickets book;
  EXPECT_TRUE(book.redeem(ticket(1), kNow));
  EXPECT_TRUE(book.redeem(ticket(2), kNow));
  const auto again = book.redeem(ticket(1), kNow);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().rule, TicketCheck::kUsed);
  EXPECT_EQ(book.size(), 2u);
}

TEST(RedeemedTickets, AcceptAReleasedTicketAgainAlsoAfterARestart) {
  RedeemedTickets book;
  ASSERT_TRUE(book.redeem(ticket(1), kNow));
  book.forget(ticket(1).ticket_id);
  EXPECT_TRUE(book.redeem(ticket(1), kNow));
  const std::string used = RedeemedTickets::line(ticket(2).ticket_id, kNow + 100),
                    back = RedeemedTickets::line(ticket(2).ticket_id, 0);
  auto read = RedeemedTickets::parse(used + back);
  ASSERT_TRUE(read) << read.error();
  read->prune(kNow);  // as a server does before it serves
  EXPECT_TRUE(read->redeem(ticket(2), kNow));
  auto again = RedeemedTickets::parse(used + back + used);
  ASSERT_TRUE(again);
  again->prune(kNow);
  EXPECT_FALSE(again->redeem(ticket(2), kNow)) << "and used after that";
}

TEST(RedeemedTickets, AreRemovedOnlyAfterTheyExpire) {
  RedeemedTickets book;
  ASSERT_TRUE(book.redeem(ticket(1, kNow + 10), kNow));
  EXPECT_EQ(book.prune(kNow + 10), 0u);  // still valid in this very second
  EXPECT_EQ(book.prune(kNow + 11), 1u);
}

TEST(RedeemedTickets, RejectNewTicketsWhenFullRatherThanForget) {
  RedeemedTickets book;
  for (std::uint32_t i = 0; i < RedeemedTickets::kMax; ++i)
    ASSERT_TRUE(book.redeem(ticket(i, kNow + (i == 7 ? 5 : 100)), kNow));
  const auto more = book.redeem(ticket(1u << 20), kNow);
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().rule, TicketCheck::kBookFull);
  EXPECT_TRUE(book.redeem(ticket(1u << 20), kNow + 6)) << "number 7 has expired and makes room";
  EXPECT_EQ(book.size(), RedeemedTickets::kMax);
}

TEST(RedeemedTickets, SurviveAFileRoundTrip) {
  RedeemedTickets book;
  ASSERT_TRUE(book.redeem(ticket(1), kNow));
  ASSERT_TRUE(book.redeem(ticket(2), kNow));
  const std::string text = book.to_text();
  const auto read = RedeemedTickets::parse(text);
  ASSERT_TRUE(read) << read.error();
  EXPECT_TRUE(read->contains(ticket(1).ticket_id));
  EXPECT_TRUE(read->contains(ticket(2).ticket_id));
  EXPECT_EQ(read->to_text(), text);
  EXPECT_EQ(text, RedeemedTickets::line(ticket(1).ticket_id, kNow + 100) +
                      RedeemedTickets::line(ticket(2).ticket_id, kNow + 100));
}

TEST(RedeemedTickets, SkipALineCutByACrashAndRejectOtherErrors) {
  const std::string one = RedeemedTickets::line(ticket(1).ticket_id, kNow);
  for (std::size_t cut = 0; cut < one.size(); ++cut) {
    const auto read = RedeemedTickets::parse(one + RedeemedTickets::line(ticket(2).ticket_id, kNow).substr(0, cut));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->size(), 1u);
  }
  for (const std::string& bad : {std::string("\n"), std::string("00\n"), "zz" + one.substr(2),
                                 one.substr(0, 40) + " \n", one.substr(0, 33) + "-1\n"}) {
    const auto read = RedeemedTickets::parse(one + bad + one);
    ASSERT_FALSE(read) << bad;
    EXPECT_EQ(read.error().substr(0, 7), "line 2:");
  }
}

}  // namespace
}  // namespace tandem::auth
