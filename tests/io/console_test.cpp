// Consoles that operate sessions without a seat: real programs on loopback. States, commands and messages are
// asserted, never durations.
#include <gtest/gtest.h>
#include <signal.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "tests/io/multi_client_fixture.h"
#include "tests/support/terminal.h"

namespace tandem::test {
namespace {

/// Runs `tandem-client control` on the server's own computer.
Process control(const std::string& address, Words words) {
  words.insert(words.begin(), {TANDEM_CLIENT, "control", "--server", address});
  return Process(std::move(words));
}
/// Runs a console with these input lines.
Process console(const std::string& lines, const Words& arguments) {
  std::string command = "printf '" + lines + "' | '" + std::string(TANDEM_CLIENT) + "' control";
  for (const std::string& a : arguments) command += " '" + a + "'";
  return Process({"/bin/sh", "-c", command});
}

/// Phases of a hand from its client's trace. A: the gate is active; -: the gate passes no effort for a while.
std::string phases_of(const std::string& trace) {
  std::istringstream lines(trace);
  std::string header, line, phases;
  std::getline(lines, header);
  std::vector<std::size_t> gate_force;
  std::size_t gate = 0, column = 0;
  std::istringstream names(header);
  for (std::string name; std::getline(names, name, ','); ++column) {
    if (name.starts_with("f_out")) gate_force.push_back(column);
    if (name.starts_with("gate[")) gate = column;
  }
  while (std::getline(lines, line)) {
    std::vector<double> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(std::atof(cell.c_str()));
    if (cells.size() <= gate) continue;
    double force = 0;
    for (const std::size_t c : gate_force) force = std::max(force, std::abs(cells[c]));
    const char now = cells[gate] == 3 ? 'A' : force < 1e-3 ? '-' : 0;
    if (now != 0 && (phases.empty() || phases.back() != now)) phases += now;
  }
  return phases;
}

TEST(Control, AnOperatorStopsARunningSessionAndOnlyTheNewestStopIsEnded) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer", {"--trace", folder.file("trainer.csv")}),
          trainee = client(address, "trainee", {"--trace", folder.file("trainee.csv")});
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  const auto both_show = [&](const char* phases) {
    for (int tries = 0; tries < 150; ++tries, std::this_thread::sleep_for(std::chrono::milliseconds(200)))
      if (phases_of(folder.read("trainer.csv")).find(phases) != std::string::npos &&
          phases_of(folder.read("trainee.csv")).find(phases) != std::string::npos)
        return true;
    return false;
  };
  ASSERT_TRUE(both_show("A")) << "the session runs while hands still ramp in";
  Process early = control(address, {"resume"});
  EXPECT_EQ(early.wait(), 1);
  EXPECT_NE(early.err().find("nothing is stopped"), std::string::npos) << early.err();

  Process stop = control(address, {"stop", "someone", "is", "in", "the", "way"});
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  EXPECT_NE(stop.out().find("STOPPED: all hands are released; `resume 1` ends it"), std::string::npos) << stop.out();
  EXPECT_TRUE(host.wait_for("STOPPED")) << host.err();
  EXPECT_TRUE(trainer.wait_for("STOPPED") && trainee.wait_for("STOPPED")) << "the clients show it\n" << trainer.err();
  Process again = control(address, {"stop"});
  EXPECT_EQ(again.wait(), 0) << again.err();
  Process old = control(address, {"resume", "1"});
  EXPECT_EQ(old.wait(), 1) << old.out();
  EXPECT_NE(old.err().find("stop 1 is not the newest: stop 2 followed"), std::string::npos) << old.err();
  Process status = control(address, {"status", "--json"});
  EXPECT_EQ(status.wait(), 0) << status.err();
  const Json now = Json::parse(status.out(), nullptr, false);
  ASSERT_TRUE(now.is_object()) << status.out();
  EXPECT_EQ(now["phase"], "stopped");
  EXPECT_EQ(now["stops"], 2);
  EXPECT_TRUE(now["seats"][0]["heard"]);

