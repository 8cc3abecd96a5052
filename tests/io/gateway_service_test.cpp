// Persons who have signed in follow their session to another server of its service. Real programs on loopback.
#include <gtest/gtest.h>

#include "tests/common/base/counts.h"
#include "tests/io/service_fixture.h"
#include "tests/io/web_fixture.h"

namespace tandem::test {
namespace {

TEST(GatewayService, PersonsFollowTheirSessionWithTheTicketThatTheyHave) {
  if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  Process& a = service.start("a");
  service.wait_for_sessions("a", 1);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  WebGateway gateway(address_of(a), {"--sign-in", "--state", service.enrolled("desk")});
  const std::string ticket =
      first_line(LiveService::run({"ticket", "--session", "lab", "--role", "operator", "--person", "ann",
                                   "--workstation", "desk", "--state", service.folder().file("a")}));
  const HttpReply reply =
      http_post(gateway.at, "/join", "application/json", Json{{"ticket", ticket}}.dump(), gateway.at.origin());
  ASSERT_EQ(reply.status, 200U) << reply.body;
  WebPage ann(gateway.at, cookie_of(reply));
  EXPECT_EQ(ann.next("hello")["person"], "ann");
  LiveService::run({"move", "lab", "--to", "b", "--config", service.folder().file("a.textproto")});
  const Json lost = ann.until([](const Json& m) { return m["type"] == "notice" && m["level"] == "error"; });
  EXPECT_NE(lost["text"].get<std::string>().find("trying again"), std::string::npos) << lost;
  const Json back = ann.until([](const Json& m) { return m["type"] == "notice" && m.value("server", "") == "back"; });
  EXPECT_FALSE(back.is_null());
  EXPECT_EQ(ann.order({{"order", "stop"}, {"why", "fire drill"}})["ok"], true);
  // Also when the server dies.
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // until the standby is named
  b.signal(SIGKILL);
  const Json again = ann.until([](const Json& m) { return m["type"] == "notice" && m.value("server", "") == "back"; });
  EXPECT_FALSE(again.is_null());
  EXPECT_EQ(ann.order({{"order", "stop"}, {"why", "again"}})["ok"], true);
  if (tandem::test::draws(0, 1, 1) == 0) return;  // the rest waits for a minute
  // After the end of all servers only another ticket helps.
  a.signal(SIGKILL);
  bool gone = false;
  for (int n = 0; n < 3 && !gone; ++n) gone = gateway.process.wait_for("persons must sign in again with a new ticket");
  EXPECT_TRUE(gone) << gateway.process.err();
}

TEST(GatewayService, PagesAndConsolesHearThatTheirSessionIsHeldAndGoesOn) {
  if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  Process& a = service.start("a");
  service.wait_for_sessions("a", 1);
  const std::string own = service.enrolled("desk");
  const auto ticket = [&] {
    return first_line(LiveService::run({"ticket", "--session", "lab", "--role", "operator", "--workstation", "desk",
                                        "--state", service.folder().file("a")}));
  };
  Process console({"/bin/sh", "-c",
                   "(echo status; sleep 300) | exec '" + std::string(TANDEM_CLIENT) + "' control --server " +
                       address_of(a) + " --state " + own + " --ticket " + ticket()});
  WebGateway gateway(address_of(a), {"--state", own, "--ticket", ticket()});
  gateway.open_url();
  WebPage page = gateway.page();
  EXPECT_FALSE(page.next("scene").is_null());
  ASSERT_TRUE(console.wait_for("lab: waiting")) << console.err();  // its ticket is used
  service.etcd().process().signal(SIGSTOP);
  const auto says = [](const char* text) {
    return [text](const Json& m) { return m["type"] == "notice" && m["text"].get<std::string>().find(text) == 0; };
  };
  EXPECT_FALSE(page.until(says("the session is held: the directory of the service")).is_null());
  EXPECT_TRUE(console.wait_for("HELD: the directory of the service does not answer")) << console.out() << console.err();
  service.etcd().process().signal(SIGCONT);
  EXPECT_FALSE(page.until(says("the session is held no longer")).is_null());
  EXPECT_TRUE(console.wait_for("the session is held no longer: it is waiting")) << console.out();
}

TEST(GatewayService, StopsAskingWhenTheTicketOfAPersonIsRefusedAndSaysTheCause) {
  if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  Process& a = service.start("a");
  service.wait_for_sessions("a", 1);
  const std::string state = service.folder().file("a");
  const WebGateway gateway(address_of(a), {"--sign-in", "--state", service.enrolled("desk")});
  const std::string ticket = first_line(LiveService::run(
      {"ticket", "--session", "lab", "--role", "operator", "--workstation", "desk", "--state", state}));
  const HttpReply reply =
      http_post(gateway.at, "/join", "application/json", Json{{"ticket", ticket}}.dump(), gateway.at.origin());
  ASSERT_EQ(reply.status, 200U) << reply.body;
  WebPage page(gateway.at, cookie_of(reply));
  EXPECT_EQ(page.next("hello")["type"], "hello");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // times of tickets and enrolments are in seconds
  LiveService::run({"revoke", "desk", "--state", state});
  const Json lost = page.until([](const Json& m) { return m["type"] == "notice" && m.value("server", "") == "lost"; });
  EXPECT_FALSE(lost.is_null());
  static_cast<void>(service.enrolled_at("a", "desk"));
  const Json gone = page.until([](const Json& m) { return m["type"] == "notice" && m.value("server", "") == "gone"; });
  EXPECT_NE(gone["text"].get<std::string>().find("its revocation has voided"), std::string::npos) << gone;
}

}  // namespace
}  // namespace tandem::test
