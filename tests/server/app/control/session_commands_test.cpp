// Commands of joined connections, from the request to the reply, the notices and the message for the operator.
#include "server/app/control/session_commands.h"

#include "common/io/clock.h"
#include "server/app/control/note_check.h"
#include "server/session/connection_id.h"
#include "tests/common/auth/io/temporary_folder.h"
#include "tests/server/app/control/commanding.h"

namespace tandem::server {
namespace {

using namespace test;
using rpc::ErrorCode;

TEST(SessionCommands, RejectACommandForAnotherSession) {
  Commanding c;
  EXPECT_EQ(error_of(c.ask(rpc::StopSession{id_of(2), ""})),
            (rpc::ErrorReply{ErrorCode::kNotAllowed,
                             "this connection joined the session lesson and cannot act for another one", 0}));
  EXPECT_TRUE(c.messages.empty());
}

TEST(SessionCommands, ReplyThatARemovedSessionIsOver) {
  Commanding c;
  c.lesson.closing = true;
  EXPECT_EQ(error_of(c.ask(rpc::StopSession{id_of(1), ""})),
            (rpc::ErrorReply{ErrorCode::kSessionOver, "this session is over", 0}));
}

TEST(SessionCommands, ReplyThatASessionIsOverThatTheShardDoesNotServe) {
  Commanding c;
  const SessionEntry& over = c.add("over", 2, "", false);
  c.joined.session_id = id_of(2);
  c.serve();
  EXPECT_EQ(error_of(c.ask(rpc::StopSession{id_of(2), ""})),
            (rpc::ErrorReply{ErrorCode::kSessionOver, "this session is over", 0}));
  EXPECT_TRUE(over.notices.events().empty());
  EXPECT_TRUE(c.messages.empty());
}

TEST(SessionCommands, DrainAtOnceAndNotifyParticipantsAndOperator) {
  Commanding c;
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::Drain{30})));
  EXPECT_TRUE(c.registry.drain().active());
  ASSERT_TRUE(c.registry.drain().due());
  EXPECT_LE(*c.registry.drain().due(), io::monotonic_now() + 30s);
  EXPECT_EQ(
      c.notices(),
      (std::vector<std::string>{"the server DRAINS: all hands are released in 30 s; requested by office (operator)"}));
  EXPECT_EQ(c.messages, (std::vector<std::string>{"DRAINING: new joins are rejected, and all hands are released in "
                                                  "30 s; requested by office (operator)"}));
}

TEST(SessionCommands, StopAndResumeWithNameAndReason) {
  Commanding c;
  c.serve();
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::StopSession{id_of(1), "fire drill"})));
  EXPECT_EQ(c.messages, (std::vector<std::string>{"STOPPED by office (operator): fire drill"}));
  const rpc::Body reply = c.ask(rpc::StatusRequest{id_of(1)});
  const auto* const status = std::get_if<rpc::Status>(&reply);
  ASSERT_NE(status, nullptr);
  EXPECT_EQ(status->name, "lesson");
  EXPECT_EQ(status->phase, rpc::SessionPhase::kStopped);
  EXPECT_EQ(status->stops, 1U);
  EXPECT_FALSE(status->draining);
  EXPECT_FALSE(status->drain);
  ASSERT_EQ(status->seats.size(), 2U);
  EXPECT_EQ(status->seats[1].name, "trainee");
  ASSERT_EQ(status->tools.size(), 1U);
  EXPECT_EQ(status->tools[0].name, "tool");
  ASSERT_TRUE(status->stop);
  EXPECT_EQ(status->stop->number, 1U);
  EXPECT_EQ(status->stop->workstation, "office");
  EXPECT_EQ(status->stop->why, "fire drill");
  EXPECT_TRUE(status->stop->yours) << "an operator may end it";

  EXPECT_EQ(error_of(c.ask(rpc::ResumeSession{id_of(1), 2})).code, ErrorCode::kOutdated) << "there is no stop 2";
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::ResumeSession{id_of(1), 1})));
  ASSERT_EQ(c.notices().size(), 1U);
  EXPECT_EQ(c.notices()[0].find("stop 1 is over: RESUMED by office (operator); force returns over "), 0U)
      << c.notices()[0];
  EXPECT_EQ(c.messages.back(), "RESUMED by office (operator)");
  EXPECT_EQ(error_of(c.ask(rpc::RemoveParticipant{id_of(1), "trainee", ""})),
            (rpc::ErrorReply{ErrorCode::kNoSeat, "no client is on seat trainee", 0}));
}

