// Sessions move between the servers of a service by themselves, with real programs on loopback.
#include <algorithm>
#include <chrono>
#include <map>

#include "tests/io/service_fixture.h"

namespace tandem::test {
namespace {

class ServiceBalanceLive : public ::testing::Test {
 protected:
  void SetUp() override {
    if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
  }
};

/// Ids of the sessions of these servers, by name.
std::map<std::string, std::string> ids(const LiveService& service, const std::vector<std::string>& servers) {
  std::map<std::string, std::string> ids;
  for (const std::string& server : servers)
    for (const Json& session : service.sessions(server)) ids[session["name"]] = session["id"];
  return ids;
}

TEST_F(ServiceBalanceLive, SessionsThatWaitAreSpreadOverTheServers) {
  std::string sessions;
  for (int n = 0; n < 4; ++n) sessions += format("session { name: \"s%d\" scene: \"free_motion\" } ", n);
  LiveService service(sessions);
  service.let_balance();
  Process& a = service.start("a");
  service.wait_for_sessions("a", 4);
  const auto before = ids(service, {"a"});
  service.start("b");
  std::printf("[  figures ] 2 of 4 sessions moved to a second server after %.1f s\n",
              service.wait_for_sessions("b", 2));
  service.wait_for_sessions("a", 2);
  EXPECT_EQ(ids(service, {"a", "b"}), before) << "they are the same sessions";
  EXPECT_TRUE(a.wait_for("MOVES to server b, because it waits for people")) << a.err();
  EXPECT_EQ(a.err().find("GIVEN UP"), std::string::npos) << a.err();
}

TEST_F(ServiceBalanceLive, DrainMovesAllSessionsAndThenEndsTheServerBeforeItsGrace) {
  LiveService service("session { name: \"one\" scene: \"free_motion\" } session { name: \"two\" scene: \"contact\" }");
  Process& a = service.start("a");
  service.wait_for_sessions("a", 2);
  const auto before = ids(service, {"a"});
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  LiveService::run({"stop", "--grace", "300", "--no-wait", "--state", service.folder().file("a")});
  EXPECT_EQ(a.wait(), 0) << a.err();
  EXPECT_NE(a.err().find("after all sessions have moved to other servers"), std::string::npos) << a.err();
  EXPECT_NE(a.err().find("MOVES to server b, because this server drains"), std::string::npos) << a.err();
  service.wait_for_sessions("b", 2);
  EXPECT_EQ(ids(service, {"b"}), before);
}

TEST_F(ServiceBalanceLive, DrainOfAConsoleNamesTheServerAndEndsNoOther) {
  LiveService service("session { name: \"one\" scene: \"free_motion\" } session { name: \"two\" scene: \"contact\" }");
  Process& a = service.start("a");
  service.wait_for_sessions("a", 2);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  const std::string own = service.enrolled("desk"), at_a = address_of(a), at_b = address_of(b);
  const std::string ticket = service.folder().write(
      "ticket", first_line(LiveService::run({"ticket", "--session", "one", "--role", "operator", "--workstation",
                                             "desk", "--state", service.folder().file("a")})));
  const auto drain = [&](const std::string& address) {
    return Process(
        {TANDEM_CLIENT, "control", "--server", address, "--ticket-file", ticket, "--state", own, "drain", "300"});
  };
  Process refused = drain(at_b);
  EXPECT_EQ(refused.wait(), 1) << refused.out();
  for (const std::string& words :
       {"--server names " + at_b, "session one is served by server a at " + at_a, std::string("`tandem-server stop`")})
    EXPECT_NE(refused.err().find(words), std::string::npos) << refused.err();
  Process done = drain(at_a);  // the refusal has left the ticket valid
  EXPECT_EQ(done.wait(), 0) << done.err();
  EXPECT_NE(done.out().find("server a at " + at_a + " is draining: new joins are rejected; its sessions move"),
            std::string::npos)
      << done.out();
  EXPECT_NE(done.out().find("server a at " + at_a + " has ended"), std::string::npos) << done.out();
  EXPECT_EQ(a.wait(), 0) << a.err();
  service.wait_for_sessions("b", 2);
}

}  // namespace
}  // namespace tandem::test
