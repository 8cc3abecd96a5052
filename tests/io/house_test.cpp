// People at control connections of a real server: over TLS, against a session that ticks on its own thread.
#include <algorithm>
#include <atomic>

#include "server/visitors.h"
#include "tests/io/live_house.h"

namespace tandem::server::test {
namespace {

using control::Reason;

const control::Id kId = LiveHouse::kId;

std::vector<control::Body> every_command() {
  return {control::StopSession{kId, "why"}, control::PauseSession{kId}, control::ResumeSession{kId, 1}, control::SetAuthority{kId, 0, 1, {0.5, 0.5}},
          control::RemovePerson{kId, "trainee", "why"}, control::Drain{0}};
}

/// Asks until it is so; a server that never gets there fails the test instead of hanging it.
bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kPatience; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(20ms);
  }
  return false;
}

// ---- Without a seat --------------------------------------------------------------------------------------------------------

TEST(Standing, AnOperatorStopsAndResumesAndItIsWrittenDownWithHisName) {
  LiveHouse house;
  Guest office = joined(house, "office", AccessRole::kOperator);
  ASSERT_TRUE(office.welcomed()) << text_of(office.welcome);
  EXPECT_EQ(office.in().role, AccessRole::kOperator);
  EXPECT_EQ(office.in().seat, "");
  EXPECT_TRUE(office.in().setup.empty());
  EXPECT_EQ(reason_of(office.ask(control::ResumeSession{kId, 0})), Reason::kOutdated) << "nothing is stopped";
  EXPECT_TRUE(done(office.ask(control::StopSession{kId, "fire drill"})));
  EXPECT_TRUE(done(office.ask(control::StopSession{kId, ""})));
  EXPECT_EQ(status_of(office).phase, control::SessionPhase::kStopped);
  EXPECT_EQ(status_of(office).stops, 2U);
  const auto old = office.ask(control::ResumeSession{kId, 1});
  EXPECT_EQ(reason_of(old), Reason::kOutdated);
  EXPECT_NE(text_of(old).find("stop 2 came since"), std::string::npos) << text_of(old);
  EXPECT_EQ(status_of(office).phase, control::SessionPhase::kStopped);
  EXPECT_TRUE(done(office.ask(control::ResumeSession{kId, 2})));
  EXPECT_NE(status_of(office).phase, control::SessionPhase::kStopped);
  const std::string audit = house.audit();
  EXPECT_NE(audit.find("\"event\":\"stop\",\"name\":\"lesson\",\"detail\":\"office (operator) stop 1 tick 0: fire drill\""), std::string::npos) << audit;
  EXPECT_NE(audit.find("\"event\":\"resume\",\"name\":\"lesson\",\"detail\":\"office (operator) stop 2 tick 0\""), std::string::npos) << audit;
}

TEST(Standing, ARecorderMayLookAndNothingElse) {
  LiveHouse house;
  Guest recorder = joined(house, "archive", AccessRole::kRecorder);
  ASSERT_TRUE(recorder.welcomed()) << text_of(recorder.welcome);
  const control::Status before = status_of(recorder);
  EXPECT_EQ(before.name, "lesson");
  ASSERT_EQ(before.seats.size(), 2U);
  EXPECT_TRUE(before.seats[0].master && before.seats[1].master);
  for (const control::Body& command : every_command()) EXPECT_EQ(reason_of(recorder.ask(command)), Reason::kNotAllowed) << command.index();
  EXPECT_TRUE(std::holds_alternative<control::SessionList>(*recorder.ask(control::SessionListRequest{})));
  control::Status after = status_of(recorder);
  after.time_s = before.time_s;
  EXPECT_EQ(after, before);
  EXPECT_EQ(house.count(ControlEvent::kForbidden), every_command().size());
}

