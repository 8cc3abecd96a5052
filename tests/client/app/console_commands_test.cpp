// Commands that a user types after `tandem-client control`, and the texts shown.
#include "client/app/console_commands.h"

#include <gtest/gtest.h>

#include "client/app/console_sessions.h"
#include "client/app/session_status_text.h"

namespace tandem::client {
namespace {

using Words = std::vector<std::string>;

std::string problem(const Words& words) {
  const auto wish = parse_command(words);
  return wish ? "" : wish.error();
}

/// Parses a command of this type. A wrong command or type throws, which fails the test.
template <class Command>
Command parsed(const Words& words) {
  return std::get<Command>(parse_command(words).value());
}

rpc::Status lesson() {
  rpc::Status s;
  s.session_id[0] = std::byte{0xab};
  s.name = "lesson";
  s.phase = rpc::SessionPhase::kStopped;
  s.stops = 3;
  s.authority_version = 7;
  s.time_s = 12.34;
  s.seats = {{"trainer", AccessRole::kInstructor, true, true, true},
             {"trainee", AccessRole::kTrainee, true, false, true},
             {"arm", AccessRole::kObserver, false, false, false}};
  s.tools = {{"drill", {0.25, 0.75}}};
  s.stop = {3, rpc::StopKind::kStop, "", "desk", AccessRole::kOperator, "fire drill", 2.5, "an operator", true};
  return s;
}

/// A console that needed no ticket is on the server's own computer, whose user needs none for a seat either.
TEST(CreatedText, PrintsAJoinThatWorksForThisUser) {
  rpc::SessionCreated created;
  created.session = {{}, "exam", rpc::SessionPhase::kWaiting, {{"trainer", AccessRole::kInstructor, false, true}}};
  JoinOptions asked;
  EXPECT_EQ(created_text(created, asked).find("--ticket-file"), std::string::npos) << created_text(created, asked);
  EXPECT_NE(created_text(created, asked).find("--session exam --seat trainer --device sim`"), std::string::npos);
  asked.ticket = "tdt1-x";
  EXPECT_NE(created_text(created, asked).find("--ticket-file FILE --device sim`"), std::string::npos);
  asked.ticket.clear();
  created.tickets = {{"trainer", "desk", {}}};
  EXPECT_NE(created_text(created, asked).find("FILE has the ticket of the workstation"), std::string::npos)
      << "of another workstation";
}

TEST(ConsoleCommands, ParseEveryCommand) {
  EXPECT_TRUE(std::holds_alternative<rpc::StatusRequest>(*parse_command(Words{"status"})));
  EXPECT_EQ(parsed<rpc::StopSession>({"stop", "in", "the", "way"}), (rpc::StopSession{{}, "in the way"}));
  EXPECT_EQ(parsed<rpc::PauseSession>({"pause"}), rpc::PauseSession{});
  EXPECT_EQ(parsed<rpc::PauseSession>({"pause", "my", "hand"}), (rpc::PauseSession{{}, "my hand"}));
  EXPECT_EQ(parsed<rpc::ResumeSession>({"resume"}).stop, 0U) << "the present stop";
  EXPECT_EQ(parsed<rpc::ResumeSession>({"resume", "4"}).stop, 4U);
  const auto authority = parsed<AuthorityCommand>({"authority", "a=0.25,b=0.75", "version=3", "tool=drill"});
  EXPECT_EQ(authority.weights, (std::vector<std::pair<std::string, double>>{{"a", 0.25}, {"b", 0.75}}));
  EXPECT_EQ(authority.version, 3U);
  EXPECT_EQ(authority.tool, "drill");
  EXPECT_EQ(parsed<rpc::RemoveParticipant>({"remove", "trainee", "rude"}),
            (rpc::RemoveParticipant{{}, "trainee", "rude"}));
  EXPECT_EQ(parsed<rpc::Drain>({"drain"}).grace_s, 0U);
  EXPECT_EQ(parsed<rpc::Drain>({"drain", "3600"}).grace_s, 3600U);
  const auto create = parsed<CreateCommand>({"create", "exam", "contact", "time=90s", "trainee=desk-2", "tickets"});
  EXPECT_EQ(create.name, "exam");
  EXPECT_EQ(create.scene, "contact");
  EXPECT_EQ(create.life_s, 90U);
  EXPECT_TRUE(create.tickets_only);
  EXPECT_EQ(create.holders, (std::vector<rpc::SeatHolder>{{"trainee", "desk-2"}}));
  EXPECT_EQ(parsed<EndCommand>({"end", "exam", "is", "over"}).why, "is over");
  EXPECT_TRUE(std::holds_alternative<SessionsCommand>(*parse_command(Words{"sessions"})));
  EXPECT_EQ(parsed<rpc::Note>({"note", "sheet", "{\"a\":", "1}"}),
            (rpc::Note{{}, rpc::NoteKind::kSheet, "{\"a\": 1}"}));
  EXPECT_TRUE(parsed<rpc::RecordSession>({"record", "start"}).on);
  EXPECT_FALSE(parsed<rpc::RecordSession>({"record", "stop"}).on);
  EXPECT_TRUE(std::holds_alternative<HelpCommand>(*parse_command(Words{"help"})));
  EXPECT_TRUE(std::holds_alternative<QuitCommand>(*parse_command(Words{"quit"})));
}

TEST(ConsoleCommands, ReportTheExpectedInputForEachMistake) {
  for (const Words& words : {Words{},
                             {""},
                             {"halt"},
                             {"record"},
                             {"record", "on"},
                             {"record", "start", "now"},
                             {"Stop"},
                             {"status", "now"},
                             {"resume", "0"},
                             {"resume", "-1"},
                             {"resume", "1", "2"},
                             {"resume", "4294967296"},
                             {"authority"},
                             {"authority", "a"},
                             {"authority", "=1"},
                             {"authority", "a=0.5"},
                             {"authority", "a=0.5,b=0.6"},
                             {"authority", "a=nan"},
                             {"authority", "a=-0.5,b=1.5"},
                             {"authority", "a=0.5,a=0.5"},
                             {"authority",
                              "a=1,"
                              "b"},
                             {"create"},
                             {"create", "exam"},
                             {"create", "an exam", "contact"},
                             {"create", "exam", "con tact"},
                             {"create", "exam", "contact", "desk-2"},
                             {"create", "exam", "contact", "a=b", "a=c"},
                             {"create", "exam", "contact", "time=0"},
                             {"create", "exam", "contact", "time=86401"},
                             {"create", "exam", "contact", "trainee="},
                             {"end"},
                             {"sessions", "all"},
                             {"note"},
                             {"note", "mark"},
                             {"note", "grade", "{}"},
                             {"note", "mark", std::string(rpc::kNoteMax + 1, 'x')},
                             {"authority", "a=1", "tools=x"},
                             {"authority", "a=1", "tool="},
                             {"authority", "a=1", "version=x"},
                             {"remove"},
                             {"drain", "3601"},
                             {"drain", "soon"},
                             {"drain", "1", "2"},
                             {"stop", std::string(481, 'x')}})
    EXPECT_FALSE(problem(words).empty()) << testing::PrintToString(words);
  EXPECT_NE(problem({"authority", "a=0.5,b=0.6"}).find("sum to 1.1; they must sum to 1"), std::string::npos);
}

TEST(ConsoleCommands, RequestTheLeastSufficientRole) {
  for (const Words& words : {Words{"status"}, {"stop"}, {"pause"}, {"resume"}, {"remove", "trainee"}, {"drain"}})
    EXPECT_EQ(role_for(*parse_command(words)), AccessRole::kOperator) << words.front();
  EXPECT_EQ(role_for(*parse_command(Words{"authority", "a=1"})), AccessRole::kInstructor);
}

TEST(ConsoleCommands, SetAuthorityAgainstTheStatusVersionShown) {
  const rpc::Status now = lesson();
  const auto frame = authority_frame(parsed<AuthorityCommand>({"authority", "trainee=1"}), now);
  ASSERT_TRUE(frame) << frame.error();
  EXPECT_EQ(*frame, (rpc::SetAuthority{now.session_id, 0, 7, {0, 1}}))
      << "in the order of the seats, who is not named gets nothing";
  EXPECT_EQ(
      authority_frame(parsed<AuthorityCommand>({"authority", "trainee=1", "version=5", "tool=drill"}), now)->version,
      5U);
  EXPECT_NE(
      authority_frame(parsed<AuthorityCommand>({"authority", "nosuch=1"}), now).error().find("seats: trainer, trainee"),
      std::string::npos);
  EXPECT_FALSE(authority_frame(parsed<AuthorityCommand>({"authority", "arm=1"}), now)) << "leads nothing";
  EXPECT_NE(authority_frame(parsed<AuthorityCommand>({"authority", "trainer=1", "tool=saw"}), now)
                .error()
                .find("tools: drill"),
            std::string::npos);
  rpc::Status two = now;
  two.tools.push_back({"saw", {1, 0}});
  EXPECT_NE(
      authority_frame(parsed<AuthorityCommand>({"authority", "trainer=1"}), two).error().find("tool=NAME is missing"),
      std::string::npos);
  EXPECT_EQ(authority_frame(parsed<AuthorityCommand>({"authority", "trainer=1", "tool=saw"}), two)->tool, 1U);
}

TEST(ConsoleCommands, OfferAuthorityToNoEvaluatorOrObserver) {
  rpc::Status now = lesson();
  now.seats.push_back({"jury", AccessRole::kEvaluator, true, true, true});
  now.tools = {{"drill", {0.25, 0.75, 0}}};
  const auto refused = authority_frame(parsed<AuthorityCommand>({"authority", "jury=1"}), now);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), "authority: no seat \"jury\" that can have authority; seats: trainer, trainee");
  const auto none = authority_frame(parsed<AuthorityCommand>({"authority", "trainee=1,jury=0"}), now);
  ASSERT_TRUE(none) << none.error();
  EXPECT_EQ(none->alpha, (std::vector<double>{0, 1, 0})) << "every master has its place";
}

