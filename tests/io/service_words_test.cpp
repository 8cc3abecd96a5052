// Texts of servers of one service over etcd for their users: real programs on loopback. Texts and results are asserted,
// never durations.
#include "common/auth/io/state_directory.h"
#include "proto/text/scenes_embedded.h"
#include "tests/io/metrics_page.h"
#include "tests/io/service_fixture.h"

namespace tandem::test {
namespace {

class ServiceWords : public ::testing::Test {
 protected:
  void SetUp() override {
    if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
  }
};

bool contains(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// Repeats a command of tandem-server until its output has these words; the test fails after 30 s.
std::string wait_for_output(const Words& words, const std::string& wanted) {
  std::string text;
  for (int i = 0; i < 300; ++i) {
    Process asked = server(words);
    EXPECT_EQ(asked.wait(), 0) << asked.err();
    text = asked.out();
    if (contains(text, wanted)) return text;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ADD_FAILURE() << "no \"" << wanted << "\" in " << text;
  return text;
}

/// A server whose configuration differs from that of the others in the words of its scene.
Process with_scene(LiveService& service, const std::string& name, const std::string& before, const std::string& after) {
  Process& first = service.start(name);
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait(), 0) << first.err();
  std::string config = service.folder().read(name + ".textproto");
  const std::size_t at = config.find(before);
  EXPECT_NE(at, std::string::npos) << config;
  config.replace(at, before.size(), after);
  Process again = server({"serve", service.folder().write(name + ".textproto", config)});
  EXPECT_TRUE(again.wait_for("is a member of the service")) << again.err();
  return again;
}

TEST_F(ServiceWords, TicketsOfOneServerAdmitAtTheOwnerOfTheSession) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  service.start("a");
  service.wait_for_sessions("a", 1);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  const std::string state = service.folder().file("b"), config = service.folder().file("b.textproto");
  const std::string list = wait_for_output({"sessions", "--state", state}, "server a");
  EXPECT_TRUE(contains(list, "this server serves no session now")) << list;
  const std::string own = service.enrolled("desk");
  wait_for_output({"sessions", "--json", "--state", state}, "\"trainee\"");
  const Words made{"ticket", "--session", "lab", "--seat", "trainee", "--workstation", "desk", "--state", state};
  const std::string ticket = service.folder().write("ticket", first_line(LiveService::run(made)));
  Process joined = client(address_of(b), "trainee", {"--ticket-file", ticket, "--state", own});
  EXPECT_TRUE(joined.wait_for("seat trainee at " + address_of(service.of("a")))) << joined.err();
  Process twice = client(address_of(b), "trainee", {"--ticket-file", ticket, "--state", own});
  EXPECT_NE(twice.wait(), 0) << "a ticket admits once";
  Process wrong =
      server({"ticket", "--session", "lab", "--seat", "traineee", "--workstation", "desk", "--state", state});
  EXPECT_EQ(wrong.wait(), 2);
  EXPECT_TRUE(contains(wrong.err(), "did you mean trainee")) << wrong.err();
  const std::string table = wait_for_output({"servers", "--config", config}, " s left");
  for (const char* column : {"STANDBY", "LEASE", "VOUCHER UNTIL"}) EXPECT_TRUE(contains(table, column)) << table;
}

TEST_F(ServiceWords, TicketsOfBeforeARevocationStayRefusedAtAllServersWhenTheOldKeyIsEnrolledAgain) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  service.start("a");
  service.wait_for_sessions("a", 1);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  const std::string own = service.enrolled("desk"), a_state = service.folder().file("a"),
                    b_state = service.folder().file("b"), config = service.folder().file("b.textproto");
  const Words made{"ticket", "--session", "lab", "--seat", "trainee", "--workstation", "desk", "--state", a_state};
  const std::string ticket = service.folder().write("ticket", first_line(LiveService::run(made)));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // times of tickets and enrolments are in seconds
  LiveService::run({"revoke", "desk", "--state", a_state});
  const auto known = [&] { return contains(service.folder().read("b/workstations.textproto"), "desk"); };
  for (int i = 0; i < 1500 && known(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_FALSE(known());
  static_cast<void>(service.enrolled_at("b", "desk"));  // with the key in its folder
  for (const char* owner : {"a", "b"}) {
    LiveService::run({"move", "lab", "--to", owner, "--config", config});
    service.wait_for_sessions(owner, 1);
    Process refused = client(address_of(service.of("a")), "trainee", {"--ticket-file", ticket, "--state", own});
    EXPECT_EQ(refused.wait(), 1);
    EXPECT_TRUE(contains(refused.err(), "its revocation has voided all tickets of before")) << refused.err();
  }
  const std::string next = service.folder().write("next", first_line(LiveService::run(made)));
  Process joined = client(address_of(b), "trainee", {"--ticket-file", next, "--state", own});
  EXPECT_TRUE(joined.wait_for("seat trainee at " + address_of(b))) << joined.err();
}

/// At each moment of a move, also at the server that gives the session up.
TEST_F(ServiceWords, AClientJoinsByNameAndTicketWhileTheSessionMoves) {
  LiveService service(
      "session { name: \"lab\" scene: \"free_motion\" } session { name: \"other\" scene: \"free_motion\" }");
  service.start("a");
  service.wait_for_sessions("a", 2);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  const std::string state = service.folder().file("b"), config = service.folder().file("b.textproto");
  wait_for_output({"sessions", "--state", state}, "server a");
  const std::string own = service.enrolled("desk");
  wait_for_output({"sessions", "--json", "--state", state}, "\"trainee\"");
  const Words made{"ticket", "--session", "lab", "--seat", "trainee", "--workstation", "desk", "--state", state};
  for (int n = 0; n < 8; ++n) {
    const std::string from = n % 2 == 0 ? "a" : "b", to = n % 2 == 0 ? "b" : "a";
    const std::string ticket = service.folder().write("ticket", first_line(LiveService::run(made)));
    Process move = server({"move", "lab", "--to", to, "--config", config});
    std::this_thread::sleep_for(std::chrono::milliseconds(n == 0 ? 10 : 50 * n));
    const auto join = [&] {
      return client(address_of(service.of(from)), "trainee",
                    {"--session", "lab", "--ticket-file", ticket, "--state", own, "--duration", "1"});
    };
    Process joined = join();
    // On a slow machine the client before can end while its session moves, too early to leave the seat at the new
    // owner, which then keeps it for that client for 2 s.
    bool left = joined.wait_for("left the seat");
    for (int again = 0; again < 5 && !left && contains(joined.err(), "is reserved for 2 s"); ++again) {
      std::this_thread::sleep_for(std::chrono::seconds(1));
      joined = join();
      left = joined.wait_for("left the seat");
    }
    EXPECT_TRUE(left) << n << ": " << joined.err();
    EXPECT_EQ(joined.err().find("no such session"), std::string::npos) << joined.err();
    EXPECT_EQ(joined.err().find("the seat is gone"), std::string::npos) << joined.err();
    EXPECT_EQ(move.wait(), 0) << move.err();
    joined.wait();
  }
}

TEST_F(ServiceWords, AServerWhoseConfigurationDiffersSaysSo) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  service.start("a");
  service.wait_for_sessions("a", 1);
  Process b = with_scene(service, "b", "free_motion", "contact");
  EXPECT_TRUE(
      b.wait_for("session lab differs in the configuration of this server from the session that the service "
                 "runs at server a: scene contact here, free_motion in the service"))
      << b.err();
}

TEST_F(ServiceWords, AMemberWithoutADirectoryInItsConfigurationSaysThatItIsAlone) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  service.start("a").signal(SIGTERM);
  service.of("a").wait();
  const std::string config = service.folder().write(
      "alone.textproto",
      "version: 1 listen: \"127.0.0.1:0\" state: \"a\" session { name: \"lab\" scene: \"free_motion\" }");
  Process alone = server({"serve", config});
  EXPECT_TRUE(alone.wait_for("no block `directory`: it serves its sessions alone")) << alone.err();
}

TEST_F(ServiceWords, AServerTakesOverASessionOfATickRateThatItHasNotConfigured) {
  LiveService service("session { name: \"lab\" scene: \"slow.textproto\" }");
  std::string scene(find_shipped_scene("free_motion")->text);
  const std::string rate = "tick_hz: 1000";
  ASSERT_TRUE(contains(scene, rate));
  service.folder().write("slow.textproto", scene.replace(scene.find(rate), rate.size(), "tick_hz: 500"));
  Process& a = service.start("a");
  service.wait_for_sessions("a", 1);
  Process b = with_scene(service, "b", "slow.textproto", "free_motion");
  wait_for_output({"servers", "--config", service.folder().file("b.textproto")}, "0         1");
  a.signal(SIGKILL);
  EXPECT_EQ(a.wait(), -SIGKILL);
  service.wait_for_sessions("b", 1);
  EXPECT_TRUE(b.wait_for("session lab RESTORED from its checkpoint")) << b.err();
}

/// Asks for `/readyz` until the answer has these words; the test fails after 30 s.
void wait_until_readiness_says(const std::string& metrics, const std::string& wanted) {
  std::string text;
  for (int i = 0; i < 300; ++i) {
    text = page(metrics, "/readyz");
    if (contains(text, wanted)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ADD_FAILURE() << "no \"" << wanted << "\" in " << text;
}

TEST_F(ServiceWords, AServerIsReadyWhileItIsAMemberAndItsDirectoryAnswers) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  service.start("a");
  service.wait_for_sessions("a", 1);
  const std::string metrics = service.metrics("a");
  wait_until_readiness_says(metrics, "200 OK");
  service.etcd().process().signal(SIGKILL);
  ASSERT_EQ(service.etcd().process().wait(), -SIGKILL);
  wait_until_readiness_says(metrics, "the directory of the service does not answer, and the sessions are HELD");
  EXPECT_TRUE(contains(page(metrics, "/readyz"), "503 ")) << page(metrics, "/readyz");
  EXPECT_TRUE(contains(page(metrics, "/healthz"), "200 OK")) << "a restart would not help";
  service.etcd().start();
  wait_until_readiness_says(metrics, "200 OK");
}

/// The server that has the session holds it, and cannot write that into the directory.
TEST_F(ServiceWords, AnotherServerSaysThatASessionMayBeHeldWhileTheDirectoryIsSilent) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  Process& a = service.start("a");
  service.wait_for_sessions("a", 1);
  service.start("b");
  const Words asked{"sessions", "--state", service.folder().file("b")};
  wait_for_output(asked, "\nlab: waiting, code ");
  service.etcd().process().signal(SIGSTOP);
  ASSERT_TRUE(a.wait_for("1 session HELD")) << a.err();
  const std::string text =
      wait_for_output(asked, "may be held: the directory of the service does not answer now (last answer ");
  EXPECT_TRUE(contains(text, "\nlab: was waiting, code ")) << text;
  wait_for_output({"sessions", "--state", service.folder().file("a")}, "\nlab: held, ");
  service.etcd().process().signal(SIGCONT);
  wait_for_output(asked, "\nlab: waiting, ");  // at server a, or taken over by b
}

TEST_F(ServiceWords, AServerWhoseVoucherExpiresSoonWarnsAndTellsTheTime) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  service.set("a", {.vouch = {"--days", "20"}});
  const std::string warning = "the voucher of this server expires on ",
                    metric = "\ntandem_service_voucher_expiry_seconds ";
  for (const std::int64_t days : {20, 400}) {
    const std::string name = days == 20 ? "a" : "b";
    const std::int64_t before = auth::wall_seconds();
    Process& started = service.start(name);
    EXPECT_EQ(contains(started.err(), warning), days == 20) << started.err();
    EXPECT_EQ(contains(started.err(), "service vouch FOLDER --name a --key "), days == 20) << started.err();
    const std::string text = page(service.metrics(name));
    ASSERT_TRUE(contains(text, metric)) << text;
    const std::int64_t left = std::stoll(text.substr(text.find(metric) + metric.size())) - before;
    EXPECT_NEAR(static_cast<double>(left), static_cast<double>(days * 86400 - 3600), 120) << "an hour is in the past";
  }
}

TEST(ServiceClients, NameTheAddressThatAnswered) {
  Process host = hosting("free_motion", {"--duration", "600"});
  const std::string address = address_of(host), nothing = free_address();
  Process seat = client(nothing + "," + address, "trainee");
  EXPECT_TRUE(seat.wait_for("seat trainee at " + address)) << seat.err();
}

}  // namespace
}  // namespace tandem::test
