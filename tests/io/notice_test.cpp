// Messages to users about stops, removals and a server that ends, and the commands they offer: real programs on
// loopback. Messages and states are asserted, never durations.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/io/multi_client_fixture.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

Process control(const std::string& address, Words words) {
  words.insert(words.begin(), {TANDEM_CLIENT, "control", "--server", address});
  return Process(std::move(words));
}
/// A console whose input stays open: it prints what it did not request.
Process waiting_console(const std::string& address, const Folder& folder) {
  const std::string pipe = folder.file("pipe");
  return Process({"/bin/bash", "-c",
                  "mkfifo " + pipe + " && exec 3<>" + pipe + " && exec " + TANDEM_CLIENT + " control --server " +
                      address + " <&3"});
}

TEST(Notice, NamesTheStoppingRoleAndReasonOnEveryScreen) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee"),
          console = waiting_console(address, folder);
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  Process stop = control(address, {"stop", "fire", "drill"});
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  const std::string words =
      "STOPPED by local (operator at a console): fire drill. It can be ended by: an instructor (key r) or an operator";
  EXPECT_TRUE(trainer.wait_for(words)) << trainer.err();
  EXPECT_TRUE(trainee.wait_for(words)) << trainee.err();
  EXPECT_TRUE(console.wait_for(words)) << console.out() << console.err();
  EXPECT_TRUE(host.wait_for("STOPPED by local (operator): fire drill")) << host.err();
  EXPECT_TRUE(trainer.wait_for("STOPPED by local (console): r resumes")) << trainer.err();
  EXPECT_TRUE(trainee.wait_for("STOPPED by local (console): an instructor or operator resumes")) << trainee.err();
  Process status = control(address, {"status"});
  EXPECT_EQ(status.wait(), 0) << status.err();
  EXPECT_NE(status.out().find(words), std::string::npos) << status.out();
  Process resume = control(address, {"resume"});
  EXPECT_EQ(resume.wait(), 0) << resume.err();
  EXPECT_TRUE(console.wait_for("stop 1 is over")) << console.out() << console.err();
  Process removed = control(address, {"remove", "trainee", "pushes", "the", "others"});
  EXPECT_EQ(removed.wait(), 0) << removed.err();
  EXPECT_EQ(trainee.wait(), 1) << trainee.err();
  EXPECT_NE(trainee.err().find("(removed by local (operator): pushes the others)"), std::string::npos) << trainee.err();
  console.signal(SIGINT);
  EXPECT_EQ(console.wait(), 0) << console.err();
}

TEST(Notice, ShowsTheProgressOfADrainAtConsoleAndServer) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  Process drain = control(address, {"drain", "4"});
  EXPECT_EQ(drain.wait(), 0) << drain.err();
  EXPECT_NE(drain.out().find("s left, 1 session, 2 participants on their seats"), std::string::npos) << drain.out();
  EXPECT_NE(drain.out().find("the server at " + address + " has ended"), std::string::npos) << drain.out();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_NE(host.err().find(
                "DRAINING: new joins are rejected, and all hands are released in 4 s; requested by local (operator)"),
            std::string::npos)
      << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
}

/// The console stays open after its command. It reports that the drain it requested is complete.
TEST(Notice, EndsTheConsoleThatOrderedADrainWithoutAnError) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string pipe = folder.file("pipe"), address = address_of(host);
  Process console({"/bin/bash", "-c",
                   "mkfifo " + pipe + " && exec 3<>" + pipe + " && echo drain 1 >&3 && exec " + TANDEM_CLIENT +
                       " control --server " + address + " <&3"});
  EXPECT_EQ(console.wait(), 0) << console.out() << console.err();
  EXPECT_NE(console.out().find("the server at " + address + " has ended: the drain is complete"), std::string::npos)
      << console.out() << console.err();
  EXPECT_EQ(console.err(), "");
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST(Notice, NamesTheMissingSeatOfASessionThatNeverBegan) {
  const Folder folder;
  Process host = hosting("free_motion", {"--json", folder.file("r.json")});
  Process trainer = client(address_of(host), "trainer");
  ASSERT_TRUE(host.wait_for("trainer joined")) << host.err();
  ASSERT_TRUE(host.wait_for("waiting for trainee (not joined)")) << host.err();
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_NE(host.out().find("never began: it waited for trainee (not joined)"), std::string::npos) << host.out();
  EXPECT_EQ(host.out().find("pass"), std::string::npos) << host.out();
  const Json report = folder.json("r.json");
  EXPECT_EQ(report["began"], false);
  EXPECT_EQ(report["waited_for"], "trainee (not joined)");
}

