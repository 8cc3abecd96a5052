#include "server/service/service_member.h"

#include "tests/server/service/service_fixture.h"

namespace tandem::server::test {
namespace {

using Kind = ServiceEvent::Kind;
using Place = SessionPlace::Kind;

TEST_F(ServiceTest, FirstServerBeginsTheConfiguredSessionsAndTheNextOneFindsThem) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  ASSERT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.open["lab"].spec, session_spec(1));
  EXPECT_EQ(a.open["lab"].snapshot, "");
  EXPECT_EQ(a.open["lab"].revision, store_.entries().at("/tandem/v1/live/sessions/lab/owner").created);
  Server& b = start("b", {{"lab", session_spec(2)}});
  EXPECT_TRUE(b.open.empty());
  EXPECT_EQ(parse_service_session(value("catalogue/lab/spec")), session_spec(1));
  EXPECT_EQ(b.member.locate(named("lab")).kind, Place::kElsewhere);
  EXPECT_EQ(b.member.locate(named("CODE000001")).record->address, "a:7000");
  EXPECT_EQ(b.member.locate(rpc::SessionChoice{session_spec(1).id}).revision, a.open["lab"].revision);
  EXPECT_EQ(a.member.locate({}).kind, Place::kHere);
  EXPECT_EQ(b.member.locate(named("other")).kind, Place::kNone);
}

TEST_F(ServiceTest, OneOfServersThatStartTogetherBeginsASession) {
  for (const char* name : {"a", "b", "c"}) {
    servers_.push_back(std::make_unique<Server>(
        store_, ServiceMemberOptions{.server = name, .configured = {{"lab", session_spec(name[0] - 'a')}}}));
    servers_.back()->member.describe({.address = "x:1", .key = "k", .version = "1", .zone = "", .capacity = 1});
  }
  pass(6s);
  const auto open = std::ranges::count_if(servers_, [](const auto& s) { return s->open.contains("lab"); });
  EXPECT_EQ(open, 1);
}

// The first one dies between its claim and the write of the spec. The next one must not take the session for ended.
TEST_F(ServiceTest, ConfiguredSessionThatItsFirstServerNeverBeganIsBegunByTheNextOne) {
  const auto owner = store_.execute(2, directory::Grant{3s});
  static_cast<void>(store_.execute(
      3, directory::Transaction{{}, {directory::Put{"/tandem/v1/live/sessions/lab/owner", "x", owner.lease}}, {}}));
  Server& a = start("a", {{"lab", session_spec(1)}});
  EXPECT_FALSE(a.open.contains("lab"));
  pass(4s);
  EXPECT_TRUE(a.open.contains("lab"));
  Server& b = start("b", {{"lab", session_spec(1)}});
  a.member.sessions().end("lab");
  pass(3s);
  EXPECT_FALSE(has("catalogue/lab/spec") || b.open.contains("lab"));  // an ended one stays so
}

TEST_F(ServiceTest, RestoresASessionFromItsNewestSnapshotWhenItsServerDies) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  a.member.sessions().set_snapshot("lab", "state 1");
  a.member.sessions().set_snapshot("lab", "state 2");
  pass(3s);
  EXPECT_EQ(value("snapshots/lab"), "state 2");
  EXPECT_EQ(value("live/sessions/lab/standby"), "b");
  const Time died = now_;
  a.runs = false;
  a.open.clear();
  while (!b.open.contains("lab") && now_ < died + 7s) pass(20ms);
  ASSERT_TRUE(b.open.contains("lab"));
  EXPECT_LE(now_ - died, 4s);
  EXPECT_EQ(b.open["lab"].snapshot, "state 2");
  EXPECT_EQ(b.open["lab"].spec, session_spec(1));
  EXPECT_GT(b.open["lab"].revision, b.events.empty() ? 0 : 1);
}

TEST_F(ServiceTest, ClaimsASessionWithoutOwnerAndStandbyOnlyWhenAClientAsks) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  const auto first = a.open["lab"].revision;
  a.runs = false;  // it was alone: no standby
  a.open.clear();
  pass(5s);
  Server& b = start("b");
  pass(5s);
  EXPECT_TRUE(b.open.empty());
  EXPECT_EQ(b.member.locate(named("lab")).kind, Place::kComing);
  pass(100ms);
  ASSERT_TRUE(b.open.contains("lab"));
  EXPECT_GT(b.open["lab"].revision, first);
  EXPECT_EQ(b.member.locate(named("lab")).kind, Place::kHere);
}

