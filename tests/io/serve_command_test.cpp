// Many sessions on one server: real programs, real sockets on loopback. Outcomes are asserted, never durations.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "common/auth/io/client_keystore.h"
#include "common/auth/io/control_client.h"
#include "common/io/tcp_listener.h"
#include "common/io/udp_socket.h"
#include "tests/io/multi_client_fixture.h"
#include "tests/io/pressing_hands.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

/// Occupied seats of a session, from `tandem-client sessions --json`.
Words taken(const std::string& address, const std::string& session) {
  Process asked({TANDEM_CLIENT, "sessions", "--server", address, "--json"});
  EXPECT_EQ(asked.wait(), 0) << asked.err();
  Words seats;
  const Json lobby = Json::parse(asked.out(), nullptr, false);
  EXPECT_FALSE(lobby.is_discarded()) << asked.out();
  for (const Json& s : lobby["sessions"]) {
    if (s["name"] != session) continue;
    EXPECT_EQ(s["seats_free"].get<std::size_t>() + s["seats_taken"].get<std::size_t>(), s["seats"].size());
    for (const Json& seat : s["seats"])
      if (seat["taken"]) seats.push_back(seat["name"]);
  }
  return seats;
}

/// The only report of a session in a directory.
Json report_of(const std::string& folder, const std::string& session) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(session + "-")) {
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      return Json::parse(text.str(), nullptr, false);
    }
  return {};
}

/// One session starts and ends while the other runs; both tick rates share one port.
TEST(ManySessions, DoNotAffectEachOther) {
  const Folder folder;
  folder.write("slow.textproto",
               "version: 1 dof: 1 tick_hz: 500 duration_s: 600 gate { loop_age_max_ms: 2500 latch: false }\n"
               "device_coupling { k_c_n_m: 100 }\n"
               "seat { name: \"trainer\" kind: MASTER role: INSTRUCTOR required: true device { model: LINEAR } hand { "
               "model: LEADER } }\n"
               "seat { name: \"trainee\" kind: MASTER role: TRAINEE required: false device { model: LINEAR } hand { "
               "model: RELAXED } }\n"
               "tool { name: \"tool\" k_s_n_m: 100 slave { model: LINEAR } }\nauthority { tool: \"tool\" seat: "
               "\"trainer\" alpha: 1 }\n");
  fs::create_directory(folder.file("reports"));
  const std::string config =
      folder.write("server.textproto",
                   "version: 1\nlisten: \"127.0.0.1:0\"\nreports: \"reports\"\n"
                   "session { name: \"busy\" scene: \"slow.textproto\" restart: false }\n"
                   "session { name: \"quiet\" scene: \"free_motion\" duration_s: 4 restart: false }\n");
  Process host = serving(config);
  const std::string address = address_of(host);
  ASSERT_FALSE(address.empty()) << host.err();
  Process trainer = client(address, "trainer", {"--session", "busy"});
  Process quiet_trainer = client(address, "trainer", {"--session", "quiet"}),
          quiet_trainee = client(address, "trainee", {"--session", "quiet"});
  ASSERT_TRUE(host.wait_for("quiet: the session runs")) << host.err();

  // While both sessions run, a client joins late. It disturbs no seat, and no other client can take its seat.
  Process late = client(address, "trainee", {"--session", "busy"});
  ASSERT_TRUE(host.wait_for("busy: trainee joined")) << host.err();
  EXPECT_EQ(taken(address, "busy"), (Words{"trainer", "trainee"}));
  Process second = client(address, "trainee", {"--session", "busy"});
  EXPECT_EQ(second.wait(), 1);
  EXPECT_NE(second.err().find("is taken already"), std::string::npos) << second.err();
  late.signal(SIGINT);
  EXPECT_EQ(late.wait(), 0) << late.err();
  ASSERT_TRUE(host.wait_for("busy: trainee left")) << host.err();
  EXPECT_EQ(taken(address, "busy"), (Words{"trainer"}));
  Process again = client(address, "trainee", {"--session", "busy", "--duration", "0.5"});
  EXPECT_EQ(again.wait(), 0) << again.err();

  EXPECT_EQ(quiet_trainer.wait(), 0) << quiet_trainer.err();
  EXPECT_EQ(quiet_trainee.wait(), 0) << quiet_trainee.err();
  ASSERT_TRUE(host.wait_for("quiet: free_motion: ")) << host.err();
  const Json quiet = report_of(folder.file("reports"), "quiet");
  ASSERT_TRUE(quiet.is_object()) << "no report";
  EXPECT_EQ(quiet["violations"], Json::array()) << quiet["violations"];
  EXPECT_EQ(quiet["ended_by"], "scene");
  Process nowhere = client(address, "trainer", {"--session", "quiet"});
  EXPECT_EQ(nowhere.wait(), 1) << "it is over and does not restart";

  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_NE(trainer.err().find("the server ended the session"), std::string::npos) << trainer.err();
  const Json busy = report_of(folder.file("reports"), "busy");
  ASSERT_TRUE(busy.is_object()) << "no report";
  EXPECT_EQ(busy["ended_by"], "signal");
  EXPECT_EQ(busy["violations"], Json::array()) << busy["violations"];
}