TEST(ConsoleCommands, NameTheConsoleThatMovesAuthority) {
  EXPECT_NE(refusal_hint(rpc::SetAuthority{}, AccessRole::kOperator).find("--role instructor"), std::string::npos);
  EXPECT_NE(refusal_hint(rpc::SetAuthority{}, AccessRole::kRecorder).find("--role instructor"), std::string::npos);
  EXPECT_EQ(refusal_hint(rpc::SetAuthority{}, AccessRole::kInstructor), "") << "the server's text names the reason";
  EXPECT_EQ(refusal_hint(rpc::StopSession{}, AccessRole::kRecorder), "");
}

TEST(ConsoleCommands, FormatAStatusAsTextAndAsJson) {
  EXPECT_EQ(status_text(lesson()),
            "lesson: stopped, 12.3 s; `resume 3` ends it; authority version 7\n"
            "  STOPPED by desk (operator at a console): fire drill. It can be ended by: an operator. You may end it\n"
            "  seat trainer          instructor here\n"
            "  seat trainee          trainee    SILENT\n"
            "  seat arm              observer   free\n"
            "  tool drill            trainer 0.25, trainee 0.75\n");
  EXPECT_EQ(status_json(lesson()),
            "{\"session\": \"lesson\", \"id\": \"ab000000000000000000000000000000\", \"phase\": \"stopped\", "
            "\"time_s\": 12.340, \"stops\": 3, \"authority_version\": 7, "
            "\"draining\": false, \"shed\": 0, \"seats\": [{\"name\": \"trainer\", \"role\": \"instructor\", "
            "\"taken\": true, \"heard\": true, \"person\": null}, {\"name\": \"trainee\", \"role\": \"trainee\", "
            "\"taken\": true, \"heard\": false, \"person\": null}, {\"name\": \"arm\", \"role\": \"observer\", "
            "\"taken\": false, "
            "\"heard\": false, \"person\": null}], \"tools\": [{\"name\": \"drill\", "
            "\"alpha\": {\"trainer\": 0.25, \"trainee\": 0.75}}], \"stop\": {\"number\": 3, \"kind\": \"stop\", "
            "\"seat\": \"\", \"workstation\": \"desk\", \"role\": \"operator\", "
            "\"why\": \"fire drill\", \"ago_s\": 2.500, \"ends\": \"an operator\", \"yours\": true, \"person\": null}, "
            "\"drain\": null, "
            "\"held\": null, \"counts\": null, \"not_stored\": null, \"recording\": null}\n");
  rpc::Status named = lesson();
  named.seats[0].person = "ann";
  named.stop->person = "otto";
  EXPECT_NE(status_json(named).find("\"heard\": true, \"person\": \"ann\""), std::string::npos);
  EXPECT_NE(status_json(named).find("\"yours\": true, \"person\": \"otto\""), std::string::npos);
  EXPECT_NE(status_text(named).find("here, ann\n"), std::string::npos) << status_text(named);
  EXPECT_NE(status_text(named).find("STOPPED by otto at desk"), std::string::npos) << status_text(named);
}