TEST_F(ServiceTest, GivesTheConsolesOfADeadOwnerToTheNextOneAndErasesThemWithTheSession) {
  Server& a = start("a", {{"lab", session_spec(1)}, {"two", session_spec(2)}});
  Server& b = start("b");
  ASSERT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.open["lab"].consoles, "");
  a.member.sessions().set_consoles("lab", "consoles 1");
  a.member.sessions().set_consoles("lab", "consoles 2");
  pass(3s);
  EXPECT_EQ(value("consoles/lab"), "consoles 2");
  EXPECT_FALSE(has("consoles/two"));
  a.runs = false;
  a.open.clear();
  pass(5s);
  ASSERT_TRUE(b.open.contains("lab") && b.open.contains("two"));
  EXPECT_EQ(b.open["lab"].consoles, "consoles 2");
  EXPECT_EQ(b.open["two"].consoles, "");
  a.member.sessions().set_consoles("lab", "of the old owner");
  a.runs = true;
  pass(3s);
  EXPECT_EQ(value("consoles/lab"), "consoles 2") << "written only while its writer owns the session";
  b.open.clear();
  b.member.sessions().replace("lab", session_spec(5));
  pass(1s);
  EXPECT_EQ(b.open["lab"].consoles, "") << "another run";
  EXPECT_FALSE(has("consoles/lab"));
  b.member.sessions().set_consoles("lab", "consoles 3");
  pass(500ms);
  b.member.sessions().end("lab");
  pass(1s);
  EXPECT_FALSE(has("consoles/lab"));
}

TEST_F(ServiceTest, HoldsWithoutTheDirectoryAndGoesOnWhenTheLeaseStood) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  EXPECT_GT(a.member.act_until(), now_);
  EXPECT_FALSE(a.member.status(now_).holding);
  a.directory.cut = true;
  for (int n = 0; n < 150 && !a.member.status(now_).holding; ++n) pass(20ms);
  EXPECT_TRUE(a.member.status(now_).holding);
  EXPECT_EQ(a.member.status(now_).trouble, "cut off");
  EXPECT_TRUE(a.open.contains("lab"));
  a.directory.cut = false;
  pass(700ms);
  EXPECT_FALSE(a.member.status(now_).holding);
  EXPECT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.events.size(), 1u);
}

TEST_F(ServiceTest, GivesASessionUpWhenAnotherServerMayOwnIt) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  a.directory.cut = true;
  pass(6s);
  EXPECT_TRUE(b.open.contains("lab"));
  EXPECT_TRUE(a.open.contains("lab"));  // it cannot know; it holds
  EXPECT_LE(a.member.act_until(), now_);
  a.member.sessions().set_snapshot("lab", "old owner");
  a.directory.cut = false;
  pass(3s);
  EXPECT_FALSE(a.open.contains("lab"));
  EXPECT_EQ(a.events.back().kind, Kind::kGiveUp);
  EXPECT_NE(value("snapshots/lab"), "old owner");
  EXPECT_EQ(a.member.locate(named("lab")).server, "b");
}

TEST_F(ServiceTest, NoSessionActsByANewerLeaseWhileTheOrderToGiveItUpWaits) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  a.directory.cut = true;
  pass(6s);
  ASSERT_TRUE(b.open.contains("lab"));
  a.directory.cut = false;
  a.runs = false;  // its main loop is late
  for (int n = 0; n < 150; ++n) {
    pass(20ms);
    a.member.step(now_);
  }
  ASSERT_TRUE(a.member.sessions().has_event());
  EXPECT_GT(a.member.act_until(), now_) << "it has a lease again";
  EXPECT_FALSE(a.member.served_until());
  act(a);
  EXPECT_FALSE(a.open.contains("lab"));
  EXPECT_EQ(a.member.served_until(), a.member.act_until());
}

/// Else a client could not find it by its name while it moves.
TEST_F(ServiceTest, KnowsASessionAsServedHereOrElsewhereAtEachMomentOfAMove) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  std::size_t without_server = 0;
  const auto check = [&] {
    for (Server* const server : {&a, &b}) {
      const auto away = server->member.places().away();
      const auto lab = away.find("lab");
      EXPECT_NE(server->open.contains("lab"), lab != away.end()) << "at " << seconds(now_);
      without_server += lab != away.end() && lab->second.empty() ? 1 : 0;
    }
  };
  on_hand_over = [&](Server&) { check(); };
  order_move("lab", "b");
  for (int n = 0; n < 50; ++n) {
    pass(20ms);
    check();
  }
  EXPECT_TRUE(b.open.contains("lab"));
  EXPECT_EQ(a.member.places().away().at("lab"), "b");
  EXPECT_GT(without_server, 0U) << "the server that gives it up serves it no more, and the next one not yet";
  b.open.erase("lab");
  b.member.sessions().end("lab");
  EXPECT_FALSE(b.member.places().away().contains("lab")) << "it ends";
  pass(2s);
  EXPECT_TRUE(a.member.places().away().empty() && b.member.places().away().empty());
}