TEST(ManySessions, OpenAgainAfterTheirEnd) {
  const Folder folder;
  const std::string config = folder.write(
      "s.textproto",
      "version: 1 listen: \"127.0.0.1:0\" session { name: \"again\" scene: \"one_axis\" duration_s: 0.5 }");
  Process host = serving(config);
  for (int i = 0; i < 3; ++i) {
    Process trainer = client(address_of(host), "trainer", {"--timeout", "20"});
    while (trainer.wait() == 1)
      trainer = client(address_of(host), "trainer", {"--timeout", "20"});  // between two sessions
    EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  }
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST(ManySessions, ReportAllConfigurationErrorsTogether) {
  const Folder folder;
  const std::string config = folder.write("s.textproto",
                                          "version: 1\nlisten: \"127.0.0.1\"\nmetrics: \"nowhere\"\nreports: "
                                          "\"none\"\nsession { name: \"a\" scene: \"contakt\" }\n"
                                          "session { name: \"abcdefghjk\" scene: \"contact\" }\n");
  Process host = server({"serve", config});
  EXPECT_EQ(host.wait(), 2);
  for (const char* mistake : {"s.textproto:2:9: listen", "s.textproto:3:10: metrics", "s.textproto:4:10: reports",
                              "s.textproto:5:28: session[0].scene = ", "contact", "session[1].name", "5 mistakes"})
    EXPECT_NE(host.err().find(mistake), std::string::npos) << mistake << "\n" << host.err();
  Process same = server({"serve",
                         folder.write("m.textproto",
                                      "version: 1\nlisten: \"127.0.0.1:7201\"\n"
                                      "metrics: \"0.0.0.0:7201\"\n"
                                      "session { name: \"a\" scene: \"contact\" }\n"),
                         "--check"});
  EXPECT_EQ(same.wait(), 2) << same.out();
  EXPECT_NE(same.err().find("m.textproto:3:10: metrics"), std::string::npos) << same.err();
  EXPECT_NE(same.err().find("another port"), std::string::npos) << same.err();
  const std::string good =
      folder.write("g.textproto", "version: 1 listen: \"127.0.0.1:0\" session { name: \"a\" scene: \"contact\" }");
  Process checked = server({"serve", good, "--check"});
  EXPECT_EQ(checked.wait(), 0) << checked.err();
  EXPECT_NE(checked.out().find("limits.core_percent"), std::string::npos) << checked.out();
}

TEST(ManySessions, ASecondSignalEndsAtOnce) {
  const Folder folder;
  Process host = serving(
      folder.write("s.textproto", "version: 1 listen: \"127.0.0.1:0\" session { name: \"a\" scene: \"free_motion\" }"));
  Process trainer = client(address_of(host), "trainer"), trainee = client(address_of(host), "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  host.signal(SIGTERM);
  host.signal(SIGINT);
  const auto code = host.wait();
  EXPECT_TRUE(code == 1 || code == 0) << "0 if it was over before the second one came";
  if (code == 1) {
    EXPECT_NE(host.err().find("received a second signal"), std::string::npos) << host.err();
  }
}

// ---- Rejected joins ----

TEST(Tickets, AreUsedOnceAndARevokedWorkstationIsRejectedAtOnce) {
  const MultiClientFixture fixture{
      "session { name: \"a\" scene: \"free_motion\" entry: TICKETS } session { name: \"b\" scene: \"one_axis\" }"};
  EXPECT_EQ(fixture.code(), "") << "tickets only";
  const std::string ticket = fixture.ticket("a", "trainer");
  Process trainer = fixture.join("trainer", {"--ticket", ticket, "--duration", "0.3"});
  Process second = fixture.join("trainee", {"--ticket", ticket});
  EXPECT_EQ(second.wait(), 1) << "a ticket is for one seat";
  EXPECT_EQ(trainer.wait(), 1) << "left before the session ran: nothing to judge\n" << trainer.err();
  Process used = fixture.join("trainer", {"--ticket", ticket});
  EXPECT_EQ(used.wait(), 1);
  EXPECT_NE(used.err().find("used"), std::string::npos) << used.err();

  Process listed({TANDEM_CLIENT, "sessions", "--server", fixture.address, "--state", fixture.own});
  EXPECT_EQ(listed.wait(), 0) << listed.err();
  EXPECT_NE(listed.out().find("a: waiting"), std::string::npos) << listed.out();
  const std::string good = fixture.ticket("b", "trainer");
  Process revoked = server({"revoke", "desk", "--state", fixture.state});
  EXPECT_EQ(revoked.wait(), 0) << revoked.err();
  Process refused = fixture.join("trainer", {"--ticket", good});
  EXPECT_EQ(refused.wait(), 1);
  EXPECT_NE(refused.err().find("not enrolled"), std::string::npos) << refused.err();
  std::string audit = fixture.folder.read("state/audit.log");
  for (int i = 0; i < 100 && audit.find("\"leave\"") == std::string::npos;
       ++i) {  // session events are written several times per second
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    audit = fixture.folder.read("state/audit.log");
  }
  for (const char* word : {"welcomed", "refused", "not_enrolled", "revoked", "\"join\"", "\"leave\""})
    EXPECT_NE(audit.find(word), std::string::npos) << word << "\n" << audit;
}

/// A client that lost its connection resumes with the secret of its seat: it gets that seat and no other.
TEST(Resume, SeatIsReturnedToHolderOfResumeSecret) {
  const MultiClientFixture fixture{"session { name: \"a\" scene: \"free_motion\" }"};
  const auto own = auth::ClientKeystore::open(fixture.own);
  ASSERT_TRUE(own && *own);
  const auto ask = [&](const rpc::Credential& credential) -> rpc::Body {
    const auto judge = [&](const auth::KeyFingerprint&) -> std::expected<const auth::Identity*, std::string> {
      return &(*own)->identity();
    };
    auto connected =
        auth::ControlClient::connect(*io::parse_address(fixture.address, 1), judge, std::chrono::seconds(30), -1);
    if (!connected) return rpc::Ok{};
    rpc::Hello hello;
    hello.seat = "trainee";
    hello.credential = credential;
    hello.client_cid = 7;
    hello.device = {3, 3, true, false, 0, 0, 0};
    auto answer = connected->ask(hello, std::chrono::seconds(30));
    return answer ? std::move(*answer) : rpc::Body{rpc::Ok{}};
  };
  std::string code = fixture.code();
  std::erase(code, '-');
  const auto first = ask(rpc::CodeCredential{code});
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(first))
      << (std::holds_alternative<rpc::ErrorReply>(first) ? std::get<rpc::ErrorReply>(first).text : "no answer");
  Secret<32> wrong = std::get<rpc::Welcome>(first).resume_secret;
  wrong.bytes[0] ^= std::byte{1};
  const auto refused = ask(rpc::ResumeCredential{wrong});
  ASSERT_TRUE(std::holds_alternative<rpc::ErrorReply>(refused));
  EXPECT_EQ(std::get<rpc::ErrorReply>(refused).code, rpc::ErrorCode::kResume);
  const auto back = ask(rpc::ResumeCredential{std::get<rpc::Welcome>(first).resume_secret});
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(back)) << std::get<rpc::ErrorReply>(back).text;
  EXPECT_EQ(std::get<rpc::Welcome>(back).seat, "trainee");
  EXPECT_NE(std::get<rpc::Welcome>(back).resume_secret, std::get<rpc::Welcome>(first).resume_secret);
  const auto old = ask(rpc::ResumeCredential{std::get<rpc::Welcome>(first).resume_secret});
  EXPECT_TRUE(std::holds_alternative<rpc::ErrorReply>(old)) << "a secret is replaced by the next one";
}