// ---- On the server's own computer ----

TEST(Stop, EndsTheServerOfAStateDirectoryAndReportsItsProgress) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"free_motion\" duration_s: 600 }"};
  Process trainer = fixture.join("trainer", {"--ticket", fixture.ticket("a", "trainer")}),
          trainee = fixture.join("trainee", {"--session", fixture.code(), "--reconnect-timeout", "0"});
  ASSERT_TRUE(fixture.host.wait_for("the session runs")) << fixture.host.err();
  for (int i = 0; i < 300; ++i) {  // its output is up to a second old
    Process status = server({"status", "--json", "--state", fixture.state});
    EXPECT_EQ(status.wait(), 0) << status.err();
    const Json now = Json::parse(status.out(), nullptr, false)["sessions"][0];
    if (now["phase"] == "running" && now["seats"][0]["taken"] && now["seats"][1]["taken"]) break;
    ASSERT_LT(i, 299) << status.out();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  Process wrong = server({"stop", "--grace", "soon", "--state", fixture.state});
  EXPECT_EQ(wrong.wait(), 2) << wrong.err();
  Process stop = server({"stop", "--grace", "2", "--state", fixture.state});
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  EXPECT_NE(stop.out().find("DRAINING: 2 s left, 1 session, 2 participants on their seats"), std::string::npos)
      << stop.out();
  EXPECT_NE(stop.out().find("the server has ended"), std::string::npos) << stop.out();
  EXPECT_EQ(fixture.host.wait(), 0) << fixture.host.err();
  EXPECT_NE(fixture.host.err().find("requested by `tandem-server stop` on this computer"), std::string::npos)
      << fixture.host.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  Process again = server({"stop", "--state", fixture.state});
  EXPECT_EQ(again.wait(), 1) << again.out();
  EXPECT_NE(again.err().find("no server runs from"), std::string::npos) << again.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
}

// ---- Tickets in files ----

TEST(TicketFile, IsReadByJoinAndControlAndItsErrorsAreReported) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"free_motion\" duration_s: 600 }"};
  const std::string first = fixture.folder.write("trainer.ticket", fixture.ticket("a", "trainer") + "\n"),
                    second = fixture.folder.write("trainee.ticket", fixture.ticket("a", "trainee") + "\r\n");
  Process trainer = fixture.join("trainer", {"--ticket", "@" + first}),
          trainee = fixture.join("trainee", {"--ticket-file", second});
  ASSERT_TRUE(fixture.host.wait_for("the session runs")) << trainer.err() << trainee.err();
  Process made =
      server({"ticket", "--session", "a", "--role", "operator", "--workstation", "desk", "--state", fixture.state});
  EXPECT_EQ(made.wait(), 0);
  const std::string third = fixture.folder.write("operator.ticket", made.out());
  Process refused = control(fixture.address, {"--state", fixture.own, "--ticket-file", third, "remove", "absent"});
  EXPECT_EQ(refused.wait(), 1) << refused.err();
  EXPECT_EQ(refused.err().find("used up"), std::string::npos) << "a refusal uses nothing up: " << refused.err();
  for (int i = 0; i < 100; ++i) {  // the ticket becomes valid again shortly after that connection has ended
    Process status = control(fixture.address, {"--state", fixture.own, "--ticket-file", third, "remove", "trainee"});
    if (status.wait() == 0) break;
    EXPECT_NE(status.err().find("used already"), std::string::npos) << status.err();
    ASSERT_LT(i, 99) << status.err();
  }
  Process used = control(fixture.address, {"--state", fixture.own, "--ticket-file", third, "status"});
  EXPECT_EQ(used.wait(), 1) << used.out();
  EXPECT_NE(used.err().find("used already"), std::string::npos) << used.err();
  const auto wrong = [&](Words words, const char* text) {
    Process p = fixture.join("trainee", std::move(words));
    EXPECT_EQ(p.wait(), 2) << p.err();
    EXPECT_NE(p.err().find(text), std::string::npos) << p.err();
  };
  wrong({"--ticket", "@none"}, "none cannot be read");
  wrong({"--ticket-file", first, "--ticket", "ticket:x"}, "cannot be combined with --ticket");
  wrong({"--ticket-file", fixture.folder.write("other", "hello\n")}, "its first line is no ticket");
}

// ---- State that a restart keeps ----

