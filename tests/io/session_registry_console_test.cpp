// Messages about stops and who may end them, and tickets of failed joins: over TLS, against a session on its own tick
// thread.
#include "server/app/monitor/message_queue.h"
#include "tests/io/live_server.h"

namespace tandem::server::test {
namespace {

using rpc::ErrorCode;

const rpc::Id kId = LiveServer::kId;

/// Polls until the condition holds; fails the test at the time limit instead of hanging it.
bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kTimeout; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(50ms);
  }
  return false;
}

TEST(Consoles, ShowTheStoppingRoleAndReasonToAllClients) {
  LiveServer live_server;
  JoinedClient office = joined(live_server, "office", AccessRole::kOperator),
               archive = joined(live_server, "archive", AccessRole::kRecorder),
               trainer = joined(live_server, "desk-1", AccessRole::kInstructor, "trainer"),
               trainee = joined(live_server, "desk-2", AccessRole::kTrainee, "trainee");
  ASSERT_TRUE(office.welcomed() && archive.welcomed() && trainer.welcomed() && trainee.welcomed());
  EXPECT_FALSE(status_of(archive).stop);
  EXPECT_TRUE(done(office.ask(rpc::StopSession{kId, "fire drill"})));
  for (JoinedClient* who : {&office, &archive, &trainer, &trainee}) {
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
  // Bounded and printable: text with control characters is rejected.
  EXPECT_FALSE(office.connection.ask(rpc::StopSession{kId, "\x1b[2J"}, kTimeout)) << "not even sent";
  EXPECT_TRUE(done(trainee.ask(rpc::PauseSession{kId, "my hand"})));
  auto second = status_of(archive).stop;
  ASSERT_TRUE(second);
  EXPECT_EQ(second->seat, "trainee");
  EXPECT_EQ(second->why, "my hand");
  EXPECT_EQ(second->kind, rpc::StopKind::kPause);
  EXPECT_TRUE(done(trainer.ask(rpc::ResumeSession{kId, 2})));
  second = status_of(archive).stop;
  ASSERT_TRUE(second);
  EXPECT_EQ(second->ends, "") << "over, and still the last one";
}

TEST(Consoles, LetTheClientThatPausedResumeWithoutAnInstructor) {
  LiveServer live_server{"eight_seats"};
  JoinedClient trainee = joined(live_server, "desk-1", AccessRole::kTrainee, "trainee"),
               guest = joined(live_server, "desk-2", AccessRole::kEvaluator, "evaluator1");
  ASSERT_TRUE(trainee.welcomed() && guest.welcomed()) << text_of(trainee.welcome) << text_of(guest.welcome);
  EXPECT_TRUE(done(trainee.ask(rpc::PauseSession{kId})));
  const auto stop = status_of(trainee).stop;
  ASSERT_TRUE(stop);
  EXPECT_TRUE(stop->yours);
  EXPECT_FALSE(stop->ends.empty());
  EXPECT_TRUE(done(trainee.ask(rpc::ResumeSession{kId, 1})));
  EXPECT_EQ(status_of(guest).stop->ends, "");
}

// Messages of other threads wait for the thread that owns the terminal, in order and in bounded memory.
TEST(MessageQueue, KeepsTheOrderOfMessagesAndIsBounded) {
  MessageQueue notices;
  EXPECT_TRUE(notices.take().empty());
  for (std::size_t i = 0; i < MessageQueue::kMax + 7; ++i) notices.add(io::Level::kWarn, std::to_string(i));
  const auto lines = notices.take();
  ASSERT_EQ(lines.size(), MessageQueue::kMax + 1);
  EXPECT_EQ(lines[0].text, "0");
  EXPECT_EQ(lines[MessageQueue::kMax - 1].text, std::to_string(MessageQueue::kMax - 1));
  EXPECT_NE(lines.back().text.find("7 more lines"), std::string::npos);
  EXPECT_TRUE(notices.take().empty());
}

// ---- Tickets that become valid again ----

TEST(Consoles, ConsumeATicketOnlyByAnAcceptedCommandOrJoin) {
  LiveServer live_server;
  const auto key = live_server.enrolled("office");
  const auto come = [&](const rpc::Credential& by, const std::string& seat = {}) {
    JoinedClient guest{live_server.enrolled("unused"), live_server.connect(key), {}};
    guest.welcome = guest.ask(LiveServer::hello(by, seat));
    return guest;
  };
  const auto comes = [&](const rpc::Credential& by, const std::string& seat = {}) {
    return comes_true([&] {
      return come(by, seat).welcomed();
    });  // the server notices shortly afterwards that the earlier connection has ended
  };
  const auto ticket = live_server.ticket(key, AccessRole::kOperator);
  {
    JoinedClient office = come(ticket);
    ASSERT_TRUE(office.welcomed());
    EXPECT_EQ(reason_of(come(ticket).welcome), ErrorCode::kTicket) << "a ticket in use admits no second console";
    static_cast<void>(status_of(office));
    EXPECT_EQ(reason_of(office.ask(rpc::ResumeSession{kId, 7})), ErrorCode::kOutdated);
    EXPECT_EQ(reason_of(office.ask(rpc::SetAuthority{kId, 0, 1, {0.5, 0.5}})), ErrorCode::kNotAllowed);
  }
  EXPECT_TRUE(comes_true([&] {
    JoinedClient office = come(ticket);
    return office.welcomed() && done(office.ask(rpc::StopSession{kId, ""})) &&
           reason_of(office.ask(rpc::ResumeSession{kId, 9})) == ErrorCode::kOutdated;
  }));
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(reason_of(come(ticket).welcome), ErrorCode::kTicket) << "a command was applied";
  const auto looks = live_server.ticket(key, AccessRole::kRecorder);
  {
    JoinedClient archive = come(looks);
    static_cast<void>(status_of(archive));
    EXPECT_EQ(reason_of(archive.ask(rpc::StopSession{kId, ""})), ErrorCode::kNotAllowed);
  }
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(reason_of(come(looks).welcome), ErrorCode::kTicket) << "a status query uses the ticket of a recorder";
  // A failed join uses no ticket.
  const auto seat = live_server.ticket(key, AccessRole::kTrainee, "trainee");
  EXPECT_EQ(reason_of(come(seat, "trainer").welcome), ErrorCode::kTicket) << "another seat than it is for";
  rpc::Hello unfit = LiveServer::hello(seat, "trainee");
  unfit.device.tip_axes = 1;
  EXPECT_EQ(reason_of(live_server.connect(key).ask(unfit, kTimeout)), ErrorCode::kDeviceUnfit);
  {
    JoinedClient other = joined(live_server, "desk-2", AccessRole::kTrainee, "trainee");
    ASSERT_TRUE(other.welcomed());
    EXPECT_EQ(reason_of(come(seat, "trainee").welcome), ErrorCode::kSeatTaken);
    JoinedClient trainer = joined(live_server, "desk-1", AccessRole::kInstructor, "trainer");
    EXPECT_TRUE(done(trainer.ask(rpc::RemoveParticipant{kId, "trainee", ""})));
  }
  EXPECT_TRUE(comes(seat, "trainee")) << "after all that";
  EXPECT_EQ(reason_of(come(seat, "trainee").welcome), ErrorCode::kTicket) << "used, so waiting for the seat is in vain";
}

// ---- Resume ----

/// A secret that was read on one workstation is invalid on another, even an enrolled one.
TEST(Resume, AcceptsASecretOnlyFromItsWorkstation) {
  LiveServer live_server;
  const JoinedClient owner = joined(live_server, "desk-1", AccessRole::kTrainee, "trainee");
  ASSERT_TRUE(owner.welcomed()) << text_of(owner.welcome);
  const rpc::Credential secret = rpc::ResumeCredential{owner.in().resume_secret};
  const auth::Identity other = live_server.enrolled("desk-2");
  EXPECT_EQ(reason_of(live_server.connect(other).ask(LiveServer::hello(secret, "trainee"), kTimeout)),
            rpc::ErrorCode::kResume);
  const auto back = live_server.connect(owner.key).ask(LiveServer::hello(secret, "trainee"), kTimeout);
  EXPECT_TRUE(back && std::holds_alternative<rpc::Welcome>(*back)) << text_of(back);
}

TEST(Resume, AcceptsASecretOnlyFromItsWorkstationAfterARestart) {
  const Secret<32> secret{auth::random_bytes<std::array<std::byte, 32>>()};
  std::optional<auth::Identity> owner;
  LiveServer live_server("free_motion", {}, LiveServer::limits(), [&](const LiveServer& h) {
    owner.emplace(h.enrolled("desk-1"));
    SessionSnapshot kept;
    kept.checkpoint.seats_n = static_cast<std::uint8_t>(h.scene().seats.size());
    for (std::size_t i = 0; i < kept.checkpoint.seats_n; ++i)
      kept.checkpoint.seats[i] = {h.scene().seats[i].name == "trainee",
                                  resume_hash(secret.bytes, owner->fingerprint().sha256), 1};
    return kept;
  });
  const rpc::Credential credential = rpc::ResumeCredential{secret};
  const auth::Identity other = live_server.enrolled("desk-2");
  EXPECT_EQ(reason_of(live_server.connect(other).ask(LiveServer::hello(credential, "trainee"), kTimeout)),
            rpc::ErrorCode::kResume);
  const auto back = live_server.connect(*owner).ask(LiveServer::hello(credential, "trainee"), kTimeout);
  EXPECT_TRUE(back && std::holds_alternative<rpc::Welcome>(*back)) << text_of(back);
}

}  // namespace
}  // namespace tandem::server::test
