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
  /// Takes the trainer's seat for a second. @return error text; empty: it had the seat
  std::string use(const std::string& ticket) {
    Process joined = client(service.address("a"), "trainer",
                            {"--session", "lab", "--ticket-file", ticket, "--state", service.folder().file("own-desk"),
                             "--duration", "1"});
    return joined.wait() == 0 ? "" : joined.err();
  }
  void operate(const Words& command) {
    Words words{TANDEM_CLIENT, "control", "--server", service.address("a"), "--session", "lab", "--ticket-file",
                ticket("operator", {"--role", "operator"}), "--state", service.folder().file("own-desk")};
    words.insert(words.end(), command.begin(), command.end());
    Process done(std::move(words));
    EXPECT_EQ(done.wait(), 0) << done.err();
  }
  /// Names of the sessions at a server.
  std::string names(const std::string& server) {
    std::string all;
    for (const Json& session : service.sessions(server)) all += session["name"].get<std::string>() + " ";
    return all;
  }
  /// Workstations that a server has enrolled, as its file names them.
  [[nodiscard]] bool enrolled(const std::string& server, const std::string& workstation) {
    return service.folder().read(server + "/clients").find(workstation) != std::string::npos;
  }

  LiveService service{"session { name: \"lab\" scene: \"free_motion\" }"};
};

TEST_F(ServiceRestore, BringsBackWhatTheBackupHasAndNamesWhatCameAfterIt) {
  service.start("a");
  service.wait_for_sessions("a", 1);
  ASSERT_TRUE(service.start("b").wait_for("is a member of the service"));
  static_cast<void>(service.enrolled_at("a", "desk"));
  std::this_thread::sleep_for(milliseconds(1500));  // until b knows it
  const std::string used = ticket("used", {"--seat", "trainer"}), later = ticket("later", {"--seat", "trainer"});
  EXPECT_EQ(use(used), "");
  operate({"create", "before", "lesson"});
  service.wait_for_sessions("a", 2);
  const Json lab = service.sessions("a");
  const std::string backup = service.folder().file("backup.db");
  EXPECT_NE(service.etcd().etcdctl({"snapshot", "save", backup}).find("saved"), std::string::npos);
  // After the backup: a session begins, one ends, a ticket is used, a workstation is enrolled.
  operate({"create", "after", "lesson"});
  operate({"end", "before"});
  EXPECT_EQ(use(later), "");
  static_cast<void>(service.enrolled_at("a", "new"));
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
  EXPECT_NE(use(used).find("used before"), std::string::npos) << "a ticket that was used before the backup";
  std::printf("[  figures ] sessions after the restore: %s; a ticket used after the backup: %s\n", names("a").c_str(),
              use(later).c_str());
  // A session that an operator created has no server until a client asks for it.
  Process list({TANDEM_CLIENT, "sessions", "--server", service.address("a"), "--state",
                service.folder().file("own-desk")});
  EXPECT_EQ(list.wait(), 0) << list.err();
  std::printf("%s\n", list.out().c_str());
}

}  // namespace
}  // namespace tandem::test