TEST(SessionCommands, ReportASessionWithoutTheDirectoryAsHeldWithTheReason) {
  Commanding c;
  c.serve();
  c.lesson.session().stop_acting();
  const auto status = [&] { return std::get<rpc::Status>(c.ask(rpc::StatusRequest{id_of(1)})); };
  for (int asked = 0; asked < 1000 && status().phase != rpc::SessionPhase::kHeld;) ++asked;  // until the next tick
  EXPECT_EQ(status().phase, rpc::SessionPhase::kHeld);
  EXPECT_NE(status().held.find("the directory of the service does not answer"), std::string::npos) << status().held;
}

TEST(SessionCommands, NameTheSessionInMessagesOfAServerWithSeveral) {
  Commanding c;
  c.add("exam", 2);
  c.serve();
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::StopSession{id_of(1), ""})));
  EXPECT_EQ(c.messages, (std::vector<std::string>{"lesson: STOPPED by office (operator)"}));
}

// ---- Marks and sheets ----

TEST(SessionCommands, PassANoteWithItsAuthorAndTime) {
  Commanding c;
  std::vector<SessionNote> notes;
  std::string problem;
  c.commands.set_on_note([&](const SessionNote& note) {
    notes.push_back(note);
    return problem;
  });
  c.serve();
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::Note{id_of(1), rpc::NoteKind::kSheet, "{\"grip\":4}"})));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].workstation, "office");
  EXPECT_EQ(notes[0].role, AccessRole::kOperator);
  EXPECT_EQ(notes[0].session, "lesson");
  EXPECT_EQ(notes[0].kind, rpc::NoteKind::kSheet);
  EXPECT_EQ(notes[0].json, "{\"grip\":4}");
  for (const std::string json : {"[]", "1", "{} {}", "{", "{\"a\":}"})
    EXPECT_EQ(error_of(c.ask(rpc::Note{id_of(1), rpc::NoteKind::kMark, json})).code, ErrorCode::kBadFrame) << json;
  for (const AccessRole role : {AccessRole::kTrainee, AccessRole::kObserver, AccessRole::kRecorder}) {
    c.joined.role = role;
    EXPECT_EQ(error_of(c.ask(rpc::Note{id_of(1), rpc::NoteKind::kMark, "{}"})).code, ErrorCode::kNotAllowed);
  }
  EXPECT_EQ(notes.size(), 1U);
  c.joined.role = AccessRole::kEvaluator;
  problem = "no space";
  EXPECT_EQ(error_of(c.ask(rpc::Note{id_of(1), rpc::NoteKind::kMark, "{}"})).code, ErrorCode::kInternal)
      << "a note that is not stored is not confirmed";
  EXPECT_EQ(c.messages, std::vector<std::string>{"lesson: no space"}) << "the reply says that the log has the cause";
}

TEST(SessionCommands, NameThePersonOfTheTicket) {
  Commanding c;
  c.joined.person = "ann";
  std::vector<SessionNote> notes;
  c.commands.set_on_note([&](const SessionNote& note) {
    notes.push_back(note);
    return std::string();
  });
  c.serve();
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::StopSession{id_of(1), "fire drill"})));
  EXPECT_EQ(c.messages, (std::vector<std::string>{"STOPPED by ann at office (operator): fire drill"}));
  const rpc::Body reply = c.ask(rpc::StatusRequest{id_of(1)});
  ASSERT_TRUE(std::get<rpc::Status>(reply).stop);
  EXPECT_EQ(std::get<rpc::Status>(reply).stop->person, "ann");
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::ResumeSession{id_of(1), 1})));
  EXPECT_EQ(c.notices()[0].find("stop 1 is over: RESUMED by ann at office (operator)"), 0U) << c.notices()[0];
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::Note{id_of(1), rpc::NoteKind::kMark, "{}"})));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].person, "ann");
  EXPECT_EQ(notes[0].author, "person/ann");
}

