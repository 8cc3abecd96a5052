// Consoles of a session follow it to another server of their service, with the ticket that they have.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/io/service_fixture.h"
#include "tests/support/terminal.h"

namespace tandem::test {
namespace {

class ServiceConsole : public ::testing::Test {
 protected:
  void SetUp() override {
    if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
    service_.emplace("session { name: \"lab\" scene: \"free_motion\" }");
    service_->start("a");
    service_->wait_for_sessions("a", 1);
    Process& b = service_->start("b");
    ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
    const std::string own = service_->enrolled("desk");
    const std::string ticket = service_->folder().write(
        "operator.ticket",
        first_line(LiveService::run({"ticket", "--session", "lab", "--role", "operator", "--workstation", "desk",
                                     "--state", service_->folder().file("a")})));
    connection_ = {"--server",      address_of(service_->of("a")) + "," + address_of(b),
                   "--session",     "lab",
                   "--state",       own,
                   "--ticket-file", ticket};
  }

  std::optional<LiveService> service_;  ///< servers a, which has session lab, and b
  Words connection_;                    ///< arguments of an operator's console
};

/// `tandem-client control` that reads the commands of this test.
class TypedConsole {
 public:
  TypedConsole(const Folder& folder, const Words& words) : pipe_(folder.file("commands")) {
    EXPECT_EQ(::mkfifo(pipe_.c_str(), 0600), 0);
    Words command{"/bin/sh", "-c", "exec \"$0\" \"$@\" < " + pipe_, TANDEM_CLIENT, "control"};
    command.insert(command.end(), words.begin(), words.end());
    process_.emplace(std::move(command));
    typed_ = io::Fd{::open(pipe_.c_str(), O_WRONLY)};
  }
  void type(const std::string& line) {
    EXPECT_EQ(::write(typed_.get(), (line + "\n").data(), line.size() + 1), static_cast<ssize_t>(line.size() + 1));
  }
  Process& process() { return *process_; }