TEST(Standing, NeedsATicketForThisSessionAndWorkstationOnce) {
  LiveHouse house;
  const auto key = house.enrolled("office");
  const auto ask = [&](const control::Credential& credential, const std::string& seat = {}) { return house.connect(key).ask(LiveHouse::hello(credential, seat), kPatience); };
  EXPECT_EQ(reason_of(ask({})), Reason::kNoSeat);
  EXPECT_EQ(reason_of(ask(control::CodeCredential{LiveHouse::kCode})), Reason::kNoSeat) << "a session's code gives a seat, not the server";
  const auto ticket = house.ticket(key, AccessRole::kOperator);
  EXPECT_EQ(reason_of(ask(ticket, "trainee")), Reason::kTicket) << "nor does an operator's ticket give a seat";
  EXPECT_TRUE(std::holds_alternative<control::Welcome>(*ask(ticket)));
  EXPECT_NE(text_of(ask(ticket)).find("used already"), std::string::npos);
  const auto thief = house.enrolled("thief");
  EXPECT_EQ(reason_of(house.connect(thief).ask(LiveHouse::hello(house.ticket(key, AccessRole::kOperator)), kPatience)), Reason::kTicket);
  auto raised = std::get<control::TicketCredential>(house.ticket(key, AccessRole::kRecorder));
  raised.bytes[1] = static_cast<std::byte>(AccessRole::kOperator);
  EXPECT_NE(text_of(ask(raised)).find("changed"), std::string::npos) << "a role raised by an edited byte";
  auto lowered = std::get<control::TicketCredential>(house.ticket(key, AccessRole::kRecorder));
  lowered.bytes[1] = static_cast<std::byte>(AccessRole::kTrainee);
  EXPECT_EQ(reason_of(ask(lowered)), Reason::kNotAllowed) << "who works in a session sits on a seat";
}

TEST(Standing, SpeaksForItsOwnSessionOnly) {
  LiveHouse house;
  Guest office = joined(house, "office", AccessRole::kOperator);
  auto other = kId;
  other[0] = std::byte{99};
  EXPECT_EQ(reason_of(office.ask(control::StopSession{other, ""})), Reason::kNotAllowed);
  EXPECT_EQ(status_of(office).stops, 0U);
}

// ---- Authority and removal -------------------------------------------------------------------------------------------------

// Two instructors, one at his seat and one at a console, both on what they saw last, again and again.
TEST(Orders, OfTwoInstructorsExactlyOneWinsAndTheLoserGetsTheNewValue) {
  LiveHouse house;
  Guest seat = joined(house, "desk-1", AccessRole::kInstructor, "trainer"), console = joined(house, "desk-2", AccessRole::kInstructor);
  ASSERT_TRUE(seat.welcomed() && console.welcomed()) << text_of(seat.welcome) << text_of(console.welcome);
  for (int round = 0; round < 30; ++round) {
    const std::uint32_t version = status_of(console).authority_version;
    const double a = 0.1 + 0.01 * round;
    std::atomic<int> ready{0};
    const auto set = [&](Guest& who, double own) {
      ++ready;
      while (ready < 2) std::this_thread::yield();
      return who.ask(control::SetAuthority{kId, 0, version, {own, 1 - own}});
    };
    std::expected<control::Body, trust::ClientFault> first;
    std::thread other([&] { first = set(seat, a); });
    const auto second = set(console, 1 - a);
    other.join();
    ASSERT_TRUE(first && second);
    const auto* one = std::get_if<control::AuthorityAnswer>(&*first);
    const auto* two = std::get_if<control::AuthorityAnswer>(&*second);
    ASSERT_TRUE(one != nullptr && two != nullptr) << text_of(first) << text_of(second);
    EXPECT_NE(one->applied, two->applied) << "exactly one";
    EXPECT_EQ(one->version, version + 1);
    EXPECT_EQ(two->version, version + 1);
    EXPECT_EQ(one->alpha, two->alpha) << "the loser gets the new value";
    EXPECT_NEAR(one->alpha[0], one->applied ? a : 1 - a, 1e-12);
    if (round % 10 == 9) std::this_thread::sleep_for(1s);  // the orders' rate fills up
  }
  const std::string audit = house.audit();
  EXPECT_NE(audit.find("(instructor, seat trainer) tool version"), std::string::npos) << audit;
  EXPECT_NE(audit.find("trainer "), std::string::npos);
}