TEST(SessionCommands, ListTheNotesThatTheClientMayRead) {
  Commanding c;
  c.serve();
  const rpc::Note draft{id_of(1), rpc::NoteKind::kSheet, R"({"sheet":"GOALS","of":"trainee","closed":false})"};
  const rpc::Note closed{id_of(1), rpc::NoteKind::kSheet, R"({"sheet":"GOALS","of":"trainee","closed":true})"};
  const auto list = [&c](const std::string& person) {
    c.joined.person = person;
    const rpc::Body reply = c.ask(rpc::NotesRequest{id_of(1), 0});
    return std::holds_alternative<rpc::NoteList>(reply) ? std::get<rpc::NoteList>(reply).notes.size() : 99;
  };
  c.joined.person = "ann";
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(rpc::Note{id_of(1), rpc::NoteKind::kMark, "{}"})));
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(closed)));
  const rpc::Body refused = c.ask(draft);
  EXPECT_EQ(error_of(refused).code, ErrorCode::kNotAllowed);
  EXPECT_NE(error_of(refused).text.find("is closed, which is final"), std::string::npos);
  EXPECT_EQ(list("ann"), 2U);
  EXPECT_EQ(list("bob"), 1U) << "marks only";
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(c.ask(closed)));
  EXPECT_EQ(list("bob"), 3U);
  EXPECT_EQ(std::get<rpc::Status>(c.ask(rpc::StatusRequest{id_of(1)})).notes, 3U);
  c.joined.role = AccessRole::kTrainee;
  EXPECT_EQ(std::get<rpc::Status>(c.ask(rpc::StatusRequest{id_of(1)})).notes, 0U) << "may not read notes";
}

TEST(NoteCheck, RejectsDeepNesting) {
  const auto nested = [](int depth) {
    return "{\"a\":" + std::string(static_cast<std::size_t>(depth), '[') +
           std::string(static_cast<std::size_t>(depth), ']') + "}";
  };
  EXPECT_EQ(note_problem(nested(kNoteDepthMax - 1)), "");
  EXPECT_NE(note_problem(nested(kNoteDepthMax)), "");
  EXPECT_NE(note_problem(std::string(rpc::kNoteMax, '[')), "");
  EXPECT_NE(note_problem(nested(4000)), "");
}

// ---- Orders about whole sessions ----

TEST(SessionCommands, GiveTicketsToPersonsWithAndWithoutASeat) {
  Commanding c;
  SessionOrders orders;
  c.commands.set_orders(orders);
  std::optional<rpc::Body> reply;
  c.commands.execute(c.joined, c.office,
                     rpc::CreateSession{.name = "exam",
                                        .scene = "free_motion",
                                        .holders = {{"trainee", "office", "ted"},
                                                    {"", "office", "eva", AccessRole::kEvaluator},
                                                    {"", "office", "", AccessRole::kRecorder}}},
                     [&](rpc::Body body) { reply = std::move(body); });
  const SessionEntry& exam = c.add("exam", 2);
  const rpc::SessionCreated created{.session = SessionRegistry::listed(exam), .code = "", .tickets = {}};
  orders.take()->answer(created);
  ASSERT_TRUE(reply);
  const auto& tickets = std::get<rpc::SessionCreated>(*reply).tickets;
  ASSERT_EQ(tickets.size(), 3U);
  const auto ticket_of = [&](std::size_t i) {
    const auth::TicketUse use{id_of(2), 3, tickets[i].seat, std::nullopt, {c.office.spki}, auth::wall_seconds()};
    const auto ticket = auth::check_ticket(tickets[i].ticket, c.keys.ticket_key().verifier(), use);
    EXPECT_TRUE(ticket) << to_text(ticket.error());
    return ticket.value_or(auth::Ticket{});
  };
  EXPECT_EQ(ticket_of(0).person, "ted");
  EXPECT_EQ(ticket_of(0).role, AccessRole::kTrainee) << "that of the seat";
  EXPECT_EQ(ticket_of(1).person, "eva");
  EXPECT_EQ(ticket_of(1).seat, "");
  EXPECT_EQ(ticket_of(1).role, AccessRole::kEvaluator);
  EXPECT_EQ(tickets[1].role, AccessRole::kEvaluator);
  EXPECT_EQ(ticket_of(2).person, "");
  EXPECT_EQ(ticket_of(2).role, AccessRole::kRecorder);
}

TEST(SessionCommands, LogWhyTheRegistryOfWorkstationsCannotBeRead) {
  Commanding c;
  const auth::test::Folder folder;
  ASSERT_TRUE(auth::ServerKeystore::init(folder.path("state"), auth::wall_seconds()));
  auto keys = auth::ServerKeystore::open(folder.path("state"));
  ASSERT_TRUE(keys) << keys.error();
  folder.write(std::string("state/") + auth::ServerRegistry::kWorkstationsFile, "no list");
  SessionCommands commands{c.registry, *keys, [&](const std::string& line) { c.messages.push_back(line); }};
  SessionOrders orders;
  commands.set_orders(orders);
  rpc::Body reply;
  commands.execute(c.joined, c.office, rpc::CreateSession{.name = "exam", .holders = {{"trainee", "office"}}},
                   [&](rpc::Body body) { reply = std::move(body); });
  EXPECT_NE(error_of(reply).text.find("its log has the cause"), std::string::npos) << error_of(reply).text;
  ASSERT_EQ(c.messages.size(), 1U);
  EXPECT_NE(c.messages[0].find("workstations.textproto"), std::string::npos) << c.messages[0];
}