  Process resume = control(address, {"resume", "2"});
  EXPECT_EQ(resume.wait(), 0) << resume.err();
  ASSERT_TRUE(host.wait_for("RESUMED")) << host.err();
  EXPECT_TRUE(both_show("A-A")) << "active, released, active again; " << phases_of(folder.read("trainer.csv")) << ' '
                                << phases_of(folder.read("trainee.csv"));

  Process drain = control(address, {"drain"});
  EXPECT_EQ(drain.wait(), 0) << drain.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_NE(host.err().find("ended by a drain command"), std::string::npos) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_NE(trainer.err().find("the server ended the session"), std::string::npos) << trainer.err();
}

TEST(Control, RejectsInvalidCommandsWithTheAllowedValues) {
  const auto wrong = [](Words words, const char* text) {
    Process p = control("127.0.0.1:9", std::move(words));
    EXPECT_EQ(p.wait(), 2) << p.out();
    EXPECT_NE(p.err().find(text), std::string::npos) << p.err();
  };
  wrong({"halt"}, "commands: status, stop, pause, resume, authority, remove, drain");
  wrong({"resume", "now"}, "must be the number of a stop");
  wrong({"authority", "trainer=0.4"}, "sum to 0.4; they must sum to 1");
  wrong({"authority", "trainer=2"}, "authority in [0, 1]");
  wrong({"drain", "3601"}, "[0, 3600]");
  wrong({"--role", "trainee", "status"}, "must be operator, instructor, evaluator or recorder");
  Process nobody = control("127.0.0.1:9", {"--timeout", "0.2", "status"});
  EXPECT_EQ(nobody.wait(), 1);
  EXPECT_NE(nobody.err().find("no server at 127.0.0.1:9"), std::string::npos) << nobody.err();
}

/// The hint is a command that an operator copies: it has the options of this console.
TEST(Control, NamesTheCommandThatResumesAndTheNumberOfTheStop) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process stop = console("stop danger\\nstatus\\nresume soon\\nresume 0\\n", {"--server", address});
  EXPECT_EQ(stop.wait(), 2);
  for (const std::string& words :
       {std::string("STOPPED: all hands are released; `resume 1` ends it\n"),
        "It can be ended by: an instructor (key r) or an operator (`tandem-client control --server " + address +
            " --session free_motion resume`)"})
    EXPECT_NE(stop.out().find(words), std::string::npos) << words << " not in " << stop.out();
  for (const char* word : {"soon", "0"})
    EXPECT_NE(
        stop.err().find("resume: \"" + std::string(word) + "\" must be the number of a stop, as `status` shows it"),
        std::string::npos)
        << stop.err();
  Process status = control(address, {"status"});
  EXPECT_EQ(status.wait(), 0) << status.err();
  EXPECT_NE(status.out().find("; `resume 1` ends it"), std::string::npos) << "no mistake resumed it: " << status.out();
}

TEST(Control, AcceptsExactlyOneOfTwoInstructorsChanges) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  const auto version = [&] {
    Process asked = control(address, {"--json", "status"});
    EXPECT_EQ(asked.wait(), 0) << asked.err();
    return Json::parse(asked.out(), nullptr, false)["authority_version"].get<int>();
  };
  const int before = version();
  const std::string seen = "version=" + std::to_string(before);
  Process one = control(address, {"authority", "trainer=0.25,trainee=0.75", seen}),
          two = control(address, {"authority", "trainer=0.75,trainee=0.25", seen});
  const auto first = one.wait(), second = two.wait();
  EXPECT_TRUE((first == 0 && second == 1) || (first == 1 && second == 0))
      << *first << *second << one.err() << two.err();
  EXPECT_EQ(version(), before + 1);
  Process& loser = first == 0 ? two : one;
  EXPECT_NE(loser.err().find("another change came first. In force: authority over tool, version " +
                             std::to_string(before + 1)),
            std::string::npos)
      << loser.err();
  EXPECT_NE(loser.err().find(first == 0 ? "trainer 0.25, trainee 0.75" : "trainer 0.75, trainee 0.25"),
            std::string::npos)
      << loser.err();
  Process stranger = control(address, {"authority", "trainer=0.5,absent=0.5"});
  EXPECT_EQ(stranger.wait(), 2);
  EXPECT_NE(stranger.err().find("no seat \"absent\" that can have authority; seats: trainer, trainee"),
            std::string::npos)
      << stranger.err();
}