TEST(Removal, PersistsAfterARestart) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"free_motion\" duration_s: 600 }"};
  const std::string code = fixture.code();
  Process trainee = fixture.join("trainee", {"--session", code});
  ASSERT_TRUE(fixture.host.wait_for("trainee joined")) << trainee.err();
  Process made =
      server({"ticket", "--session", "a", "--role", "operator", "--workstation", "desk", "--state", fixture.state});
  EXPECT_EQ(made.wait(), 0);
  Process removed =
      control(fixture.address, {"--state", fixture.own, "--ticket", first_line(made.out()), "remove", "trainee"});
  EXPECT_EQ(removed.wait(), 0) << removed.err();
  EXPECT_EQ(trainee.wait(), 1) << trainee.err();
  for (int round = 0; round < 2; ++round) {
    fixture.host.signal(SIGTERM);
    EXPECT_EQ(fixture.host.wait(), 0) << fixture.host.err();
    fixture.host = serving(fixture.folder.file("s.textproto"));
    ASSERT_NE(fixture.host.err().find("RESTORED"), std::string::npos) << fixture.host.err();
    Process again = client(address_of(fixture.host), "trainee", {"--session", code, "--state", fixture.own});
    EXPECT_EQ(again.wait(), 1) << again.err();
    EXPECT_NE(again.err().find("was removed from the session; to join again, ask an operator for a ticket"),
              std::string::npos)
        << again.err();
  }
  Process own = server({"status", "--state", fixture.state});
  EXPECT_EQ(own.wait(), 0);
  EXPECT_EQ(fixture.code(), code);
}

// ---- Printed commands work as printed ----

TEST(PrintedCommands, WorkAsPrintedForAServerOnAllAddresses) {
  const Folder folder;
  const std::string state = folder.file("state");
  Process made = server({"init", "--state", state});
  ASSERT_EQ(made.wait(), 0) << made.err();
  Process first =
      server({"enroll", "first", "--state", state, "--address", "127.0.0.1:1"});  // a server on a network needs one
  ASSERT_EQ(first.wait(), 0) << first.err();
  Process host = serving(folder.write(
      "s.textproto", "version: 1 listen: \"0.0.0.0:0\" state: \"state\" session { name: \"a\" scene: \"lesson\" }"));
  const std::string out = host.out(), mark = "--server ";
  EXPECT_EQ(out.find(mark + "0.0.0.0"), std::string::npos) << out;
  EXPECT_NE(out.find("--seat instructor --device sim --ticket-file FILE\n"), std::string::npos)
      << out << "all users can see a ticket on a command line";
  EXPECT_EQ(out.find('#'), std::string::npos) << out << "not every shell takes comments";
  const auto at = out.find(mark);
  ASSERT_NE(at, std::string::npos) << out;
  const std::string address = out.substr(at + mark.size(), out.find(' ', at + mark.size()) - at - mark.size());
  Process given = server({"enroll", "desk", "--state", state, "--address", address});
  ASSERT_EQ(given.wait(), 0) << given.err();
  Process taken({TANDEM_CLIENT, "enroll", first_line(given.out()), "--state", folder.file("own")});
  EXPECT_EQ(taken.wait(), 0) << address << taken.err();
  Process ticket =
      server({"ticket", "--session", "a", "--seat", "instructor", "--workstation", "desk", "--state", state});
  EXPECT_EQ(ticket.wait(), 0);
  EXPECT_NE(ticket.err().find("join --server " + address + " --seat"), std::string::npos) << ticket.err();
}

/// The command after `mark` in a program's output, up to the closing backquote.
std::string command_in(const std::string& words, const std::string& mark) {
  const auto at = words.find(mark);
  if (at == std::string::npos) return "";
  const auto begin = words.find('`', at) + 1, end = words.find('`', begin);
  std::string command = words.substr(begin, end - begin);
  std::ranges::replace(command, '\n', ' ');
  return command;
}
/// Runs a printed command in a shell with FILE replaced. A server's screen does not know the reader's client
/// directory, so it is set in the environment.
Process typed(std::string command, const std::string& file, const std::string& own) {
  const auto at = command.find("FILE");
  if (at != std::string::npos) command.replace(at, 4, file);
  return Process({"/usr/bin/env", "TANDEM_CLIENT_STATE=" + own,
                  "PATH=" + fs::path(TANDEM_CLIENT).parent_path().string() + ":/usr/bin:/bin", "/bin/sh", "-c",
                  command});
}

