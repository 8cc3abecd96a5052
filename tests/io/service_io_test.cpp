// Servers of one service over etcd, as real programs on loopback: sessions survive the loss of their server, and no
// hand is engaged without the directory. Durations are printed; ./test --cluster judges them.
#include "tests/common/base/counts.h"
#include "tests/io/metrics_page.h"
#include "tests/io/pressing_service.h"
#include "tests/io/slow_disk.h"

namespace tandem::test {
namespace {

using std::chrono::milliseconds;

constexpr const char* kTwoSessions =
    "session { name: \"lab\" scene: \"free_motion\" } session { name: \"two\" scene: \"contact\" }";

class Service : public PressingServiceTest {};

TEST_F(Service, StandbyTakesOverTheSessionsOfAKilledServer) {
  LiveService service(kTwoSessions);
  Process& a = service.start("a");
  service.wait_for_sessions("a", 2);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  const Json before = service.sessions("a");
  EXPECT_TRUE(service.sessions("b").empty());
  std::this_thread::sleep_for(milliseconds(2500));  // until the standby is named
  a.signal(SIGKILL);
  ASSERT_EQ(a.wait(), -SIGKILL);
  const double taken = service.wait_for_sessions("b", 2);
  std::printf("[  figures ] sessions of a killed server served again after %.2f s, asked <= 7\n", taken);
  const Json after = service.sessions("b");
  for (const Json& session : before) {
    const auto same = [&](const Json& other) {
      return other["name"] == session["name"] && other["id"] == session["id"] && other["code"] == session["code"];
    };
    EXPECT_TRUE(std::ranges::any_of(after, same)) << session << " is not in " << after;
  }
  EXPECT_TRUE(b.wait_for("session lab RESTORED from its checkpoint")) << b.err();
}

TEST_F(Service, EndedServerHandsItsSessionsOverAtOnce) {
  LiveService service(kTwoSessions);
  Process& a = service.start("a");
  service.wait_for_sessions("a", 2);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  std::this_thread::sleep_for(milliseconds(2500));  // until the standby is named
  a.signal(SIGTERM);
  EXPECT_EQ(a.wait(), 0) << a.err();
  EXPECT_NE(a.out().find("lab: free_motion: did not begin here: it waited for"), std::string::npos) << a.out();
  EXPECT_NE(a.out().find("; it stays in the service;"), std::string::npos) << a.out();
  EXPECT_EQ(a.out().find("never began"), std::string::npos) << a.out();
  const double taken = service.wait_for_sessions("b", 2);
  std::printf("[  figures ] sessions of an ended server served again after %.2f s\n", taken);
  EXPECT_EQ(service.etcd().etcdctl({"get", "/tandem/v1/live/servers/a"}), "");
  b.signal(SIGTERM);
  EXPECT_EQ(b.wait(), 0) << b.err();
  // The service has its sessions when all its servers start again.
  Process& again = service.start("a");
  service.wait_for_sessions("a", 2);
  EXPECT_TRUE(again.wait_for("session two RESTORED from its checkpoint")) << again.err();
}

TEST_F(Service, SessionsAreHeldWithoutTheDirectoryAndGoOnWhenItIsBack) {
  LiveService service(kTwoSessions);
  Process& a = service.start("a");
  service.wait_for_sessions("a", 2);
  const std::string own = service.enrolled("desk");
  service.etcd().process().signal(SIGTERM);
  ASSERT_TRUE(service.etcd().process().wait());
  ASSERT_TRUE(a.wait_for("does not answer")) << a.err();
  ASSERT_TRUE(a.wait_for("2 sessions HELD")) << a.err();
  EXPECT_EQ(service.sessions("a").size(), 2U) << "the seats stay";
  std::string metrics;
  for (int i = 0; i < 500 && metrics.find("tandem_sessions{phase=\"held\"} 2") == std::string::npos; ++i) {
    std::this_thread::sleep_for(milliseconds(i == 0 ? 0 : 20));  // the next tick of both threads
    metrics = page(service.metrics("a"));
  }
  EXPECT_NE(metrics.find("tandem_sessions{phase=\"held\"} 2"), std::string::npos) << metrics;
  EXPECT_NE(metrics.find("tandem_sessions{phase=\"running\"} 0"), std::string::npos) << metrics;
  Process asked({TANDEM_CLIENT, "sessions", "--server", service.address("a"), "--state", own, "--json"});
  EXPECT_EQ(asked.wait(), 0) << asked.err();
  const Json list = Json::parse(asked.out(), nullptr, false);
  for (const Json& session : list["sessions"]) EXPECT_EQ(session["phase"], "held");
  std::this_thread::sleep_for(milliseconds(3000));  // longer than the lease
  service.etcd().start();
  ASSERT_TRUE(a.wait_for("not HELD by the directory any more")) << a.err();
  ASSERT_TRUE(a.wait_for("answers again")) << a.err();
  EXPECT_EQ(a.err().find("GIVEN UP"), std::string::npos) << a.err();
  EXPECT_EQ(service.sessions("a").size(), 2U);
}

TEST_F(Service, FrozenServerGivesItsSessionsUpWhenItWakes) {
  LiveService service(kTwoSessions);
  Process& a = service.start("a");
  service.wait_for_sessions("a", 2);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  std::this_thread::sleep_for(milliseconds(2500));  // until the standby is named
  a.signal(SIGSTOP);
  service.wait_for_sessions("b", 2);
  a.signal(SIGCONT);
  ASSERT_TRUE(a.wait_for("lab: GIVEN UP")) << a.err();
  ASSERT_TRUE(a.wait_for("two: GIVEN UP")) << a.err();
  service.wait_for_sessions("a", 0);
  EXPECT_EQ(service.sessions("b").size(), 2U);
  ASSERT_TRUE(a.wait_for("is a member of the service")) << a.err();
}

TEST_F(Service, ServerWithoutTheDirectorySaysSoAndWaitsForIt) {
  LiveService service(kTwoSessions);
  {  // An etcd that is killed while it makes its data folder cannot use it any more.
    directory::EtcdOptions options;
    options.endpoints = {service.etcd().endpoint()};
    directory::EtcdDirectory through(options);
    service.etcd().wait_until_ready(through);
  }
  service.etcd().process().signal(SIGKILL);
  ASSERT_TRUE(service.etcd().process().wait());
  Process& a = service.start("a");
  ASSERT_TRUE(a.wait_for("cannot be reached")) << a.err();
  EXPECT_NE(a.err().find(service.etcd().endpoint()), std::string::npos) << a.err();
  EXPECT_TRUE(service.sessions("a").empty());
  service.etcd().start();
  service.wait_for_sessions("a", 2);
}

TEST_F(Service, OneOfThreeMembersOfEtcdMayFail) {
  LiveService service(kTwoSessions, 3);
  Process& a = service.start("a");
  service.wait_for_sessions("a", 2);
  const std::size_t losses = draws(1, 3, 3);
  for (std::size_t n = 0; n < losses; ++n) {
    service.etcd(n).process().signal(SIGKILL);  // of three losses one is that of the leader
    ASSERT_TRUE(service.etcd(n).process().wait());
    std::this_thread::sleep_for(milliseconds(4000));  // longer than an election
    service.etcd(n).start();
    std::this_thread::sleep_for(milliseconds(3000));
  }
  EXPECT_EQ(service.sessions("a").size(), 2U);
  EXPECT_EQ(a.err().find("GIVEN UP"), std::string::npos) << a.err();
  std::printf("[  figures ] HELD during %zu losses of a member of etcd: %s\n", losses,
              a.err().find("HELD") == std::string::npos ? "never" : "yes, shorter than the lease");
}

TEST_F(Service, HandsInContactComeBackFromZeroForceAtTheStandbyOfAKilledServer) {
  const std::size_t kills = draws(1, 20, 50);
  PressingService pressed;
  LiveService& service = pressed.service();
  pressed.start({"a", "b"});
  pressed.join(service.address("b"));  // which sends them to the owner
  for (std::size_t n = 0; n < kills; ++n) {
    const std::string owner = pressed.witness().owner(), standby = owner == "a" ? "b" : "a";
    ASSERT_NE(owner, "");
    service.of(owner).signal(SIGKILL);
    ASSERT_EQ(service.of(owner).wait(), -SIGKILL);
    pressed.wait_until_active(standby);
    service.start(owner);
    std::this_thread::sleep_for(milliseconds(2500));  // until it is named standby
  }
  const std::vector<Absence> all = pressed.expect_safe(std::nullopt);
  // A machine that stands still may add rejoins and absences.
  for (const char* seat : PressingService::kSeats)
    EXPECT_GE(service.folder().json(std::string(seat) + ".json")["rejoins"], kills) << seat;
  ASSERT_GE(all.size(), 2 * kills);
  print("release to wholly active [s], asked <= 7", values(all, &Absence::back_s));
  print("force in the first tick [N], asked <= 0.05", values(all, &Absence::first_n));
}

/// The lease is renewed by a thread of its own: whatever the server writes meanwhile, its hands act on.
TEST_F(Service, HandsInContactActOnWhileTheDiskOfTheirServerIsStuck) {
  PressingService pressed;
  const std::string word = pressed.service().folder().write("disk", "ok");
  pressed.service().set("a", {.under = on_slow_disk(word, {})});
  pressed.start({"a"});
  pressed.join(pressed.service().address("a"));
  const test::Folder& folder = pressed.service().folder();
  const std::string once = LiveService::run({"enroll", "other", "--state", folder.file("a")});
  folder.write("disk", "lists");
  Process enrolled({TANDEM_CLIENT, "enroll", first_line(once), "--state", folder.file("own-other")});
  const auto stuck = [&] { return std::filesystem::exists(folder.file("a/.workstations.textproto.new")); };
  for (int i = 0; i < 500 && !stuck(); ++i) std::this_thread::sleep_for(milliseconds(20));
  EXPECT_TRUE(stuck()) << "else this test shows nothing";
  std::this_thread::sleep_for(milliseconds(6000));  // a sync takes 4 s, a lease 3 s
  folder.write("disk", "ok");
  static_cast<void>(enrolled.wait());  // 1 if it did not wait so long
  EXPECT_EQ(pressed.expect_safe(0).size(), 0u) << "hands were free";
}

/// At its quota etcd renews leases, answers reads and refuses every write.
TEST_F(Service, SessionsStayWhereTheyAreAndGoOnWhileEtcdIsFull) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" }");
  Process& a = service.start("a");
  service.wait_for_sessions("a", 1);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  service.etcd().restart_with({"--quota-backend-bytes", "8388608"});
  const std::string filler(120'000, 'x');
  bool full = false;
  for (int n = 0; n < 200 && !full; ++n) {
    Process put({etcd_program("etcdctl"), "--endpoints", service.etcd().endpoint(), "put", "filler" + std::to_string(n),
                 filler});
    full = put.wait() != 0;
  }
  ASSERT_TRUE(full);
  std::this_thread::sleep_for(milliseconds(5000));  // longer than the lease
  ASSERT_EQ(service.sessions("a").size(), 1u);
  EXPECT_NE(service.sessions("a")[0]["phase"], "held");
  Process drain = server({"stop", "--grace", "60", "--state", service.folder().file("a")});
  ASSERT_TRUE(a.wait_for("MOVES to server b, because this server drains")) << a.err();
  EXPECT_TRUE(a.wait_for("session lab RESTORED from its checkpoint")) << "it is served again: " << a.err();
  static_cast<void>(service.etcd().etcdctl({"del", "--prefix", "filler"}));
  const Json status = Json::parse(service.etcd().etcdctl({"endpoint", "status", "-w", "json"}));
  static_cast<void>(
      service.etcd().etcdctl({"compact", std::to_string(status[0]["Status"]["header"]["revision"].get<long>())}));
  static_cast<void>(service.etcd().etcdctl({"defrag"}));
  static_cast<void>(service.etcd().etcdctl({"alarm", "disarm"}));
  service.wait_for_sessions("b", 1);
  EXPECT_TRUE(a.wait()) << "all its sessions have moved";
  drain.wait();
}

TEST_F(Service, HandsInContactAreFreeWithoutTheDirectoryAndEngageAgainFromZeroForce) {
  PressingService pressed;
  pressed.start({"a"});
  pressed.join(pressed.service().address("a"));
  Process& etcd = pressed.service().etcd().process();
  etcd.signal(SIGTERM);
  ASSERT_TRUE(etcd.wait());
  pressed.wait_until_released("a");
  std::this_thread::sleep_for(milliseconds(3000));  // longer than the lease
  EXPECT_EQ(pressed.witness().owner(), "") << "a hand is engaged before the directory is back";
  pressed.service().etcd().start();
  pressed.wait_until_active("a");
  const std::vector<Absence> all = pressed.expect_safe(0);
  EXPECT_EQ(std::ranges::count_if(all, [](const Absence& absence) { return absence.free_s >= 3; }), 2)
      << "no hand is engaged before the directory is back";
}

TEST_F(Service, TicketAdmitsOnceInTheWholeService) {
  LiveService service(kTwoSessions);
  service.start("a");
  service.wait_for_sessions("a", 2);
  service.start("b");
  const std::string own = service.enrolled("desk");
  const std::string ticket = service.folder().write(
      "once.ticket", first_line(LiveService::run({"ticket", "--session", "lab", "--seat", "trainer", "--workstation",
                                                  "desk", "--state", service.folder().file("a")})));
  const auto join = [&](const std::string& server) {
    return client(address_of(service.of(server)), "trainer",
                  {"--session", "lab", "--ticket-file", ticket, "--state", own, "--duration", "2"});
  };
  Process joined = join("a");
  EXPECT_TRUE(joined.wait_for("left the seat")) << joined.err();
  std::this_thread::sleep_for(milliseconds(2500));  // until the standby is named
  service.of("a").signal(SIGKILL);
  ASSERT_TRUE(service.of("a").wait());
  service.wait_for_sessions("b", 2);
  Process again = join("b");  // a server that has never seen the ticket
  EXPECT_EQ(again.wait(), 1);
  EXPECT_NE(again.err().find("used before"), std::string::npos) << again.err();
}

TEST_F(Service, CreatedSessionIsUniqueInTheServiceAndLeavesNothingWhenItEnds) {
  LiveService service("session { name: \"lab\" scene: \"lesson\" }");
  service.start("a");
  service.wait_for_sessions("a", 1);
  Process& b = service.start("b");
  ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
  const std::string own = service.enrolled("desk");
  const auto operate = [&](const Words& command) {
    const std::string ticket = service.folder().write(
        "operator.ticket",
        first_line(LiveService::run({"ticket", "--session", "lab", "--role", "operator", "--workstation", "desk",
                                     "--state", service.folder().file("a")})));
    Words words{TANDEM_CLIENT, "control", "--server", address_of(service.of("a")), "--session", "lab", "--ticket-file",
                ticket,        "--state", own};
    words.insert(words.end(), command.begin(), command.end());
    return Process(std::move(words));
  };
  Process create = operate({"create", "exam", "lesson"});
  EXPECT_EQ(create.wait(), 0) << create.err();
  service.wait_for_sessions("a", 2);  // its file is at most a second old
  Process twice = operate({"create", "exam", "lesson"});
  EXPECT_EQ(twice.wait(), 1) << twice.err();
  EXPECT_NE(twice.err().find("exists already"), std::string::npos) << twice.err();
  EXPECT_NE(service.etcd().etcdctl({"get", "/tandem/v1/catalogue/exam/spec"}), "");
  Process end = operate({"end", "exam"});
  EXPECT_EQ(end.wait(), 0) << end.err();
  service.wait_for_sessions("a", 1);
  for (int i = 0; i < 500 && !service.etcd().etcdctl({"get", "/tandem/v1/live/sessions/exam/owner"}).empty(); ++i)
    std::this_thread::sleep_for(milliseconds(20));
  for (const char* key : {"catalogue/exam/", "snapshots/exam", "live/sessions/exam/"})
    EXPECT_EQ(service.etcd().etcdctl({"get", "--prefix", std::string("/tandem/v1/") + key}), "") << key;
  // A configured session that ends begins again, under the same ownership, with another id.
  const Json before = service.sessions("a");
  Process again = operate({"end", "lab"});
  EXPECT_EQ(again.wait(), 0) << again.err();
  Json after = service.sessions("a");
  for (int i = 0; i < 500 && (after.size() != 1 || after[0]["id"] == before[0]["id"]); ++i) {
    std::this_thread::sleep_for(milliseconds(20));
    after = service.sessions("a");
  }
  ASSERT_EQ(after.size(), 1U);
  EXPECT_NE(after[0]["id"], before[0]["id"]);
  EXPECT_NE(after[0]["code"], before[0]["code"]);
}

TEST_F(Service, MovedSessionTakesItsHandsAlong) {
  PressingService pressed;
  pressed.start({"a", "b"});
  pressed.join(pressed.service().address("a"));
  const std::string config = pressed.service().folder().file("a.textproto");
  EXPECT_EQ(LiveService::run({"move", "lab", "--to", "b", "--config", config}), "session lab is at server b now\n");
  pressed.wait_until_active("b");
  EXPECT_EQ(LiveService::run({"move", "lab", "--to", "b", "--config", config}),
            "session lab is at server b already, and stays there\n");
  pressed.service().wait_for_sessions("b", 1);  // its list is at most a second old
  const Json listed = pressed.service().sessions("b");
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_EQ(LiveService::run({"move", listed[0]["id"], "--to", "b", "--config", config}),
            "session lab is at server b already, and stays there\n");
  EXPECT_EQ(LiveService::run({"move", listed[0]["code"], "--to", "any", "--config", config}),
            "session lab may be at any server now\n");
  EXPECT_EQ(LiveService::run({"move", "lab", "--to", "any", "--config", config}),
            "session lab may be at any server already\n");
  EXPECT_EQ(LiveService::run({"move", "lab", "--to", "b", "--config", config}),
            "session lab is at server b already; from now on it stays there\n");
  EXPECT_EQ(LiveService::run({"move", "lab", "--to", "any", "--config", config}),
            "session lab may be at any server now\n")
      << "it was to stay";
  for (const Words& wrong : {Words{"move", "lab", "--to", "c"}, Words{"move", "nothing", "--to", "a"}}) {
    Words words = wrong;
    words.insert(words.end(), {"--config", config});
    Process refused = server(words);
    EXPECT_EQ(refused.wait(), 1) << refused.err();
  }
  const std::vector<Absence> all = pressed.expect_safe(1);
  ASSERT_GE(all.size(), 2U);
  print("move: release to wholly active [s]", values(all, &Absence::back_s));
  print("move: force in the first tick [N], asked <= 0.05", values(all, &Absence::first_n));
}

TEST_F(Service, ServersAreListedFromTheDirectory) {
  LiveService service(kTwoSessions);
  service.start("a");
  service.wait_for_sessions("a", 2);
  const std::string config = service.folder().file("a.textproto");
  EXPECT_NE(LiveService::run({"servers", "--config", config}).find(address_of(service.of("a"))), std::string::npos);
  service.etcd().process().signal(SIGKILL);
  ASSERT_TRUE(service.etcd().process().wait());
  Process asked = server({"servers", "--config", config});
  EXPECT_EQ(asked.wait(), 1);
  EXPECT_NE(asked.err().find("does not answer"), std::string::npos) << asked.err();
}

TEST_F(Service, WrongNamesAndMissingMembershipAreReportedByTheCheckToo) {
  LiveService service("session { name: \"lab\" scene: \"free_motion\" } ");
  service.start("a");
  LiveService::run({"init", "--state", service.folder().file("lone")});
  const auto expect_refused = [&](const std::string& state, const std::string& more, const std::string& words) {
    SCOPED_TRACE(words);
    const std::string config = service.folder().write(
        "wrong.textproto", "version: 1 listen: \"127.0.0.1:0\" " + (state.empty() ? "" : "state: \"" + state + "\"") +
                               " session { name: \"lab\" scene: \"free_motion\" }\n directory { " + more +
                               " endpoint: \"" + service.etcd().endpoint() + "\" }");
    for (const Words& command : {Words{"serve", config}, Words{"serve", config, "--check"}}) {
      Process wrong = server(command);
      EXPECT_EQ(wrong.wait(), 2) << wrong.out();
      EXPECT_NE(wrong.err().find("wrong.textproto:2"), std::string::npos) << wrong.err();
      EXPECT_NE(wrong.err().find(words), std::string::npos) << wrong.err();
    }
  };
  expect_refused("lone", "", "tandem-server service join");
  expect_refused("", "", "needs a state folder");
  service.of("a").signal(SIGTERM);
  service.of("a").wait();
  expect_refused("a", "server: \"x\"", "the member file of this server has the name a");
}

}  // namespace
}  // namespace tandem::test