TEST(Orders, WhoIsRemovedLosesSeatRightsAndSecretAndComesBackByATicketOnly) {
  LiveHouse house;
  Guest trainer = joined(house, "desk-1", AccessRole::kInstructor, "trainer");
  const auto key = house.enrolled("desk-2");
  Guest trainee{house.enrolled("desk-3"), house.connect(key), {}};  // enters by the session's code
  trainee.welcome = trainee.ask(LiveHouse::hello(control::CodeCredential{LiveHouse::kCode}, "trainee"));
  ASSERT_TRUE(trainer.welcomed() && trainee.welcomed()) << text_of(trainee.welcome);
  EXPECT_TRUE(done(trainee.ask(control::PauseSession{kId}))) << "he may pause";
  EXPECT_EQ(reason_of(trainer.ask(control::RemovePerson{kId, "nobody", ""})), Reason::kNoSeat);
  EXPECT_TRUE(done(trainer.ask(control::RemovePerson{kId, "trainee", "pushes the others"})));
  const auto gone = trainee.ask(control::PauseSession{kId});
  EXPECT_EQ(reason_of(gone), Reason::kNotAllowed) << "his connection speaks for a seat that is not his";
  EXPECT_NE(text_of(gone).find("(removed by desk-1 (instructor, seat trainer): pushes the others)"), std::string::npos) << text_of(gone);
  EXPECT_TRUE(comes_true([&] { return !status_of(trainer).seats[1].taken; }));
  const auto again = [&](const control::Credential& by) { return house.connect(key).ask(LiveHouse::hello(by, "trainee"), kPatience); };
  EXPECT_EQ(reason_of(again(control::ResumeCredential{trainee.in().resume_secret})), Reason::kResume);
  const auto code = again(control::CodeCredential{LiveHouse::kCode});
  EXPECT_EQ(reason_of(code), Reason::kNotAllowed);
  EXPECT_NE(text_of(code).find("a ticket lets it in again"), std::string::npos) << text_of(code);
  EXPECT_TRUE(std::holds_alternative<control::Welcome>(*again(house.ticket(key, AccessRole::kTrainee, "trainee"))));
  EXPECT_NE(house.audit().find("\"event\":\"remove\",\"name\":\"lesson\",\"detail\":\"desk-1 (instructor, seat trainer) trainee tick 0: pushes the others\""), std::string::npos)
      << house.audit();
}

// ---- Somebody enrolled and seated who says what is not his ------------------------------------------------------------------

TEST(Orders, ATraineeWhoOrdersLikeAnInstructorIsRefusedCountedWrittenDownAndDisturbsNobody) {
  LiveHouse house;
  Guest trainer = joined(house, "desk-1", AccessRole::kInstructor, "trainer"), trainee = joined(house, "desk-2", AccessRole::kTrainee, "trainee");
  ASSERT_TRUE(trainer.welcomed() && trainee.welcomed());
  const control::Status before = status_of(trainer);
  for (const control::Body& command : {control::Body{control::StopSession{kId, ""}}, control::Body{control::RemovePerson{kId, "trainer", ""}}, control::Body{control::Drain{0}}}) {
    const auto answer = trainee.ask(command);
    EXPECT_EQ(reason_of(answer), Reason::kNotAllowed) << command.index();
    EXPECT_NE(text_of(answer).find("the role trainee may not"), std::string::npos) << text_of(answer);
  }
  EXPECT_EQ(house.count(ControlEvent::kForbidden), 3U);
  EXPECT_EQ(reason_of(trainee.ask(control::ResumeSession{kId, 0})), Reason::kOutdated) << "nothing is stopped";
  // What his role may say and the session refuses: weight for himself.
  EXPECT_EQ(reason_of(trainee.ask(control::SetAuthority{kId, 0, before.authority_version, {0, 1}})), Reason::kNotAllowed);
  control::Status after = status_of(trainer);
  after.time_s = before.time_s;
  EXPECT_EQ(after, before) << "nothing moved";
  EXPECT_FALSE(house.house().drain_due());
  const std::string audit = house.audit();
  EXPECT_NE(audit.find("\"event\":\"forbidden\",\"name\":\"lesson\",\"detail\":\"desk-2 (trainee, seat trainee)"), std::string::npos) << audit;
  EXPECT_TRUE(done(trainer.ask(control::StopSession{kId, ""}))) << "and nobody else is slowed down";
  const auto his = trainee.ask(control::ResumeSession{kId, 1});
  EXPECT_EQ(reason_of(his), Reason::kNotAllowed);
  EXPECT_NE(text_of(his).find("who may: an instructor (key r) or an operator"), std::string::npos) << text_of(his);
}