TEST(ConsoleCommands, TellWhyTheSessionIsNotStored) {
  rpc::Status s = lesson();
  s.not_stored = "the disk is \"full\"; free some space there";
  EXPECT_NE(status_text(s).find(
                "  NOT STORED: the disk is \"full\"; free some space there; a kill of the server undoes a stop\n"),
            std::string::npos)
      << status_text(s);
  EXPECT_NE(status_json(s).find("\"not_stored\": \"the disk is \\\"full\\\"; free some space there\""),
            std::string::npos)
      << status_json(s);
}

TEST(ConsoleCommands, TellStopsRestartsAndMovesApart) {
  rpc::Status s = lesson();
  s.counts = rpc::StatusCounts{1, 0, 2};
  EXPECT_NE(status_text(s).find("`resume 3` ends it; 1 stop, 0 restarts and 2 moves so far;"), std::string::npos)
      << status_text(s);
  EXPECT_NE(status_json(s).find("\"counts\": {\"stops\": 1, \"restarts\": 0, \"moves\": 2}"), std::string::npos);
  s.phase = rpc::SessionPhase::kRunning;
  EXPECT_NE(status_text(s).find("12.3 s; 1 stop, 0 restarts and 2 moves so far;"), std::string::npos);
  s.counts.reset();
  EXPECT_NE(status_text(s).find("; 3 stops, restarts and moves so far;"), std::string::npos) << "an older server";
}