 private:
  std::string pipe_;
  std::optional<Process> process_;
  io::Fd typed_;
};

TEST_F(ServiceConsole, FollowsItsSessionWhenItMovesAndWhenItsServerEnds) {
  LiveService& service = *service_;
  Process& b = service.of("b");
  TypedConsole console(service.folder(), connection_);
  console.type("status");
  ASSERT_TRUE(console.process().wait_for("lab: waiting")) << console.process().err();
  // The ticket is used: no other console joins by it.
  Words again{TANDEM_CLIENT, "control"};
  again.insert(again.end(), connection_.begin(), connection_.end());
  again.push_back("status");
  Process refused(again);
  EXPECT_EQ(refused.wait(), 1);
  EXPECT_NE(refused.err().find("used"), std::string::npos) << refused.err();

  LiveService::run({"move", "lab", "--to", "b", "--config", service.folder().file("a.textproto")});
  ASSERT_TRUE(console.process().wait_for("has followed session lab")) << console.process().err();
  EXPECT_NE(service.folder().read("a/audit.log").find("ticket_restored"), std::string::npos);
  Process refused_there(again);
  EXPECT_EQ(refused_there.wait(), 1);
  EXPECT_NE(refused_there.err().find("used"), std::string::npos) << refused_there.err();

  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // until the standby is named
  b.signal(SIGTERM);
  EXPECT_EQ(b.wait(), 0) << b.err();
  service.wait_for_sessions("a", 1);
  const std::string followed = "this console has followed session lab to its new server\n";
  ASSERT_TRUE(console.process().wait_for(followed + followed)) << console.process().out() << console.process().err();
  console.type("sessions");
  EXPECT_TRUE(console.process().wait_for("seats free")) << console.process().out();
  console.type("status");
  EXPECT_TRUE(console.process().wait_for("; 0 stops, 0 restarts and 2 moves so far")) << console.process().out();
  console.type("quit");
  EXPECT_EQ(console.process().wait(), 0) << console.process().err();
}

/// Its ticket admits it at the next owner, and neither a second console nor another workstation.
TEST_F(ServiceConsole, ComesBackByItsTicketWhenItsServerDiesAndNoOtherConsoleDoes) {
  LiveService& service = *service_;
  Process &a = service.of("a"), &b = service.of("b");
  TypedConsole console(service.folder(), connection_);
  console.type("status");
  ASSERT_TRUE(console.process().wait_for("lab: waiting")) << console.process().err();
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // until the standby is named
  a.signal(SIGKILL);
  ASSERT_EQ(a.wait(), -SIGKILL);
  EXPECT_TRUE(console.process().wait_for("it carries out no order")) << console.process().err();
  // Orders of this time come too late: the next stop is the first. An empty line is none.
  console.type("stop early");
  console.type("");
  console.type("authority trainee=1");
  ASSERT_TRUE(console.process().wait_for("has followed session lab")) << console.process().err() << b.err();
  EXPECT_TRUE(console.process().wait_for("this console was not connected: stop early\n")) << console.process().err();
  EXPECT_TRUE(console.process().wait_for("this console was not connected: authority trainee=1\n"));
  console.type("stop danger");
  EXPECT_TRUE(console.process().wait_for("STOPPED")) << console.process().out() << console.process().err();
  const auto refused = [&](Words words) {
    words.insert(words.begin(), {TANDEM_CLIENT, "control"});
    words.push_back("status");
    Process other(std::move(words));
    EXPECT_EQ(other.wait(), 1);
    return other.err();
  };
  Words again = connection_;
  EXPECT_NE(refused(again).find("used"), std::string::npos) << "the same key";
  const std::string thief = service.folder().file("own-thief");
  Process given({TANDEM_SERVER, "enroll", "thief", "--state", service.folder().file("b")});
  ASSERT_EQ(given.wait(), 0) << given.err();
  Process taken({TANDEM_CLIENT, "enroll", first_line(given.out()), "--state", thief});
  ASSERT_EQ(taken.wait(), 0) << taken.err();
  *std::ranges::find(again, service.folder().file("own-desk")) = thief;
  EXPECT_NE(refused(again).find("another"), std::string::npos) << refused(again);

  // The server that died comes back, and the next one dies: its own list of used tickets does not refuse the console.
  Process& a_again = service.start("a");
  ASSERT_TRUE(a_again.wait_for("is a member of the service")) << a_again.err();
  std::this_thread::sleep_for(std::chrono::milliseconds(3500));  // until the standby is named
  b.signal(SIGKILL);
  ASSERT_EQ(b.wait(), -SIGKILL);
  const std::string followed = "this console has followed session lab to its new server\n";
  ASSERT_TRUE(console.process().wait_for("`resume 1` ends it\n" + followed))
      << console.process().out() << console.process().err() << a_again.err();
  EXPECT_TRUE(console.process().wait_for("STOPPED by desk (operator at a console): danger")) << "it takes orders again";
  console.type("status");
  EXPECT_TRUE(console.process().wait_for("; 1 stop, 2 restarts and 0 moves so far")) << console.process().out();
  console.type("quit");
  EXPECT_EQ(console.process().wait(), 1) << "two orders were not carried out";

  // A console that has left does not come back, also not when its server dies after that.
  EXPECT_NE(refused(connection_).find("used"), std::string::npos);
}

/// Otherwise, `stop ` and a later `status` stop the session.
TEST_F(ServiceConsole, DropsTheBeginOfALineWhenItsSessionMoves) {
  LiveService& service = *service_;
  Words command{TANDEM_CLIENT, "control"};
  command.insert(command.end(), connection_.begin(), connection_.end());
  TerminalProcess person(command, 100, 40);
  ASSERT_TRUE(person.wait_for("lab (operator)>")) << person.picture();
  person.type("stop ");
  ASSERT_TRUE(person.wait_until([](const Terminal& t) { return t.screen().back() == "lab (operator)> stop"; }));
  const auto move = [&](const char* from, const char* to) {
    LiveService::run({"move", "lab", "--to", to, "--config", service.folder().file(from + std::string(".textproto"))});
  };
  move("a", "b");
  ASSERT_TRUE(person.wait_for("has followed session lab")) << person.picture();
  EXPECT_TRUE(person.wait_for("the line that you had begun is dropped, type it again: stop")) << person.picture();
  person.type("status\n");
  EXPECT_TRUE(person.wait_for("0 stops, 0 restarts and 1 move so far")) << person.picture();
  person.type("quit\n");
  EXPECT_EQ(person.wait(), 1) << person.picture();
}

TEST_F(ServiceConsole, ThatWatchesFollowsItsSessionWhenItMovesAndWhenItsServerDies) {
  LiveService& service = *service_;
  const std::string states = service.folder().write("states", "");
  Words command{"/bin/sh", "-c", "exec \"$0\" \"$@\" > " + states, TANDEM_CLIENT, "watch", "--json"};
  command.insert(command.end(), connection_.begin(), connection_.end());
  Process watch(command);
  // Waits for states after those that are there.
  const auto shows = [&] {
    const auto before = std::filesystem::file_size(states);
    const auto newer = [&] { return std::filesystem::file_size(states) > before + 1000; };
    for (int i = 0; i < 1500 && !newer(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(newer()) << watch.err();
  };
  const auto follows = [&](const std::string& text) {
    ASSERT_TRUE(watch.wait_for(text)) << watch.err();
    shows();
  };
  shows();
  LiveService::run({"move", "lab", "--to", "b", "--config", service.folder().file("a.textproto")});
  const std::string followed = "tandem-client watch: has followed session lab to its new server\n";
  follows(followed);
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // until the standby is named
  service.of("b").signal(SIGKILL);
  ASSERT_TRUE(watch.wait_for("the server ended this connection")) << watch.err();
  follows("Looks for session lab at the other servers\n" + followed);
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 0) << watch.err();
}

}  // namespace
}  // namespace tandem::test