TEST(SessionCommands, QueueOrdersAboutSessionsUpToALimit) {
  Commanding c;
  const rpc::CreateSession exam{.name = "exam", .scene = "contact"};
  EXPECT_EQ(error_of(c.ask(exam)).code, ErrorCode::kNotAllowed) << "nothing takes orders";
  SessionOrders orders;
  c.commands.set_orders(orders);
  rpc::CreateSession held = exam;
  held.holders = {{"trainee", "nowhere"}};
  const rpc::ErrorReply unknown = error_of(c.ask(held));
  EXPECT_EQ(unknown.code, ErrorCode::kNotEnrolled);
  EXPECT_NE(unknown.text.find("`tandem-server enroll nowhere --address HOST:PORT`"), std::string::npos) << unknown.text;
  held.holders = {{"", "office", "eva", AccessRole::kOperator}};
  const rpc::ErrorReply raised = error_of(c.ask(held));
  EXPECT_EQ(raised.code, ErrorCode::kNotAllowed) << "an operator makes no operators";
  EXPECT_EQ(raised.text.find("eva: no ticket for a console has the role operator here"), 0U) << raised.text;
  std::size_t replies = 0;
  for (std::size_t i = 0; i < SessionOrders::kMax; ++i)
    c.commands.execute(c.joined, c.office, exam, [&](const rpc::Body&) { ++replies; });
  EXPECT_EQ(replies, 0U);
  EXPECT_EQ(error_of(c.ask(rpc::EndSession{id_of(1), ""})).code, ErrorCode::kNotNow);
  EXPECT_TRUE(c.notices().empty()) << "a refused order ends no session";
  for (std::size_t i = 0; i < SessionOrders::kMax; ++i) {
    const auto order = orders.take();
    ASSERT_TRUE(order);
    EXPECT_EQ(order->who, "office (operator)");
    order->answer(rpc::ErrorReply{ErrorCode::kFull, "full", 0});
  }
  EXPECT_FALSE(orders.take());
  EXPECT_EQ(replies, SessionOrders::kMax);
  c.registry.drain().begin();
  EXPECT_EQ(error_of(c.ask(exam)).code, ErrorCode::kDraining);
}

TEST(SessionCommands, AddATicketForEveryHolderToTheReply) {
  Commanding c;
  SessionOrders orders;
  c.commands.set_orders(orders);
  std::optional<rpc::Body> reply;
  c.commands.execute(c.joined, c.office,
                     rpc::CreateSession{.name = "lesson", .scene = "free_motion", .holders = {{"trainee", "office"}}},
                     [&](rpc::Body body) { reply = std::move(body); });
  const auto order = orders.take();
  ASSERT_TRUE(order);
  order->answer(rpc::SessionCreated{.session = SessionRegistry::listed(c.lesson), .code = "", .tickets = {}});
  ASSERT_TRUE(reply);
  const auto& created = std::get<rpc::SessionCreated>(*reply);
  ASSERT_EQ(created.tickets.size(), 1U);
  EXPECT_EQ(created.tickets[0].seat, "trainee");
  EXPECT_EQ(created.tickets[0].workstation, "office");
  const auto redeemed = c.keys.tickets().redeem(
      created.tickets[0].ticket,
      {id_of(1), 3, "trainee", AccessRole::kTrainee, auth::KeyFingerprint{c.office.spki}, auth::wall_seconds()});
  EXPECT_TRUE(redeemed) << redeemed.error().text;
}

TEST(SessionCommands, ReleaseTheSeatsOfRevokedWorkstationsOnly) {
  Commanding c;
  const SeatReservation::Hash secret{std::byte{1}};
  c.lesson.seats[0].admit(c.office, 11, secret, "", {});
  c.lesson.seats[1].admit({"gone", {std::byte{8}}, 0}, 12, secret, "", {});
  ASSERT_TRUE(c.lesson.link_tests.begin_join());
  c.lesson.link_tests.admit(0, {"gone", {std::byte{8}}, 0}, 13);
  c.serve();
  c.commands.disconnect_revoked();
  EXPECT_FALSE(c.lesson.link_tests.find(13));
  c.wait_until([&] { return !c.lesson.seats[1].owner(); });
  EXPECT_TRUE(c.lesson.seats[0].owned_by(11)) << "office is enrolled";
  EXPECT_FALSE(c.lesson.seats[1].owned_by(12));
}

}  // namespace
}  // namespace tandem::server