TEST(ConsoleCommands, ReportThatTheSessionIsHeldAndHeldNoLonger) {
  rpc::Status runs = lesson();
  runs.phase = rpc::SessionPhase::kRunning;
  rpc::Status held = runs;
  held.phase = rpc::SessionPhase::kHeld;
  held.held = "the directory of the service does not answer";
  EXPECT_EQ(status_changes_text(runs, held), "HELD: the directory of the service does not answer\n");
  EXPECT_EQ(status_changes_text(held, held), "");
  EXPECT_EQ(status_changes_text(held, runs), "the session is held no longer: it is running\n");
}

TEST(ConsoleCommands, ReportEventsOnceAndOnlyThoseAfterTheFirstStatus) {
  rpc::Status first = lesson();
  first.events = {{1, "stop 2 is over: RESUMED by trainer"}};
  EXPECT_EQ(status_changes_text(rpc::Status{}, first).find("RESUMED"), std::string::npos) << "of the time before";
  rpc::Status next = first;
  next.phase = rpc::SessionPhase::kRunning;
  next.events.push_back({2, "stop 3 is over: RESUMED by desk; force returns over 0.5 s"});
  next.events.push_back({3, "trainee is REMOVED by desk\x1b[2J"});
  EXPECT_EQ(status_changes_text(first, next),
            "stop 3 is over: RESUMED by desk; force returns over 0.5 s\ntrainee is REMOVED by desk\\x1b[2J\n");
  EXPECT_EQ(status_changes_text(next, next), "");
  rpc::Status nameless = next;
  nameless.events = first.events;
  EXPECT_EQ(status_changes_text(first, nameless), "stop 3 is over: the session is running\n")
      << "a server that does not know by whom";
  next.held = "trainer left";
  EXPECT_NE(status_text(next).find("BRAKED: trainer left"), std::string::npos);
}