TEST(Orders, AStopWaitsForNothingElseThatWasAsked) {
  LiveHouse house;
  Guest office = joined(house, "office", AccessRole::kOperator);
  bool fast = false;
  for (int i = 0; i < 200 && !fast; ++i) fast = reason_of(office.ask(control::StatusRequest{kId})) == Reason::kTooFast;
  EXPECT_TRUE(fast) << "20 at once, 10 a second";
  EXPECT_TRUE(done(office.ask(control::StopSession{kId, ""})));
}

TEST(Orders, AnOperatorDrainsTheServerAndStillSeesIt) {
  LiveHouse house;
  Guest office = joined(house, "office", AccessRole::kOperator), trainer = joined(house, "desk-1", AccessRole::kInstructor, "trainer");
  EXPECT_EQ(reason_of(trainer.ask(control::Drain{0})), Reason::kNotAllowed);
  EXPECT_FALSE(house.house().drain_due());
  EXPECT_TRUE(done(office.ask(control::Drain{3600})));
  const auto first = house.house().drain_due();
  ASSERT_TRUE(first);
  EXPECT_GT(*first, io::monotonic_now());
  Guest late = joined(house, "desk-2", AccessRole::kTrainee, "trainee");
  EXPECT_EQ(reason_of(late.welcome), Reason::kDraining);
  Guest second = joined(house, "office-2", AccessRole::kOperator);
  ASSERT_TRUE(second.welcomed()) << "who looks after sessions may come while they end";
  EXPECT_TRUE(status_of(second).draining);
  EXPECT_TRUE(done(second.ask(control::Drain{0})));
  EXPECT_LT(*house.house().drain_due(), *first) << "sooner, never later";
  EXPECT_TRUE(done(office.ask(control::Drain{3600})));
  EXPECT_LT(*house.house().drain_due(), *first);
  EXPECT_NE(house.audit().find("\"event\":\"drain\",\"name\":\"\",\"detail\":\"office (operator) in 3600 s\""), std::string::npos) << house.audit();
}

// ---- Revoked ---------------------------------------------------------------------------------------------------------------

TEST(Revocation, TakesSeatAndConnectionsOfThatWorkstationAndOfNobodyElse) {
  LiveHouse house;
  Guest trainer = joined(house, "desk-1", AccessRole::kInstructor, "trainer"), trainee = joined(house, "desk-2", AccessRole::kTrainee, "trainee"),
        office = joined(house, "office", AccessRole::kOperator);
  ASSERT_TRUE(trainer.welcomed() && trainee.welcomed() && office.welcomed());
  house.look_for_revoked();
  EXPECT_TRUE(status_of(trainer).seats[1].taken) << "who is enrolled stays";
  ASSERT_TRUE(house.beside().revoke("desk-2"));
  house.look_for_revoked();
  EXPECT_TRUE(comes_true([&] { return !status_of(trainer).seats[1].taken; }));
  EXPECT_TRUE(house.told(ControlEvent::kNotEnrolled, "desk-2")) << "its connection was ended, though it said nothing";
  const auto next = trainee.ask(control::StatusRequest{kId});
  EXPECT_TRUE(!next || reason_of(next) == Reason::kNotEnrolled) << text_of(next);
  EXPECT_TRUE(status_of(office).seats[0].taken);
  EXPECT_NE(house.audit().find("\"event\":\"revoked_seat\",\"name\":\"desk-2\",\"detail\":\"lesson trainee tick"), std::string::npos) << house.audit();
  house.look_for_revoked();
  ASSERT_TRUE(house.beside().revoke("office"));
  house.look_for_revoked();
  const auto gone = office.ask(control::StopSession{kId, ""});
  EXPECT_TRUE(!gone || reason_of(gone) == Reason::kNotEnrolled);
  EXPECT_EQ(status_of(trainer).stops, 0U);
}

TEST(Revocation, ABookThatCannotBeReadTakesNobodysSeat) {
  LiveHouse house;
  Guest trainer = joined(house, "desk-1", AccessRole::kInstructor, "trainer"), office = joined(house, "office", AccessRole::kOperator);
  const std::string book = house.folder.read(std::string("server/") + trust::ServerTrust::kWorkstationsFile);
  house.folder.write(std::string("server/") + trust::ServerTrust::kWorkstationsFile, "nonsense {");
  house.look_for_revoked();
  house.folder.write(std::string("server/") + trust::ServerTrust::kWorkstationsFile, book);
  EXPECT_TRUE(status_of(office).seats[0].taken);
  house.look_for_revoked();
  EXPECT_TRUE(status_of(trainer).seats[0].taken);
}