/// The terminal itself would keep `stop ` out of sight behind the notice, and make it `stop status` with the next
/// order.
TEST(Control, ShowsTheBeginOfALineAgainBehindANotice) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  TerminalProcess console({TANDEM_CLIENT, "control", "--server", address}, 100, 30);
  ASSERT_TRUE(console.wait_for("free_motion (operator)>")) << console.picture();
  console.type("stop dangex\x7fr");
  const auto last_is = [](const std::string& text) {
    return [text](const Terminal& terminal) { return !terminal.screen().empty() && terminal.screen().back() == text; };
  };
  EXPECT_TRUE(console.wait_until(last_is("free_motion (operator)> stop danger"))) << console.picture();
  Process pause = control(address, {"pause", "for", "lunch"});
  EXPECT_EQ(pause.wait(), 0) << pause.err();
  ASSERT_TRUE(console.wait_for("lunch")) << console.picture();
  EXPECT_TRUE(console.wait_until(last_is("free_motion (operator)> stop danger"))) << console.picture();
  console.type("\x15status\n");
  ASSERT_TRUE(console.wait_for("1 stop,")) << console.picture();
  console.type("stop smoke\n");
  ASSERT_TRUE(console.wait_for("STOPPED: all hands")) << console.picture();
  console.type("\x04");
  EXPECT_EQ(console.wait(), 0) << console.picture();
}

// A console whose server is gone must end, so that no operator relies on it to stop the session.
TEST(Control, EndsAtOnceWhenTheServerIsGone) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const Folder folder;
  const std::string pipe = folder.file("pipe");  // the console itself holds both ends open, so its input never ends
  Process waiting({"/bin/bash", "-c",
                   "mkfifo " + pipe + " && exec 3<>" + pipe + " && printf 'stauts\\nstatus\\n' >&3 && exec " +
                       TANDEM_CLIENT + " control --server " + address_of(host) + " <&3"});
  ASSERT_TRUE(waiting.wait_for("free_motion: waiting")) << waiting.err();
  host.signal(SIGKILL);
  EXPECT_TRUE(waiting.wait_for("the server ended this connection")) << waiting.err();
  EXPECT_EQ(waiting.wait(), 1) << "not 2: the session was lost, whatever was typed wrong before";
  EXPECT_NE(waiting.err().find("start again"), std::string::npos) << waiting.err();
}

TEST(Control, RemovesAParticipantWhoseClientReportsIt) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  Process removed = control(address, {"remove", "trainee", "pushes"});
  EXPECT_EQ(removed.wait(), 0) << removed.err();
  EXPECT_EQ(trainee.wait(), 1) << trainee.err();
  EXPECT_NE(trainee.err().find("an instructor or operator removed this client"), std::string::npos) << trainee.err();
  EXPECT_TRUE(host.wait_for("trainee left"));
  Process again = control(address, {"remove", "trainee"});
  EXPECT_EQ(again.wait(), 1);
  EXPECT_NE(again.err().find("no client is on seat trainee"), std::string::npos) << again.err();
}

// ---- With keys, tickets and an audit log ----