// ---- Monitoring ----

std::string http(const std::string& address, const std::string& request) {
  const auto to = io::parse_address(address, 1);
  const io::Fd socket{::socket(to->family(), SOCK_STREAM | SOCK_CLOEXEC, 0)};
  if (::connect(socket.get(), to->get(), to->size) != 0) return "";
  ::send(socket.get(), request.data(), request.size(), MSG_NOSIGNAL);
  std::string answer;
  std::array<char, 4096> part;
  for (ssize_t n = 0; (n = ::recv(socket.get(), part.data(), part.size(), 0)) > 0;)
    answer.append(part.data(), static_cast<std::size_t>(n));
  return answer;
}

TEST(Monitoring, ShowsMetricsHealthAndNothingElse) {
  Process host = hosting("one_axis", {"--metrics", "127.0.0.1:0"});
  std::string metrics = host.after("metrics on http://");
  metrics = metrics.substr(0, metrics.find('/'));
  ASSERT_FALSE(metrics.empty()) << host.out();
  Process trainer = client(address_of(host), "trainer");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  const std::string page = http(metrics, "GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(page.starts_with("HTTP/1.1 200 OK\r\n")) << page;
  for (const char* line :
       {"tandem_session_moves_total 0", "tandem_shard_sessions{tick_hz=\"1000\",shard=\"0\"} 1",
        "tandem_tick_seconds_bucket{tick_hz=\"1000\",shard=\"0\",le=\"0.0001\"}", "tandem_tick_late_total{",
        "tandem_loop_age_seconds{session=\"one_axis\",seat=\"trainer\"}", "tandem_gate_state{",
        "tandem_authority{session=\"one_axis\",seat=\"trainer\"} ", "tandem_joins_total{result=\"welcomed\"} 1",
        "tandem_udp_drop_total{reason=\"tag\"} 0", "tandem_sessions{phase=\"running\"} 1",
        "tandem_audit_events_lost_total{session=\"one_axis\"} 0", "# TYPE tandem_tick_seconds histogram"})
    EXPECT_NE(page.find(line), std::string::npos) << line << "\n" << page;
  EXPECT_NE(http(metrics, "GET /healthz HTTP/1.0\r\n\r\n").find("200 OK"), std::string::npos);
  EXPECT_NE(http(metrics, "GET /readyz HTTP/1.1\r\nHost: " + metrics + "\r\n\r\n").find("200 OK"), std::string::npos);
  EXPECT_NE(http(metrics, "GET /etc/passwd HTTP/1.1\r\nHost: [::1]\r\n\r\n").find("404"), std::string::npos);
  EXPECT_NE(http(metrics, "POST /metrics HTTP/1.1\r\nContent-Length: 0\r\n\r\n").find("405"), std::string::npos);
  EXPECT_NE(http(metrics, "\r\n\r\n").find("400"), std::string::npos);
  EXPECT_NE(http(metrics, "GET /metrics HTTP/1.1\r\n\r\n").find("400"), std::string::npos);
  EXPECT_NE(http(metrics, "GET /metrics HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n").find("400"),
            std::string::npos);
  const std::string rebound = http(metrics, "GET /metrics HTTP/1.1\r\nhost: attacker.example:80\r\n\r\n");
  EXPECT_NE(rebound.find("421"), std::string::npos) << rebound;
  EXPECT_EQ(rebound.find("tandem_"), std::string::npos) << rebound;
  EXPECT_EQ(http(metrics, std::string(5000, 'x')), "") << "longer than any request";
  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
}

TEST(Monitoring, ReportsWhyABusyServerRejectsJoins) {
  const Folder folder;
  // A tick has 100 us, of which 1 us is the limit. Each session simulates its arm in every tick.
  std::string scene = pressing();
  scene.replace(scene.find("tick_hz: 1000"), 13, "tick_hz: 10000");
  folder.write("press.textproto", scene);
  std::string config =
      "version: 1 listen: \"127.0.0.1:0\" metrics: \"127.0.0.1:0\" limits { core_percent: 1 threads: 1 }";
  for (int n = 0; n < 24; ++n) config += " session { name: \"s" + std::to_string(n) + "\" scene: \"press.textproto\" }";
  Process host = serving(folder.write("s.textproto", config));
  std::string metrics = host.after("metrics on http://");
  metrics = metrics.substr(0, metrics.find('/'));
  // Known after the first second.
  double load = 0;
  for (int tries = 0; tries < 3000 && load == 0; ++tries) {
    const std::string page = http(metrics, "GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n"),
                      name = "\ntandem_core_load{tick_hz=\"10000\",shard=\"0\"} ";
    const auto at = page.find(name);
    if (at != std::string::npos) load = std::atof(page.c_str() + at + name.size());
    if (load == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_GT(load, 0.01) << "24 simulated arms take more than 1 us on any machine";
  Process trainee = client(address_of(host), "trainee", {"--session", "s3"});
  EXPECT_EQ(trainee.wait(), 1);
  EXPECT_NE(trainee.err().find("rejects new joins"), std::string::npos) << trainee.err();
  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST(Monitoring, LogsOneJsonObjectPerLine) {
  Process host = hosting("one_axis", {"--log", "json", "--duration", "0.5"});
  Process trainer = client(address_of(host), "trainer");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0);
  std::istringstream lines(host.err());
  std::string events;
  for (std::string line; std::getline(lines, line);) {
    const Json json = Json::parse(line, nullptr, false);
    ASSERT_TRUE(json.is_object()) << line;
    for (const char* key : {"ts", "mono", "level", "event"}) EXPECT_TRUE(json.contains(key)) << line;
    events += json["event"].get<std::string>() + " ";
    if (json["event"] == "seat-joined") {
      EXPECT_EQ(json["session"], "one_axis");
      EXPECT_EQ(json["seat"], "trainer");
      EXPECT_GT(json["cid"].get<std::uint32_t>(), 0u);
    }
    if (json["event"] == "running") {
      EXPECT_TRUE(json["tick"].is_number()) << line;
    }
  }
  for (const char* event : {"session_opened", "seat-joined", "joined", "running", "session_over", "stopped"})
    EXPECT_NE(events.find(event), std::string::npos) << event << ": " << events;
}

TEST(Monitoring, NotifiesASupervisorOfReadinessLivenessAndEnd) {
  const Folder folder;
  const std::string path = folder.file("notify");
  const io::Fd socket{::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)};
  sockaddr_un at{};
  at.sun_family = AF_UNIX;
  path.copy(at.sun_path, sizeof at.sun_path - 1);
  ASSERT_EQ(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at), 0);
  setenv("NOTIFY_SOCKET", path.c_str(), 1);
  Process host = hosting("one_axis");
  unsetenv("NOTIFY_SOCKET");
  const timeval timeout{30, 0};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  const auto next = [&] {
    std::array<char, 64> text;
    const ssize_t size = ::recv(socket.get(), text.data(), text.size(), 0);
    return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string("nothing came");
  };
  EXPECT_EQ(next(), "READY=1");
  EXPECT_EQ(next(), "WATCHDOG=1");
  host.signal(SIGTERM);
  std::string last = next();
  while (last == "WATCHDOG=1") last = next();
  EXPECT_EQ(last, "STOPPING=1");
  EXPECT_EQ(host.wait(), 0) << host.err();
}

}  // namespace
}  // namespace tandem::test