// Text from another console or from a malicious server is sanitised: it contains no control sequences for the terminal
// and cannot imitate other output.
TEST(ConsoleCommands, SanitiseTextFromOtherParticipants) {
  rpc::Status s = lesson();
  s.stop->why =
      "\x1b[2Jgone\r\n\x07 \xe2\x80\xae"
      "evil \xc2\x9b \xff \xc3\xa4";
  EXPECT_EQ(stop_text(s),
            "STOPPED by desk (operator at a console): \\x1b[2Jgone\\x0d\\x0a\\x07 \\u202eevil \\u009b \\xff \xc3\xa4. "
            "It can be ended by: an operator. You may end it");
  s.stop->why = std::string(600, 'x');
  EXPECT_NE(stop_text(s).find(std::string(480, 'x') + ".... It can"), std::string::npos) << stop_text(s);
  s.stop->why = "a \"b\" \\";
  EXPECT_NE(status_json(s).find("\"why\": \"a \\\"b\\\" \\\\\""), std::string::npos) << status_json(s);
  s.stop->kind = rpc::StopKind::kFault;
  s.stop->workstation = s.stop->why = "";
  s.stop->yours = false;
  EXPECT_EQ(stop_text(s),
            "STOPPED by the session itself: its numbers could not be trusted. It can be ended by: an operator");
}

TEST(ConsoleCommands, ReportNoResumeWhenTheSessionEnds) {
  rpc::Status before = lesson(), now = lesson();
  now.phase = rpc::SessionPhase::kEnding;
  EXPECT_EQ(status_changes_text(before, now), "");
}

/// A server that ends at once reports a drain with 0 s left, which is not shown.
TEST(ConsoleCommands, ReportNoDrainWithoutRemainingTime) {
  rpc::Status before = lesson(), now = lesson();
  now.drain = rpc::StatusDrain{0, 1, 1};
  EXPECT_EQ(status_changes_text(before, now), "");
  now.drain = rpc::StatusDrain{3, 1, 1};
  EXPECT_EQ(status_changes_text(before, now), "DRAINING: 3 s left, 1 session, 1 participant on a seat\n");
}

TEST(ConsoleCommands, ReportEachStatusChangeOnce) {
  rpc::Status before = lesson(), now = lesson();
  EXPECT_EQ(status_changes_text(before, now), "");
  now.stops = now.stop->number = 4;
  EXPECT_EQ(status_changes_text(before, now), stop_text(now) + "\n");
  EXPECT_EQ(status_changes_text({}, before), stop_text(before) + "\n")
      << "a participant who joins during the stop reads it too";
  rpc::Status over = now;
  over.phase = rpc::SessionPhase::kRunning;
  EXPECT_EQ(status_changes_text(now, over), "stop 4 is over: the session is running\n");
  now = before = over;
  std::string text;
  for (std::uint32_t left = 33; left-- > 0; before = now) {
    now.drain = {left, 2, 3};
    text += status_changes_text(before, now);
  }
  EXPECT_EQ(text,
            "DRAINING: 32 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 29 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 19 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 9 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 5 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 4 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 3 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 2 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 1 s left, 2 sessions, 3 participants on their seats\n"
            "DRAINING: 0 s left, 2 sessions, 3 participants on their seats\n");
}

TEST(ConsoleCommands, TellWhoRecordsAndWhatIsMissing) {
  rpc::Status before, now;
  before.name = now.name = "lab";
  EXPECT_EQ(status_changes_text(before, now), "");
  EXPECT_NE(status_json(now).find("\"recording\": null"), std::string::npos);
  now.recording = rpc::StatusRecording{.by_server = true, .by_recorders = 2, .pseudonyms = true};
  EXPECT_EQ(status_changes_text(before, now), "RECORDED by the server, without names, and 2 recorders\n");
  EXPECT_NE(status_text(now).find("RECORDED by the server"), std::string::npos);
  before = now;
  now.recording->dropped = 7;
  EXPECT_EQ(status_changes_text(before, now), "") << "a counter alone is no news";
  now.recording->trouble = "the disk is full";
  EXPECT_NE(status_changes_text(before, now).find("7 ticks dropped so far; ticks are dropped now: the disk is full"),
            std::string::npos);
  EXPECT_NE(status_json(now).find("\"dropped_ticks\":7,\"trouble\":\"the disk is full\""), std::string::npos)
      << status_json(now);
  before = now;
  now.recording = rpc::StatusRecording{.by_recorders = 1};
  EXPECT_EQ(status_changes_text(before, now), "RECORDED by 1 recorder\n");
  now.recording.reset();
  EXPECT_EQ(status_changes_text(before, now), "the session is no longer recorded\n");
}

}  // namespace
}  // namespace tandem::client
