// What people read of stops, who may end them, and tickets of which nothing came: over TLS, against a session that ticks on its own thread.
#include "server/app/notices.h"
#include "tests/io/live_house.h"

namespace tandem::server::test {
namespace {

using control::Reason;

const control::Id kId = LiveHouse::kId;

/// Asks until it is so; a server that never gets there fails the test instead of hanging it.
bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kPatience; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(50ms);
  }
  return false;
}

TEST(Standing, EverybodyReadsWhoStoppedAndWhy) {
  LiveHouse house;
  Guest office = joined(house, "office", AccessRole::kOperator), archive = joined(house, "archive", AccessRole::kRecorder),
        trainer = joined(house, "desk-1", AccessRole::kInstructor, "trainer"), trainee = joined(house, "desk-2", AccessRole::kTrainee, "trainee");
  ASSERT_TRUE(office.welcomed() && archive.welcomed() && trainer.welcomed() && trainee.welcomed());
  EXPECT_FALSE(status_of(archive).stop);
  EXPECT_TRUE(done(office.ask(control::StopSession{kId, "fire drill"})));
  for (Guest* who : {&office, &archive, &trainer, &trainee}) {
    const auto stop = status_of(*who).stop;
    ASSERT_TRUE(stop);
    EXPECT_EQ(stop->number, 1U);
    EXPECT_EQ(stop->workstation, "office");
    EXPECT_EQ(stop->seat, "");
    EXPECT_EQ(stop->role, AccessRole::kOperator);
    EXPECT_EQ(stop->why, "fire drill");
    EXPECT_EQ(stop->ends, "an instructor (key r) or an operator (`tandem-client control resume`)");
    EXPECT_EQ(stop->yours, who == &office || who == &trainer);
  }
  // Bounded and printable: what cannot be shown is not taken.
  EXPECT_FALSE(office.connection.ask(control::StopSession{kId, "\x1b[2J"}, kPatience)) << "not even sent";
  EXPECT_TRUE(done(trainee.ask(control::PauseSession{kId, "my hand"})));
  auto second = status_of(archive).stop;
  ASSERT_TRUE(second);
  EXPECT_EQ(second->seat, "trainee");
  EXPECT_EQ(second->why, "my hand");
  EXPECT_EQ(second->kind, control::StopKind::kPause);
  EXPECT_TRUE(done(trainer.ask(control::ResumeSession{kId, 2})));
  second = status_of(archive).stop;
  ASSERT_TRUE(second);
  EXPECT_EQ(second->ends, "") << "over, and still the last one";
}

TEST(Standing, WhereNobodyLeadsWhoPausedMayEndIt) {
  LiveHouse house{"eight_seats"};
  Guest trainee = joined(house, "desk-1", AccessRole::kTrainee, "trainee"), guest = joined(house, "desk-2", AccessRole::kEvaluator, "evaluator1");
  ASSERT_TRUE(trainee.welcomed() && guest.welcomed()) << text_of(trainee.welcome) << text_of(guest.welcome);
  EXPECT_TRUE(done(trainee.ask(control::PauseSession{kId})));
  const auto stop = status_of(trainee).stop;
  ASSERT_TRUE(stop);
  EXPECT_TRUE(stop->yours);
  EXPECT_FALSE(stop->ends.empty());
  EXPECT_TRUE(done(trainee.ask(control::ResumeSession{kId, 1})));
  EXPECT_EQ(status_of(guest).stop->ends, "");
}

// Lines of other threads wait for the one that owns the terminal, in their order, and no flood of them takes memory.
TEST(Notices, KeepTheirOrderAndAreBounded) {
  Notices notices;
  EXPECT_TRUE(notices.take().empty());
  for (std::size_t i = 0; i < Notices::kMax + 7; ++i) notices.add(Notices::Weight::kWarning, std::to_string(i));
  const auto lines = notices.take();
  ASSERT_EQ(lines.size(), Notices::kMax + 1);
  EXPECT_EQ(lines[0].text, "0");
  EXPECT_EQ(lines[Notices::kMax - 1].text, std::to_string(Notices::kMax - 1));
  EXPECT_NE(lines.back().text.find("7 more lines"), std::string::npos);
  EXPECT_TRUE(notices.take().empty());
}

// ---- Tickets of which nothing came -----------------------------------------------------------------------------------------