// ---- Those who judge their link --------------------------------------------------------------------------------------------

// A visitor who never speaks keeps his place for 2 s: a machine that is slower than that between two questions shows nothing, and is
// asked again.
constexpr auto kQuick = 1500ms;

control::Hello visiting() {
  control::Hello hello = LiveHouse::hello({});
  hello.visit = true;
  return hello;
}

TEST(Visits, NoMoreAreWelcomedThanAreServed) {
  LiveHouse house;
  const auto key = house.enrolled("desk-1"), other = house.enrolled("desk-2");  // one key has four connections that have not joined
  for (int attempt = 0; attempt < 10; ++attempt) {
    std::vector<trust::ControlClient> connections;
    for (std::size_t i = 0; i <= Visitors::kMax; ++i) connections.push_back(house.connect(i % 2 == 0 ? key : other));
    std::vector<std::expected<control::Body, trust::ClientFault>> answers;
    const auto began = std::chrono::steady_clock::now();
    for (trust::ControlClient& c : connections) answers.push_back(c.ask(visiting(), kPatience));
    const bool quick = std::chrono::steady_clock::now() - began < kQuick;
    if (quick) {
      for (std::size_t i = 0; i < Visitors::kMax; ++i) EXPECT_TRUE(std::holds_alternative<control::Welcome>(*answers[i])) << i;
      ASSERT_EQ(reason_of(answers.back()), Reason::kFull) << "one more";
      EXPECT_NE(text_of(answers.back()).find("all 4 places"), std::string::npos) << text_of(answers.back());
      EXPECT_EQ(std::get<control::Refused>(*answers.back()).retry_after_s, 3U);
    }
    // Nobody of them ever speaks: by and by their places are free.
    EXPECT_TRUE(comes_true([&] { return std::holds_alternative<control::Welcome>(*house.connect(key).ask(visiting(), kPatience)); }));
    if (quick) return;
    std::this_thread::sleep_for(3s);
  }
  GTEST_SKIP() << "this machine took longer than " << kQuick.count() << " ms for five questions, ten times";
}

TEST(Visits, ManyAtOnceGetNoMoreThanThePlacesThereAre) {
  LiveHouse house;
  const std::array keys{house.enrolled("desk-1"), house.enrolled("desk-2"), house.enrolled("desk-3")};  // one key has four connections that have not joined
  std::vector<trust::ControlClient> connections;
  for (std::size_t i = 0; i < 12; ++i) connections.push_back(house.connect(keys[i % 3]));
  std::atomic<int> welcomed{0}, full{0};
  std::vector<std::thread> crowd;
  const auto began = std::chrono::steady_clock::now();
  for (trust::ControlClient& c : connections)
    crowd.emplace_back([&] {
      const auto answer = c.ask(visiting(), kPatience);
      if (answer && std::holds_alternative<control::Welcome>(*answer)) ++welcomed;
      if (reason_of(answer) == Reason::kFull) ++full;
    });
  for (std::thread& t : crowd) t.join();
  EXPECT_EQ(welcomed + full, 12);
  EXPECT_GE(welcomed, 1);
  if (std::chrono::steady_clock::now() - began < kQuick) {
    EXPECT_LE(welcomed, static_cast<int>(Visitors::kMax));
  } else {
    std::printf("[ NOT RUN ] the bound: this machine took longer than %d ms for twelve questions\n", static_cast<int>(kQuick.count()));
  }
}

// ---- Room for more ---------------------------------------------------------------------------------------------------------

TEST(Admission, AThreadThatTakesMoreOfAProcessorThanAllowedLetsNobodyNewIn) {
  LiveHouse house("eight_seats", {0.6, 1e-9});
  ASSERT_TRUE(comes_true([&] { return house.shard().core() > 0; })) << "measured within a second or so";
  EXPECT_LT(house.shard().core(), 1.01);
  Guest late = joined(house, "desk-1", AccessRole::kInstructor, "trainer");
  EXPECT_EQ(reason_of(late.welcome), Reason::kFull);
  EXPECT_NE(text_of(late.welcome).find("of a processor"), std::string::npos) << text_of(late.welcome);
  EXPECT_TRUE(joined(house, "office", AccessRole::kOperator).welcomed()) << "who looks after it takes nothing of the tick";
}

}  // namespace
}  // namespace tandem::server::test
