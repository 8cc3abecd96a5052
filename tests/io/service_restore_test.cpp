// A backup of etcd and its restore, as server/README.md describes them, with the servers of a service.
#include <set>

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
  // The servers notice it, so their lists are joined with that of the backup: a workstation that was revoked since is
  // back.
  std::this_thread::sleep_for(milliseconds(1500));  // until the lists are compared
  EXPECT_NE(a.err().find("has lost its data"), std::string::npos) << a.err();
  EXPECT_TRUE(enrolled("a", "new"));
  EXPECT_TRUE(enrolled("a", "gone"));
  // The server that accepted a ticket remembers it itself; another one accepts it once more.
  EXPECT_FALSE(use(later));
  const std::string config = service.folder().file("a.textproto");
  EXPECT_EQ(LiveService::run({"move", "lab", "--to", "b", "--config", config}), "session lab is at server b now\n");
  EXPECT_TRUE(use(later));
  EXPECT_FALSE(use(later));
}

// etcd is killed and comes back with nothing, again and again, while a person holds a seat. The seat is found again by
// itself, because no epoch is lower than one of before.
TEST_F(ServiceRestore, KeepsWorkstationsAndSessionsWhenEtcdComesBackWithNothing) {
  service.start("a");
  service.wait_for_sessions("a", 1);
  ASSERT_TRUE(service.start("b").wait_for("is a member of the service"));
  static_cast<void>(service.enrolled("desk"));
  operate({"create", "made", "lesson"});
  service.wait_for_sessions("a", 2);
  const auto ids = [&] {
    std::set<std::string> all;
    for (const char* name : {"a", "b"})
      for (const Json& session : service.sessions(name)) all.insert(session["id"].get<std::string>());
    return all;
  };
  const std::set<std::string> before = ids();
  Process seated = client(service.address("a"), "trainer",
                          {"--session", "lab", "--ticket-file", ticket("seat", {"--seat", "trainer"}), "--state",
                           service.folder().file("own-desk"), "--duration", "600", "--reconnect-timeout", "60"});
  constexpr int kLosses = 8;
  int workstations = 0, sessions = 0;
  for (int loss = 1; loss <= kLosses; ++loss) {
    SCOPED_TRACE(loss);
    std::this_thread::sleep_for(milliseconds(2000));  // until the seat is taken, again
    service.etcd().lose(milliseconds(400 * loss));
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    std::string keys;
    const auto has = [&](const std::string& key) { return keys.find("/tandem/v1/" + key + "\n") != std::string::npos; };
    bool served = false;
    while (!served && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(milliseconds(2500));  // no session is served before the time of a lease
      keys = service.etcd().etcdctl({"get", "--prefix", "--keys-only", "/tandem/v1/"});
      served = has("catalogue/lab/spec") && has("catalogue/made/spec") && ids() == before;
    }
    const bool enrolments = enrolled("a", "desk") && enrolled("b", "desk") && has("registry/desk");
    EXPECT_TRUE(enrolments) << keys;
    EXPECT_TRUE(served) << keys << service.of("a").err() << service.of("b").err();
    workstations += enrolments ? 1 : 0;
    sessions += served ? 1 : 0;
  }
  seated.signal(SIGINT);
  EXPECT_TRUE(seated.wait()) << seated.err();
  int back = 0;
  const std::string mark = "the server is back after";
  for (std::size_t at = 0; (at = seated.err().find(mark, at)) != std::string::npos; at += mark.size()) ++back;
  EXPECT_EQ(back, kLosses) << seated.err();
  std::printf("[  figures ] of %d losses of all data of etcd: %d kept all workstations, %d all sessions, %d the seat\n",
              kLosses, workstations, sessions, back);
  EXPECT_EQ(service.folder().read("a/audit.log").find("revoked_in_service"), std::string::npos);
  EXPECT_EQ(service.folder().read("b/audit.log").find("revoked_in_service"), std::string::npos);
  EXPECT_TRUE(service.of("a").wait_for("has lost its data")) << service.of("a").err();
  EXPECT_TRUE(service.of("a").wait_for("session lab RESTORED from its checkpoint")) << service.of("a").err();
}

}  // namespace
}  // namespace tandem::test
