// Sessions that an operator creates and ends while the server runs: real programs on loopback.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/io/multi_client_fixture.h"

namespace tandem::test {
namespace {

Process control(const std::string& address, const Words& command, const Words& options = {}) {
  Words words{TANDEM_CLIENT, "control", "--server", address};
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), command.begin(), command.end());
  return Process(std::move(words));
}

const Words kLesson{"--session", "lesson"};

TEST(CreatedSessions, AreJoinedWatchedEndedAndCreatedAgain) {
  const Folder folder;
  Process host = serving(folder.write("s.textproto",
                                      "version: 1 listen: \"127.0.0.1:0\" limits { created_sessions: 1 }\n"
                                      "session { name: \"lesson\" scene: \"one_axis\" }\n"));
  const std::string address = address_of(host);
  ASSERT_FALSE(address.empty()) << host.err();
  for (int round = 0; round < 2; ++round) {
    SCOPED_TRACE(round);
    Process create = control(address, {"create", "exam", "free_motion"}, kLesson);
    ASSERT_EQ(create.wait(), 0) << create.err();
    EXPECT_NE(create.out().find("created exam: "), std::string::npos) << create.out();
    EXPECT_NE(create.out().find("seat trainee"), std::string::npos) << create.out();

    Process trainer = client(address, "trainer", {"--session", "exam"}),
            trainee = client(address, "trainee", {"--session", "exam"});
    ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
    ASSERT_TRUE(trainee.wait_for("the session runs")) << trainee.err();
    Process watch({TANDEM_CLIENT, "watch", "--server", address, "--session", "exam"});
    EXPECT_TRUE(watch.wait_for("trainer")) << watch.out() << watch.err();
    Process full = control(address, {"create", "more", "contact"}, kLesson);
    EXPECT_EQ(full.wait(), 1);
    EXPECT_NE(full.err().find("this server allows 1"), std::string::npos) << full.err();

    Process list = control(address, {"sessions"}, kLesson);
    EXPECT_EQ(list.wait(), 0) << list.err();
    EXPECT_NE(list.out().find("exam: "), std::string::npos) << list.out();

    Process end = control(address, {"end", "exam", "the", "lesson", "is", "over"}, kLesson);
    EXPECT_EQ(end.wait(), 0) << end.err();
    EXPECT_EQ(trainer.wait(), 0) << trainer.err();
    EXPECT_EQ(trainee.wait(), 0) << trainee.err();
    EXPECT_NE(trainee.err().find("the server ended the session"), std::string::npos) << trainee.err();
    EXPECT_TRUE(watch.wait()) << "a watching console ends with its session";
    EXPECT_TRUE(host.wait_for("exam: ENDED by local (operator): the lesson is over")) << host.err();
    Process gone = client(address, "trainer", {"--session", "exam"});
    EXPECT_EQ(gone.wait(), 1);
  }
  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST(CreatedSessions, AreRejectedForOtherRolesAndForMistakes) {
  const Folder folder;
  const std::string bad = folder.write("bad.textproto", "version: 1\nsaet {}\n");
  Process host = hosting("one_axis");
  const std::string address = address_of(host);
  for (const std::string role : {"instructor", "recorder"})
    for (const Words& command : {Words{"create", "exam", "contact"}, Words{"end", "one_axis"}}) {
      Process refused = control(address, command, {"--role", role});
      EXPECT_EQ(refused.wait(), 1) << refused.out();
      EXPECT_NE(refused.err().find("the role " + role + " may not "), std::string::npos) << refused.err();
      EXPECT_NE(refused.err().find("permitted for: operator"), std::string::npos) << refused.err();
    }
  Process unknown = control(address, {"create", "exam", "contakt"});
  EXPECT_EQ(unknown.wait(), 1);
  EXPECT_NE(unknown.err().find("did you mean contact?"), std::string::npos) << unknown.err();
  Process mistake = control(address, {"create", "exam", bad});
  EXPECT_EQ(mistake.wait(), 2);
  EXPECT_NE(mistake.err().find("bad.textproto:2:1"), std::string::npos) << mistake.err();
  Process nowhere = control(address, {"end", "exam"});
  EXPECT_EQ(nowhere.wait(), 1);
  EXPECT_NE(nowhere.err().find("no session \"exam\" is open"), std::string::npos) << nowhere.err();
  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
}

/// The reply of `create` has a ticket per named seat; `tandem-server ticket` writes further ones. Marks and sheets are
/// stored with their author.
/// Creates a session, and joins it by the printed command, with the printed ticket in its file. @return that command
std::string copied_join(const MultiClientFixture& f, const Words& order) {
  Process made =
      server({"ticket", "--session", "lesson", "--role", "operator", "--workstation", "desk", "--state", f.state});
  EXPECT_EQ(made.wait(), 0) << made.err();
  Process create = control(f.address, order, {"--state", f.own, "--ticket", "  " + first_line(made.out()) + " "});
  EXPECT_EQ(create.wait(), 0) << create.err();
  const std::string begin = "join: `", printed = create.after(begin);
  const std::string command = printed.substr(0, printed.find('`'));
  EXPECT_TRUE(command.starts_with("tandem-client join ")) << create.out();
  std::string run = "'" + std::string(TANDEM_CLIENT) + "'" + command.substr(13);
  if (const auto file = run.find("FILE"); file != std::string::npos) {
    const auto ticket = create.out().find("ticket:");
    f.folder.write("FILE", "   " + create.out().substr(ticket, create.out().find('\n', ticket) - ticket) + "  \n");
    run.replace(file, 4, f.folder.file("FILE"));
  }
  Process joined({"/bin/sh", "-c", "exec " + run});
  EXPECT_TRUE(joined.wait_for("seat trainee at")) << command << joined.err();
  return command;
}

TEST(CreatedSessions, HaveTicketsAndNotes) {
  const MultiClientFixture f("reports: \".\" scenes: \".\" session { name: \"lesson\" scene: \"one_axis\" }");
  const auto as_operator = [&](const std::string& session, const Words& command) {
    Process made =
        server({"ticket", "--session", session, "--role", "operator", "--workstation", "desk", "--state", f.state});
    EXPECT_EQ(made.wait(), 0) << made.err();
    return control(f.address, command, {"--state", f.own, "--json", "--ticket", first_line(made.out())});
  };
  const std::string other = copied_join(f, {"create", "by-code", "free_motion"});
  EXPECT_EQ(other.find("--ticket-file"), std::string::npos) << other;
  EXPECT_NE(copied_join(f, {"create", "invited", "free_motion", "trainee=desk", "tickets"}).find("--ticket-file FILE"),
            std::string::npos);
  Process create = as_operator("lesson", {"create", "exam", "free_motion", "trainee=desk", "tickets"});
  ASSERT_EQ(create.wait(), 0) << create.err();
  const Json made = Json::parse(create.out(), nullptr, false);
  ASSERT_EQ(made["tickets"].size(), 1U) << create.out();
  EXPECT_TRUE(made["code"].is_null()) << "tickets only";
  Process trainee =
      client(f.address, "trainee", {"--session", "exam", "--state", f.own, "--ticket", made["tickets"][0]["ticket"]});
  ASSERT_TRUE(trainee.wait_for("seat trainee at")) << trainee.err();
  Process unknown = as_operator("lesson", {"create", "more", "free_motion", "trainee=nowhere"});
  EXPECT_EQ(unknown.wait(), 1);
  EXPECT_NE(unknown.err().find("no workstation nowhere is enrolled"), std::string::npos) << unknown.err();

  Process note = as_operator(made["id"], {"note", "mark", "{\"text\": \"good grip\"}"});
  EXPECT_EQ(note.wait(), 0) << note.err();
  bool found = false;
  for (const auto& entry : std::filesystem::directory_iterator(f.folder.file("."))) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("exam-") || !name.ends_with(".notes.jsonl")) continue;
    const Json line = f.folder.json(name);
    EXPECT_EQ(line["workstation"], "desk");
    EXPECT_EQ(line["role"], "operator");
    EXPECT_EQ(line["note"]["text"], "good grip");
    found = true;
  }
  EXPECT_TRUE(found) << "no file of notes";
  Process end = as_operator("lesson", {"end", "exam"});
  EXPECT_EQ(end.wait(), 0) << end.err();
  EXPECT_TRUE(trainee.wait());
  EXPECT_NE(trainee.err().find("the server ended the session"), std::string::npos) << trainee.err();
  const std::string audit = f.folder.read("state/audit.log");
  for (const char* line :
       {"\"event\":\"create\",\"name\":\"exam\",\"detail\":\"desk (operator): scene free_motion, 2 seats",
        "\"event\":\"note\",\"name\":\"exam\",\"detail\":\"desk (operator) mark, 21 bytes",
        "\"event\":\"end\",\"name\":\"exam\",\"detail\":\"desk (operator)"})
    EXPECT_NE(audit.find(line), std::string::npos) << line << "\n" << audit;
}

}  // namespace
}  // namespace tandem::test