/// Waits until the audit log contains it: session events are written several times per second.
bool written(const MultiClientFixture& fixture, const std::string& text) {
  for (int i = 0; i < 600; ++i) {
    if (fixture.folder.read("state/audit.log").find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

std::string operator_ticket(const MultiClientFixture& fixture, const std::string& role) {
  Process made =
      server({"ticket", "--session", "a", "--role", role, "--workstation", "desk", "--state", fixture.state});
  EXPECT_EQ(made.wait(), 0) << made.err();
  EXPECT_NE(made.err().find("tandem-client control --server " + fixture.address + " --ticket-file FILE"),
            std::string::npos)
      << made.err();
  return first_line(made.out());
}

TEST(MultiClientControl, AdmitsAnOperatorByASingleUseTicketAndAuditsEveryCommand) {
  const MultiClientFixture fixture{"session { name: \"a\" scene: \"free_motion\" }"};
  Process code = fixture.join("trainee", {"--session", fixture.code()});
  ASSERT_TRUE(fixture.host.id() != 0);
  Process without = control(fixture.address, {"--state", fixture.own, "stop"});
  EXPECT_EQ(without.wait(), 1);
  EXPECT_NE(without.err().find("tandem-server ticket --state " + fixture.state +
                               " --session a --role operator --workstation desk"),
            std::string::npos)
      << without.err();
  const std::string file = fixture.folder.write("operator.ticket", operator_ticket(fixture, "operator") + "\n");
  Process shift =
      console("status\\nstop fire drill\\nresume 7\\nresume\\nremove trainee\\nauthority trainer=1\\nquit\\n",
              {"--server", fixture.address, "--state", fixture.own, "--ticket", file});
  EXPECT_EQ(shift.wait(), 1) << "two of them were refused\n" << shift.err();
  EXPECT_NE(shift.out().find("STOPPED"), std::string::npos) << shift.out();
  EXPECT_NE(shift.out().find("RESUMED: stop 1 is over"), std::string::npos) << shift.out();
  EXPECT_NE(shift.err().find("there is no stop 7"), std::string::npos) << shift.err();
  EXPECT_NE(shift.err().find("the role operator may not move authority; permitted for: instructor, trainee"),
            std::string::npos)
      << shift.err();
  EXPECT_NE(shift.err().find("join with an instructor's ticket"), std::string::npos) << shift.err();
  EXPECT_NE(shift.err().find("the ticket is used up"), std::string::npos) << shift.err();
  EXPECT_EQ(shift.out().find("the ticket is used up"), std::string::npos) << "scripts read the output";
  EXPECT_EQ(code.wait(), 1) << code.err();
  EXPECT_TRUE(written(fixture, "desk (operator) stop 1 tick 0: fire drill"));
  EXPECT_TRUE(written(fixture, "\"event\":\"resume\",\"name\":\"a\",\"detail\":\"desk (operator) stop 1 tick 0\""));
  EXPECT_TRUE(written(fixture, "\"event\":\"remove\",\"name\":\"a\",\"detail\":\"desk (operator) trainee tick 0\""));
  EXPECT_TRUE(written(fixture, "\"event\":\"removed\""));
  EXPECT_TRUE(written(fixture, "the role operator may not move authority"));
  Process used = control(fixture.address, {"--state", fixture.own, "--ticket", file, "status"});
  EXPECT_EQ(used.wait(), 1);
  EXPECT_NE(used.err().find("used already"), std::string::npos) << used.err();
  Process look =
      control(fixture.address, {"--state", fixture.own, "--ticket", operator_ticket(fixture, "operator"), "status"});
  EXPECT_EQ(look.wait(), 0) << look.err();
  EXPECT_NE(look.err().find("the ticket is used up"), std::string::npos) << "also by a query: " << look.err();
  Process recorder =
      control(fixture.address, {"--state", fixture.own, "--ticket", operator_ticket(fixture, "recorder"), "stop"});
  EXPECT_EQ(recorder.wait(), 1);
  EXPECT_NE(recorder.err().find("the role recorder may not stop the session"), std::string::npos) << recorder.err();
  Process seatless =
      server({"ticket", "--session", "a", "--role", "trainee", "--workstation", "desk", "--state", fixture.state});
  EXPECT_EQ(seatless.wait(), 0) << "a trainee without a seat may watch: " << seatless.err();
  EXPECT_NE(seatless.err().find("tandem-client watch --server "), std::string::npos) << seatless.err();
  Process watcher = control(fixture.address, {"--state", fixture.own, "--ticket", first_line(seatless.out()), "pause"});
  EXPECT_EQ(watcher.wait(), 1);
  EXPECT_NE(watcher.err().find("may pause the session from a seat only"), std::string::npos) << watcher.err();
  Process nameless = server({"ticket", "--session", "a", "--role", "operator", "--workstation", "desk", "--person",
                             "ann b", "--state", fixture.state});
  EXPECT_EQ(nameless.wait(), 2);
  EXPECT_NE(nameless.err().find("--person: \"ann b\" must be 1 to 32 characters of A-Z a-z 0-9 _ -"), std::string::npos)
      << nameless.err();
  Process seated = server({"ticket", "--session", "a", "--role", "operator", "--seat", "trainee", "--workstation",
                           "desk", "--state", fixture.state});
  EXPECT_EQ(seated.wait(), 2);
}

TEST(MultiClientControl, NamesTheFileOfATicketInTheCommandThatResumes) {
  const MultiClientFixture fixture{"session { name: \"a\" scene: \"free_motion\" }"};
  Process stop = console("pause\\nstatus\\n", {"--server", fixture.address, "--state", fixture.own, "--ticket",
                                               operator_ticket(fixture, "operator")});
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  EXPECT_NE(stop.out().find("`tandem-client control --server " + fixture.address + " --session a --state " +
                            fixture.own + " --ticket-file FILE resume`"),
            std::string::npos)
      << stop.out();
}

TEST(MultiClientControl, RemovesOnlyTheSeatOfARevokedWorkstation) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"free_motion\" duration_s: 600 }"};
  const std::string second = fixture.enrolled("desk-2");
  Process trainer = fixture.join("trainer", {"--ticket", fixture.ticket("a", "trainer")});
  Process trainee = client(fixture.address, "trainee", {"--session", fixture.code(), "--state", second});
  ASSERT_TRUE(fixture.host.wait_for("the session runs")) << fixture.host.err();
  Process visitor({TANDEM_CLIENT, "link-test", "--server", fixture.address, "--state", second, "--duration", "600"});
  ASSERT_TRUE(written(fixture, "\"event\":\"welcomed\",\"name\":\"desk-2\"")) << visitor.err();
  std::this_thread::sleep_for(std::chrono::seconds(1));  // meanwhile the server validates its address
  Process revoked = server({"revoke", "desk-2", "--state", fixture.state});
  EXPECT_EQ(revoked.wait(), 0) << revoked.err();
  EXPECT_EQ(trainee.wait(), 1) << trainee.err();
  EXPECT_NE(trainee.err().find("this workstation was revoked on the server"), std::string::npos) << trainee.err();
  EXPECT_TRUE(visitor.wait()) << "its link test ends too";
  EXPECT_TRUE(written(fixture, "\"event\":\"revoked_seat\",\"name\":\"desk-2\",\"detail\":\"a trainee tick"));
  Process status = control(
      fixture.address, {"--state", fixture.own, "--ticket", operator_ticket(fixture, "operator"), "--json", "status"});
  EXPECT_EQ(status.wait(), 0) << status.err();
  const Json now = Json::parse(status.out(), nullptr, false);
  ASSERT_TRUE(now.is_object()) << status.out();
  EXPECT_TRUE(now["seats"][0]["taken"]);
  EXPECT_FALSE(now["seats"][1]["taken"]);
  fixture.host.signal(SIGTERM);
  EXPECT_EQ(fixture.host.wait(), 0) << fixture.host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
}

}  // namespace
}  // namespace tandem::test