// With tickets, a console needs one: the server rejects a command without it.
TEST(PrintedCommands, NameTheTicketFileToResumeAndWorkAsPrinted) {
  MultiClientFixture fixture{
      "session { name: \"a\" scene: \"free_motion\" duration_s: 600 } session { name: \"b\" scene: \"free_motion\" "
      "duration_s: 600 }"};
  const auto right = [&](const std::string& name) {
    Process made =
        server({"ticket", "--session", "a", "--role", "operator", "--workstation", "desk", "--state", fixture.state});
    EXPECT_EQ(made.wait(), 0) << made.err();
    return fixture.folder.write(name, made.out());
  };
  Process trainer = fixture.join(
      "trainer", {"--ticket-file", fixture.folder.write("trainer.ticket", fixture.ticket("a", "trainer") + "\n")});
  Process trainee = fixture.join(
      "trainee", {"--ticket-file", fixture.folder.write("trainee.ticket", fixture.ticket("a", "trainee") + "\n")});
  ASSERT_TRUE(fixture.host.wait_for("the session runs")) << trainer.err() << trainee.err();
  const std::string reach = "tandem-client control --server " + fixture.address + " --session a";
  const auto stop = [&](const std::string& number) {
    Process order = control(fixture.address,
                            {"--state", fixture.own, "--ticket-file", right("stop" + number), "stop", "fire", "drill"});
    EXPECT_EQ(order.wait(), 0) << order.err();
    EXPECT_TRUE(fixture.host.wait_for("fire drill")) << fixture.host.err();
  };
  stop("1");
  ASSERT_TRUE(trainee.wait_for("It can be ended by: an instructor (key r) or an operator (`")) << trainee.err();
  ASSERT_TRUE(trainee.wait_for(" resume`")) << trainee.err();
  const std::string seats = command_in(trainee.err(), "It can be ended by");
  EXPECT_EQ(seats, reach + " --state " + fixture.own + " --ticket-file FILE resume");
  Process first = typed(seats, right("first"), fixture.own);
  EXPECT_EQ(first.wait(), 0) << seats << first.err();
  ASSERT_TRUE(trainee.wait_for("stop 1 is over")) << trainee.err();
  stop("2");
  ASSERT_TRUE(trainee.wait_for("STOPPED by desk (console)")) << trainee.err();
  ASSERT_TRUE(fixture.host.wait_for("resume`")) << fixture.host.err();
  const std::string hosts = command_in(fixture.host.err(), "STOPPED by desk");
  EXPECT_EQ(hosts, reach + " --ticket-file FILE resume");
  Process second = typed(hosts, right("second"), fixture.own);
  EXPECT_EQ(second.wait(), 0) << hosts << second.err();
  EXPECT_TRUE(trainee.wait_for("stop 2 is over")) << trainee.err();
}

// ---- All errors of a configuration and its state directory, in one run ----

TEST(Check, ReportsSchemaAddressSceneAndStateDirectoryErrorsTogether) {
  const Folder folder;
  Process made = server({"init", "--state", folder.file("state")});
  EXPECT_EQ(made.wait(), 0) << made.err();
  fs::create_directory(folder.file("bare"));
  ASSERT_EQ(::chmod(folder.file("bare").c_str(), 0700), 0);
  const auto check = [&](const std::string& text, const std::vector<std::string>& mistakes) {
    Process p = server({"serve", folder.write("s.textproto", "version: 1 " + text), "--check"});
    EXPECT_EQ(p.wait(), mistakes.empty() ? 0 : 2) << p.err() << p.out();
    for (const std::string& mistake : mistakes)
      EXPECT_NE(p.err().find(mistake), std::string::npos) << mistake << "\n" << p.err();
  };
  const std::string session = " session { name: \"a\" scene: \"contact\" }";
  check("listen: \"127.0.0.1:0\" state: \"state\"" + session, {});
  check(
      "listen: \"192.0.2.1:7000\" state: \"nowhere\" limitz { } session { name: \"a\" scene: \"contakt\" duration_s: "
      "-1 }",
      {"limitz", "duration_s", "did you mean contact", "this computer cannot listen there", "nowhere cannot be opened",
       "tandem-server init", "5 mistakes"});
  check("listen: \"127.0.0.1:0\" state: \"bare\"" + session,
        {"server_key.pem is missing", "server_cert.pem is missing", "ticket_key is missing", "3 mistakes"});
  ASSERT_EQ(::chmod(folder.file("state/ticket_key").c_str(), 0644), 0);
  ASSERT_EQ(::chmod(folder.file("state/workstations.textproto").c_str(), 0640), 0);
  check(
      "listen: \"127.0.0.1:0\" state: \"state\"" + session,
      {"ticket_key can be read by others", "workstations.textproto can be read by others", "chmod 0600", "2 mistakes"});
  ASSERT_EQ(::chmod(folder.file("state").c_str(), 0755), 0);
  check("listen: \"127.0.0.1:0\" state: \"state\"" + session,
        {"can be entered by others (mode 0755)", "chmod 0700", "1 mistake"});
}

}  // namespace
}  // namespace tandem::test
