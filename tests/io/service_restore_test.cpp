// A backup of etcd and its restore, as server/README.md describes them, with the servers of a service.
#include "tests/io/service_fixture.h"

namespace tandem::test {
namespace {

using std::chrono::milliseconds;

class ServiceRestore : public ::testing::Test {
 protected:
  void SetUp() override {
    if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
  }
  /// A ticket, in a file. @param what  such as --seat trainer
  std::string ticket(const std::string& name, const Words& what) {
    Words words{"ticket", "--session", "lab"};
    words.insert(words.end(), what.begin(), what.end());
    words.insert(words.end(), {"--workstation", "desk", "--state", service.folder().file("a")});
    return service.folder().write(name + ".ticket", first_line(LiveService::run(words)));
  }
  /// Takes the trainer's seat for a second. @return whether it had the seat; else the ticket was used before
  bool use(const std::string& ticket) {
    Process joined = client(
        service.address("a"), "trainer",
        {"--session", "lab", "--ticket-file", ticket, "--state", service.folder().file("own-desk"), "--duration", "1"});
    EXPECT_TRUE(joined.wait());
    const bool seated = joined.err().find("left the seat") != std::string::npos;
    EXPECT_EQ(seated, joined.err().find("used already") == std::string::npos) << joined.err();
    return seated;
  }
  void operate(const Words& command) {
    Words words{TANDEM_CLIENT,   "control",
                "--server",      service.address("a"),
                "--session",     "lab",
                "--ticket-file", ticket("operator", {"--role", "operator"}),
                "--state",       service.folder().file("own-desk")};
    words.insert(words.end(), command.begin(), command.end());
    Process done(std::move(words));
    EXPECT_EQ(done.wait(), 0) << done.err();
  }
  /// The sessions of the service, as a client sees them.
  std::string listed() {
    Process asked(
        {TANDEM_CLIENT, "sessions", "--server", service.address("a"), "--state", service.folder().file("own-desk")});
    EXPECT_EQ(asked.wait(), 0) << asked.err();
    return asked.out();
  }
  /// Workstations that a server has enrolled, as its file names them.
  [[nodiscard]] bool enrolled(const std::string& server, const std::string& workstation) {
    return service.folder().read(server + "/workstations.textproto").find("\"" + workstation + "\"") !=
           std::string::npos;
  }

  LiveService service{"session { name: \"lab\" scene: \"free_motion\" }"};
};

TEST_F(ServiceRestore, BringsBackWhatTheBackupHasAndNamesWhatCameAfterIt) {
  service.start("a");
  service.wait_for_sessions("a", 1);
  ASSERT_TRUE(service.start("b").wait_for("is a member of the service"));
  for (const char* workstation : {"desk", "gone"}) static_cast<void>(service.enrolled_at("a", workstation));
  std::this_thread::sleep_for(milliseconds(1500));  // until b knows it
  const std::string used = ticket("used", {"--seat", "trainer"}), later = ticket("later", {"--seat", "trainer"});
  EXPECT_TRUE(use(used));
  operate({"create", "before", "lesson"});
  service.wait_for_sessions("a", 2);
  const Json lab = service.sessions("a");
  const std::string backup = service.folder().file("backup.db");
  EXPECT_NE(service.etcd().etcdctl({"snapshot", "save", backup}).find("saved"), std::string::npos);
  // After the backup: a session begins, one ends, a ticket is used, a workstation is enrolled, one is revoked.
  operate({"create", "after", "lesson"});
  operate({"end", "before"});
  EXPECT_TRUE(use(later));
  static_cast<void>(service.enrolled_at("a", "new"));
  static_cast<void>(LiveService::run({"revoke", "gone", "--state", service.folder().file("a")}));
  std::this_thread::sleep_for(milliseconds(1500));
  // The manual: end the servers, end etcd, restore, start etcd, start the servers.
  for (const char* name : {"a", "b"}) {
    service.of(name).signal(SIGTERM);
    EXPECT_EQ(service.of(name).wait(), 0) << service.of(name).err();
  }
  service.etcd().restore(backup);
  Process& a = service.start("a");
  ASSERT_TRUE(a.wait_for("is a member of the service")) << a.err();
  ASSERT_TRUE(service.start("b").wait_for("is a member of the service"));
  service.wait_for_sessions("a", 1);
  EXPECT_TRUE(a.wait_for("session lab RESTORED from its checkpoint")) << a.err();
  const Json again = service.sessions("a");
  EXPECT_EQ(again[0]["id"], lab[0]["id"]);
  // Everything of the backup is there.
  EXPECT_TRUE(enrolled("a", "desk"));
  EXPECT_FALSE(use(used)) << "a ticket that was used before the backup";
  // The session that ended after it is back, without a server until a client asks for it.
  const std::string table = listed();
  EXPECT_NE(table.find("before: waiting"), std::string::npos) << table;
  EXPECT_EQ(table.find("after: "), std::string::npos) << table;
  // A workstation has to be enrolled again; the other one is not revoked any more.
  std::this_thread::sleep_for(milliseconds(1500));  // until the lists are compared
  EXPECT_FALSE(enrolled("a", "new"));
  EXPECT_TRUE(enrolled("a", "gone"));
  // The server that accepted a ticket remembers it itself; another one accepts it once more.
  EXPECT_FALSE(use(later));
  const std::string config = service.folder().file("a.textproto");
  EXPECT_EQ(LiveService::run({"move", "lab", "--to", "b", "--config", config}), "session lab is at server b now\n");
  EXPECT_TRUE(use(later));
  EXPECT_FALSE(use(later));
}

}  // namespace
}  // namespace tandem::test