TEST_F(ServiceTest, CreatesASessionOnceInTheWholeService) {
  Server& a = start("a");
  Server& b = start("b");
  ASSERT_TRUE(a.member.create(now_, "extra", session_spec(3), 7));
  ASSERT_TRUE(b.member.create(now_, "extra", session_spec(4), 8));
  pass(1s);
  ASSERT_TRUE(a.open.contains("extra"));
  EXPECT_EQ(a.open["extra"].order, 7u);
  ASSERT_EQ(b.events.size(), 1u);
  EXPECT_EQ(b.events[0].kind, Kind::kRefused);
  EXPECT_EQ(b.events[0].order, 8u);
  EXPECT_NE(b.events[0].text.find("on server a"), std::string::npos) << b.events[0].text;
  EXPECT_FALSE(a.member.create(now_, "extra", session_spec(5), 9));
}

TEST_F(ServiceTest, RefusesACreationUnderTheNameOfASessionWithoutOwner) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  a.runs = false;
  a.open.clear();
  pass(5s);
  Server& b = start("b");
  ASSERT_TRUE(b.member.create(now_, "lab", session_spec(4), 8));
  pass(1s);
  ASSERT_EQ(b.events.size(), 1u);
  EXPECT_EQ(b.events[0].kind, Kind::kRefused);
  EXPECT_EQ(parse_service_session(value("catalogue/lab/spec")), session_spec(1));
  EXPECT_FALSE(has("live/sessions/lab/owner"));
}

TEST_F(ServiceTest, RefusesACreationThatTheDirectoryDoesNotAnswerAndLeavesNothing) {
  Server& a = start("a");
  a.directory.answers_lost = true;
  ASSERT_TRUE(a.member.create(now_, "extra", session_spec(3), 7));
  pass(4500ms);
  ASSERT_EQ(a.events.size(), 1u);
  EXPECT_EQ(a.events[0].kind, Kind::kRefused);
  a.directory.answers_lost = false;
  pass(10s);
  EXPECT_TRUE(a.open.empty());
  EXPECT_FALSE(has("catalogue/extra/spec"));
  EXPECT_FALSE(has("live/sessions/extra/owner"));
}

TEST_F(ServiceTest, ErasesEverythingOfASessionThatEnded) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  start("b");
  a.member.sessions().set_snapshot("lab", "state");
  a.member.sessions().set_listed("lab", "listed");
  pass(3s);
  EXPECT_TRUE(has("snapshots/lab") && has("catalogue/lab/listed") && has("live/sessions/lab/standby"));
  a.open.erase("lab");
  a.member.sessions().end("lab");
  pass(2s);
  for (const char* key : {"snapshots/lab", "catalogue/lab/listed", "catalogue/lab/spec", "live/sessions/lab/owner",
                          "live/sessions/lab/standby"})
    EXPECT_FALSE(has(key)) << key;
  for (const auto& server : servers_) EXPECT_EQ(server->member.locate(named("lab")).kind, Place::kNone);
}

TEST_F(ServiceTest, AnotherRunReplacesSpecAndSnapshot) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  a.member.sessions().set_snapshot("lab", "state");
  pass(1s);
  const auto revision = a.open["lab"].revision;
  a.open.erase("lab");
  a.member.sessions().replace("lab", session_spec(5));
  pass(1s);
  ASSERT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.open["lab"].spec, session_spec(5));
  EXPECT_EQ(a.open["lab"].snapshot, "");
  EXPECT_EQ(a.open["lab"].revision, revision);
  EXPECT_FALSE(has("snapshots/lab"));
}

TEST_F(ServiceTest, ChangedConfigurationBeginsTheSessionAgainAtTheStartOfTheService) {
  Server& a = start("a", {{"lab", session_spec(1, "old")}, {"same", session_spec(2, "same")}});
  a.member.sessions().set_snapshot("lab", "state");
  a.member.sessions().set_snapshot("same", "state");
  pass(1s);
  a.runs = false;
  a.open.clear();
  pass(5s);
  Server& b = start("b", {{"lab", session_spec(3, "new")}, {"same", session_spec(4, "same")}});
  ASSERT_TRUE(b.open.contains("lab") && b.open.contains("same"));
  EXPECT_EQ(b.open["lab"].spec, session_spec(3, "new"));
  EXPECT_EQ(b.open["lab"].snapshot, "");
  EXPECT_EQ(b.open["same"].spec, session_spec(2, "same"));
  EXPECT_EQ(b.open["same"].snapshot, "state");
}

