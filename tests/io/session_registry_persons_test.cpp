// Persons named in tickets, on control connections of a real server over TLS.
#include "tests/io/live_server.h"

namespace tandem::server::test {
namespace {

const rpc::Id kId = LiveServer::kId;

/// Polls until the condition holds; fails the test at the time limit instead of hanging it.
bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kTimeout; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(20ms);
  }
  return false;
}

TEST(Persons, AreNamedFromTheTicketToTheAuditLogStatusAndStop) {
  LiveServer live_server;
  JoinedClient ann = joined(live_server, "desk", AccessRole::kInstructor, "trainer", "ann");
  ASSERT_TRUE(ann.welcomed()) << text_of(ann.welcome);
  EXPECT_EQ(ann.in().person, "ann");
  JoinedClient office = joined(live_server, "office", AccessRole::kOperator, "", "otto");
  EXPECT_TRUE(comes_true([&] { return status_of(office).seats[0].taken; }));
  rpc::Status status = status_of(office);
  EXPECT_EQ(status.seats[0].person, "ann");
  EXPECT_EQ(status.seats[1].person, "") << "free";
  EXPECT_TRUE(done(ann.ask(rpc::StopSession{kId, "fire drill"})));
  status = status_of(office);
  ASSERT_TRUE(status.stop);
  EXPECT_EQ(status.stop->seat, "trainer");
  EXPECT_EQ(status.stop->person, "ann");
  EXPECT_TRUE(done(office.ask(rpc::ResumeSession{kId, 1})));
  EXPECT_EQ(status_of(ann).events.back().text.find("stop 1 is over: RESUMED by otto at office (operator)"), 0U);
  EXPECT_TRUE(done(office.ask(rpc::StopSession{kId, ""})));
  EXPECT_EQ(status_of(ann).stop->person, "otto");
  EXPECT_EQ(status_of(ann).stop->workstation, "office");
  const std::string audit = live_server.audit();
  for (const char* line :
       {"\"event\":\"stop\",\"name\":\"lesson\",\"detail\":\"ann at desk (instructor, seat trainer) stop 1 tick 0: "
        "fire drill\"",
        "\"event\":\"resume\",\"name\":\"lesson\",\"detail\":\"otto at office (operator) stop 1 tick 0\""})
    EXPECT_NE(audit.find(line), std::string::npos) << line << "\n" << audit;
}

TEST(Persons, KeepTheirNameInAResumeAndLoseItWithTheSeat) {
  LiveServer live_server;
  JoinedClient ann = joined(live_server, "desk", AccessRole::kInstructor, "trainer", "ann");
  ASSERT_TRUE(ann.welcomed()) << text_of(ann.welcome);
  auto again = live_server.connect(ann.key);
  const auto resumed = again.ask(LiveServer::hello(rpc::ResumeCredential{ann.in().resume_secret}, "trainer"), kTimeout);
  ASSERT_TRUE(resumed && std::holds_alternative<rpc::Welcome>(*resumed)) << text_of(resumed);
  EXPECT_EQ(std::get<rpc::Welcome>(*resumed).person, "ann");
  JoinedClient office = joined(live_server, "office", AccessRole::kOperator);
  EXPECT_TRUE(comes_true([&] { return status_of(office).seats[0].person == "ann"; }));
  EXPECT_TRUE(done(office.ask(rpc::RemoveParticipant{kId, "trainer", ""})));
  EXPECT_TRUE(comes_true([&] { return !status_of(office).seats[0].taken; }));
  EXPECT_EQ(status_of(office).seats[0].person, "");
  EXPECT_TRUE(comes_true([&] {
    JoinedClient next = joined(live_server, "next" + std::to_string(live_server.count(ControlEvent::kWelcomed)),
                               AccessRole::kInstructor, "trainer");
    return next.welcomed() && next.in().person.empty();
  })) << "a ticket without a name";
}

}  // namespace
}  // namespace tandem::server::test
