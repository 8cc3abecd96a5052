// Joins with tickets in a service: a Welcome waits for the use of its ticket.
#include "server/app/control/ticket_uses.h"

#include <gtest/gtest.h>

#include <optional>

#include "common/auth/io/state_directory.h"
#include "proto/rpc/ticket_codec.h"

namespace tandem::server {
namespace {

class ScriptedUses final : public TicketUses {
 public:
  void use(const std::string& of, const auth::Id16& id, std::int64_t life_s, bool used_again,
           std::function<void(Outcome)> done) override {
    session = of, ticket = id, life = life_s, again = used_again, answer = std::move(done);
  }
  void restore(const std::string&, const auth::Id16&) override {}
  std::string session;
  auth::Id16 ticket{};
  std::int64_t life = 0;
  bool again = false;
  std::function<void(Outcome)> answer;
};

class UsedOnce : public testing::Test {
 protected:
  /// A request with a ticket that is valid for 100 s.
  JoinRequest request() const {
    rpc::TicketContent content;
    content.ticket_id = {std::byte{5}};
    content.not_before = auth::wall_seconds() - 1;
    content.not_after = auth::wall_seconds() + 100;
    rpc::SignedTicket sealed;
    sealed.content = rpc::encode(content);
    JoinRequest join;
    join.hello.credential = rpc::TicketCredential{rpc::encode(sealed)};
    return join;
  }
  std::function<void(JoinReply)> wrapped(TicketUses* by, const JoinRequest& join) {
    return used_once(
        by, join, [this](JoinReply r) { reply = std::move(r); }, [this](const rpc::Welcome& w) { failed = w.seat; },
        [](const rpc::Welcome& w) { return w.seat.empty(); });
  }
  static rpc::Welcome welcome() {
    rpc::Welcome w;
    w.session_name = "lab";
    w.seat = "left";
    return w;
  }
  ScriptedUses uses;
  std::optional<JoinReply> reply;
  std::optional<std::string> failed;
};

TEST_F(UsedOnce, WelcomeWaitsForTheUseOfItsTicket) {
  wrapped(&uses, request())(welcome());
  EXPECT_FALSE(reply);
  EXPECT_EQ(uses.session, "lab");
  EXPECT_EQ(uses.ticket[0], std::byte{5});
  EXPECT_FALSE(uses.again);
  EXPECT_GE(uses.life, 98);
  EXPECT_LE(uses.life, 100);
  uses.answer(TicketUses::Outcome::kAccepted);
  ASSERT_TRUE(reply);
  EXPECT_EQ(std::get<rpc::Welcome>(*reply).seat, "left");
  EXPECT_FALSE(failed);
}

TEST_F(UsedOnce, UsedTicketFreesTheSeatAndIsRefused) {
  for (const auto& [outcome, code] : {std::pair{TicketUses::Outcome::kUsed, rpc::ErrorCode::kTicket},
                                      std::pair{TicketUses::Outcome::kNoAnswer, rpc::ErrorCode::kNotNow}}) {
    reply.reset(), failed.reset();
    wrapped(&uses, request())(welcome());
    uses.answer(outcome);
    EXPECT_EQ(failed, "left");
    ASSERT_TRUE(reply);
    EXPECT_EQ(std::get<rpc::ErrorReply>(*reply).code, code);
  }
}

TEST_F(UsedOnce, ConsoleThatReturnsTakesThePlaceOfItsFormerUse) {
  rpc::Welcome console = welcome();
  console.seat.clear();
  wrapped(&uses, request())(console);
  EXPECT_TRUE(uses.again);
}

TEST_F(UsedOnce, OtherRepliesAndCredentialsPassAtOnce) {
  wrapped(&uses, request())(rpc::ErrorReply{rpc::ErrorCode::kNoSeat, "", 0});
  EXPECT_TRUE(std::holds_alternative<rpc::ErrorReply>(*reply));
  JoinRequest resume;
  resume.hello.credential = rpc::ResumeCredential{};
  wrapped(&uses, resume)(welcome());
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*reply));
  reply.reset();
  wrapped(nullptr, request())(welcome());
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*reply));
  EXPECT_FALSE(uses.answer);
}

}  // namespace
}  // namespace tandem::server