TEST(Standing, ARefusedOrderOrJoinLeavesTheTicketGoodAndOneThatIsCarriedOutDoesNot) {
  LiveHouse house;
  const auto key = house.enrolled("office");
  const auto come = [&](const control::Credential& by, const std::string& seat = {}) {
    Guest guest{house.enrolled("unused"), house.connect(key), {}};
    guest.welcome = guest.ask(LiveHouse::hello(by, seat));
    return guest;
  };
  const auto comes = [&](const control::Credential& by, const std::string& seat = {}) {
    return comes_true([&] { return come(by, seat).welcomed(); });  // the server notices a moment later that the connection before is over
  };
  const auto ticket = house.ticket(key, AccessRole::kOperator);
  {
    Guest office = come(ticket);
    ASSERT_TRUE(office.welcomed());
    EXPECT_EQ(reason_of(come(ticket).welcome), Reason::kTicket) << "while he is there it is his alone";
    static_cast<void>(status_of(office));
    EXPECT_EQ(reason_of(office.ask(control::ResumeSession{kId, 7})), Reason::kOutdated);
    EXPECT_EQ(reason_of(office.ask(control::SetAuthority{kId, 0, 1, {0.5, 0.5}})), Reason::kNotAllowed);
  }
  EXPECT_TRUE(comes_true([&] {
    Guest office = come(ticket);
    return office.welcomed() && done(office.ask(control::StopSession{kId, ""})) && reason_of(office.ask(control::ResumeSession{kId, 9})) == Reason::kOutdated;
  }));
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(reason_of(come(ticket).welcome), Reason::kTicket) << "an order was carried out";
  const auto looks = house.ticket(key, AccessRole::kRecorder);
  {
    Guest archive = come(looks);
    static_cast<void>(status_of(archive));
    EXPECT_EQ(reason_of(archive.ask(control::StopSession{kId, ""})), Reason::kNotAllowed);
  }
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(reason_of(come(looks).welcome), Reason::kTicket) << "who only may look has looked";
  // A join that cannot be uses nothing up.
  const auto seat = house.ticket(key, AccessRole::kTrainee, "trainee");
  EXPECT_EQ(reason_of(come(seat, "trainer").welcome), Reason::kTicket) << "another seat than it is for";
  control::Hello unfit = LiveHouse::hello(seat, "trainee");
  unfit.device.tip_axes = 1;
  EXPECT_EQ(reason_of(house.connect(key).ask(unfit, kPatience)), Reason::kDeviceUnfit);
  {
    Guest other = joined(house, "desk-2", AccessRole::kTrainee, "trainee");
    ASSERT_TRUE(other.welcomed());
    EXPECT_EQ(reason_of(come(seat, "trainee").welcome), Reason::kSeatTaken);
    Guest trainer = joined(house, "desk-1", AccessRole::kInstructor, "trainer");
    EXPECT_TRUE(done(trainer.ask(control::RemovePerson{kId, "trainee", ""})));
  }
  EXPECT_TRUE(comes(seat, "trainee")) << "after all that";
  EXPECT_EQ(reason_of(come(seat, "trainee").welcome), Reason::kSeatTaken);
}

// ---- Who comes back --------------------------------------------------------------------------------------------------------

/// A secret that was read on one workstation is worth nothing on another, though that one is enrolled too.
TEST(Resume, ASecretIsGoodOnlyAtTheWorkstationItWasGivenTo) {
  LiveHouse house;
  const Guest owner = joined(house, "desk-1", AccessRole::kTrainee, "trainee");
  ASSERT_TRUE(owner.welcomed()) << text_of(owner.welcome);
  const control::Credential secret = control::ResumeCredential{owner.in().resume_secret};
  const trust::Identity other = house.enrolled("desk-2");
  EXPECT_EQ(reason_of(house.connect(other).ask(LiveHouse::hello(secret, "trainee"), kPatience)), control::Reason::kResume);
  const auto back = house.connect(owner.key).ask(LiveHouse::hello(secret, "trainee"), kPatience);
  EXPECT_TRUE(back && std::holds_alternative<control::Welcome>(*back)) << text_of(back);
}

TEST(Resume, AlsoAfterARestartASecretIsGoodOnlyAtItsWorkstation) {
  const Secret<32> secret{trust::random_bytes<std::array<std::byte, 32>>()};
  std::optional<trust::Identity> owner;
  LiveHouse house("free_motion", {}, LiveHouse::limits(), [&](const LiveHouse& h) {
    owner.emplace(h.enrolled("desk-1"));
    KeptSession kept;
    kept.checkpoint.seats_n = static_cast<std::uint8_t>(h.scene().seats.size());
    for (std::size_t i = 0; i < kept.checkpoint.seats_n; ++i) kept.checkpoint.seats[i] = {h.scene().seats[i].name == "trainee", resume_hash(secret.bytes, owner->pin().sha256), 1};
    return kept;
  });
  const control::Credential credential = control::ResumeCredential{secret};
  const trust::Identity other = house.enrolled("desk-2");
  EXPECT_EQ(reason_of(house.connect(other).ask(LiveHouse::hello(credential, "trainee"), kPatience)), control::Reason::kResume);
  const auto back = house.connect(*owner).ask(LiveHouse::hello(credential, "trainee"), kPatience);
  EXPECT_TRUE(back && std::holds_alternative<control::Welcome>(*back)) << text_of(back);
}

}  // namespace
}  // namespace tandem::server::test