TEST_F(ServiceTest, LeavesAtOnceSoThatTheStandbyTakesOverWithoutWaitingForTheLease) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  a.open.clear();
  a.member.sessions().set_snapshot("lab", "last");
  while (!a.member.all_written()) pass(20ms);
  a.member.leave();
  pass(200ms);
  EXPECT_TRUE(a.member.left());
  ASSERT_TRUE(b.open.contains("lab"));
  EXPECT_EQ(b.open["lab"].snapshot, "last");
  EXPECT_FALSE(has("live/servers/a"));
}

TEST_F(ServiceTest, MovesASessionWithItsLastSnapshotWithoutWaitingForALease) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  start("c");
  pass(3s);
  const auto first = a.open["lab"].revision;
  order_move("lab", "b");
  const Time ordered = now_;
  while (!b.open.contains("lab") && now_ < ordered + 5s) pass(20ms);
  ASSERT_TRUE(b.open.contains("lab"));
  EXPECT_LE(now_ - ordered, 1s);
  EXPECT_EQ(b.open["lab"].snapshot, "state at the hand-over");
  EXPECT_GT(b.open["lab"].revision, first);
  EXPECT_FALSE(a.open.contains("lab"));
  pass(3s);
  EXPECT_EQ(value("catalogue/lab/move"), "") << "it moves once";
  EXPECT_TRUE(b.open.contains("lab"));
  EXPECT_TRUE(has("live/sessions/lab/standby"));
}

TEST_F(ServiceTest, MovesASessionOnlyWhenTheTicketsOfItsConsolesAreValidAgain) {
  constexpr int kConsoles = 400;  // their tickets take longer than the ramp-out
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  const auto ticket = [](int n) { return "ticket" + std::to_string(n); };
  for (int n = 0; n < kConsoles; ++n)
    a.member.tickets().use(now_, "lab", ticket(n), 1h, static_cast<std::uint64_t>(n) + 1);
  pass(10s);
  for (int n = 0; n < kConsoles; ++n) {
    ASSERT_EQ(a.member.tickets().poll_result()->outcome, ServiceTickets::Outcome::kAccepted);
    ASSERT_TRUE(has("tickets/" + ticket(n)));
  }
  on_hand_over = [&](Server& server) {
    for (int n = 0; n < kConsoles; ++n) server.member.tickets().restore("lab", ticket(n));
  };
  order_move("lab", "b");
  for (int n = 0; n < 500 && !b.open.contains("lab"); ++n) pass(20ms);
  ASSERT_TRUE(b.open.contains("lab"));
  for (int n = 0; n < kConsoles; ++n) EXPECT_FALSE(has("tickets/" + ticket(n))) << n;
}

TEST_F(ServiceTest, StaysWhereItIsIfTheTargetIsUnknownOrGone) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(1s);
  order_move("lab", "nowhere");
  pass(2s);
  EXPECT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.events.size(), 1u);
  b.runs = false;  // it is registered until its lease ends
  order_move("lab", "b");
  pass(6s);
  static_cast<void>(a.member.locate(named("lab")));
  pass(1s);
  EXPECT_TRUE(a.open.contains("lab")) << "a client that asks brings it back";
  EXPECT_EQ(a.open["lab"].snapshot, "state at the hand-over");
}

TEST_F(ServiceTest, SessionThatCannotBeOpenedHereIsLeftToOthers) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  a.runs = false;
  a.open.clear();
  pass(5s);
  Server& b = start("b");
  b.opens = false;
  static_cast<void>(b.member.locate(named("lab")));
  pass(2s);
  EXPECT_EQ(b.events.size(), 1u);
  EXPECT_FALSE(has("live/sessions/lab/owner"));
  static_cast<void>(b.member.locate(named("lab")));
  pass(1s);
  EXPECT_EQ(b.events.size(), 1u);  // it does not try again at once
  EXPECT_TRUE(has("catalogue/lab/spec"));
  Server& c = start("c");
  static_cast<void>(c.member.locate(named("lab")));
  pass(1s);
  EXPECT_TRUE(c.open.contains("lab"));
}

TEST_F(ServiceTest, StandbyIsInAnotherZoneThanTheOwner) {
  Server& a = start("a", {}, "north");
  start("b", {}, "north");
  start("c", {}, "south");
  for (int n = 0; n < 8; ++n) ASSERT_TRUE(a.member.create(now_, "s" + std::to_string(n), session_spec(n), 1));
  pass(4s);
  for (int n = 0; n < 8; ++n) EXPECT_EQ(value("live/sessions/s" + std::to_string(n) + "/standby"), "c");
}

}  // namespace
}  // namespace tandem::server::test
