// Consoles of a session follow it to another server of their service, with the ticket that they have.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/io/service_fixture.h"

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
  console.type("quit");
  EXPECT_EQ(console.process().wait(), 0) << console.process().err();
}

/// Its ticket stays used, and so the console cannot follow. It says so before a person relies on an order.
TEST_F(ServiceConsole, SaysAtOnceThatItsServerDiedAndThatAnOrderAfterThatWasNotCarriedOut) {
  LiveService& service = *service_;
  Process &a = service.of("a"), &b = service.of("b");
  TypedConsole console(service.folder(), connection_);
  console.type("status");
  ASSERT_TRUE(console.process().wait_for("lab: waiting")) << console.process().err();
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // until the standby is named
  a.signal(SIGKILL);
  ASSERT_EQ(a.wait(), -SIGKILL);
  EXPECT_TRUE(console.process().wait_for("it carries out no order")) << console.process().err();
  console.type("stop danger");
  EXPECT_EQ(console.process().wait(), 1);
  EXPECT_NE(console.process().err().find("used before"), std::string::npos) << console.process().err();
  EXPECT_NE(console.process().err().find("Orders after that were not carried out"), std::string::npos);
  // It asks once by its ticket, and does not try again.
  ASSERT_TRUE(b.wait_for("used before")) << b.err();
  const std::string log = b.err();
  const auto refused = log.find("used before");
  EXPECT_EQ(log.find("used before", refused + 1), std::string::npos) << log;
}

}  // namespace
}  // namespace tandem::test
