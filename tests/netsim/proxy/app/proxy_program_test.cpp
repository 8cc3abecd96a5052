// Running live proxy from the user's side: control socket, rejections, notes, log, lateness verdict and status view.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "netsim/profiles/decision_csv.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/proxy/app/proxy_control.h"
#include "netsim/proxy/app/proxy_report.h"
#include "netsim/proxy/app/proxy_status_view.h"
#include "tests/netsim/proxy/app/running_proxy.h"
#include "tests/support/process.h"

namespace tandem::netsim {
namespace {

using namespace test;
using namespace std::chrono_literals;
using tandem::test::Process;
using Json = nlohmann::json;

Process netsim(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), TANDEM_NETSIM_PROGRAM);
  return Process(std::move(arguments));
}

struct Asked {
  int code;
  std::string out, err;
};
Asked ask(const std::string& socket, std::vector<std::string> words) {
  words.insert(words.begin(), {"control", socket});
  Process process = netsim(std::move(words));
  const int code = process.wait().value_or(-99);
  return {code, process.out(), process.err()};
}

std::string read(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Control, ChangesAndLogsTheNetworkOfARunningProxy) {
  UdpPeer server, client;
  const std::string socket = testing::TempDir() + "control.sock", json = testing::TempDir() + "control.json";
  Process proxy = netsim({"proxy", "--to", io::to_text(server.address()), "--control", socket, "--json", json});
  ASSERT_TRUE(proxy.wait_for("Ctrl-C ends"));
  struct stat file{};
  ASSERT_EQ(::stat(socket.c_str(), &file), 0);
  EXPECT_EQ(file.st_mode & 0777, 0600U);
  client.connect(*io::parse_address(proxy.after("listening on "), 1));
  ASSERT_TRUE(client.send("1"));
  EXPECT_EQ(server.receive()->bytes, "1");

  Asked asked{.code = 2, .out = {}, .err = {}};  // the status with the client may be slightly old
  for (int i = 0; i < 1000 && asked.code == 2; ++i) asked = ask(socket, {"loss", "100", "client", "1"});
  ASSERT_EQ(asked.code, 0) << asked.err;
  EXPECT_NE(asked.out.find("done at "), std::string::npos);
  ASSERT_TRUE(client.send("2"));
  EXPECT_FALSE(server.receive(100));
  EXPECT_EQ(ask(socket, {"reset"}).code, 0);
  ASSERT_TRUE(client.send("3"));
  EXPECT_EQ(server.receive()->bytes, "3");
  EXPECT_EQ(ask(socket, {"outage 1h hold"}).code, 0);
  ASSERT_TRUE(client.send("4"));
  EXPECT_FALSE(server.receive(100));
  const Asked status = ask(socket, {"status", "--json"});
  EXPECT_EQ(status.code, 0);
  EXPECT_EQ(Json::parse(status.out)["changes"].size(), 3U);
  Asked words = ask(socket, {"status"});  // the status may be slightly old
  for (int i = 0; i < 1000 && words.out.find("1 under way") == std::string::npos; ++i) words = ask(socket, {"status"});
  EXPECT_NE(words.out.find("1 under way"), std::string::npos) << words.out;
  EXPECT_EQ(words.out.find("at the end"), std::string::npos) << "it has not ended: " << words.out;

  const std::vector<std::pair<std::string, std::string>> wrong{{"delay 20 client 9", "no client 9; present: 1"},
                                                               {"profile wifi-bussy", "did you mean wifi-busy?"},
                                                               {"profile ./none.textproto", "No such file"},
                                                               {"fly", "not a command"}};
  for (const auto& [line, says] : wrong) {
    const Asked refused = ask(socket, {line});
    EXPECT_EQ(refused.code, 2) << line;
    EXPECT_NE(refused.err.find(says), std::string::npos) << refused.err;
    EXPECT_EQ(refused.out, "");
  }
  EXPECT_EQ(ask(socket, {"stop"}).code, 0);
  EXPECT_EQ(proxy.wait(), 0);
  EXPECT_FALSE(std::filesystem::exists(socket));
  EXPECT_NE(proxy.out().find("loss 100 client 1"), std::string::npos) << proxy.out();
  const Json report = Json::parse(read(json));
  ASSERT_EQ(report["changes"].size(), 3U);
  EXPECT_EQ(report["changes"][1]["command"], "reset");
  EXPECT_LE(report["changes"][0]["at_s"], report["changes"][1]["at_s"]);
  EXPECT_EQ(report["up"]["dropped_lost"], 1);
  EXPECT_EQ(ask(socket, {"status"}).code, 1);  // the proxy has ended
}

TEST(Control, RejectsASocketInUseAndReplacesAStaleOne) {
  const std::string socket = testing::TempDir() + "left.sock", file = testing::TempDir() + "no.sock";
  std::ofstream(file) << "not a socket";
  Process first = netsim({"proxy", "--to", "127.0.0.1:9", "--control", socket});
  ASSERT_TRUE(first.wait_for("Ctrl-C ends"));
  Process second = netsim({"proxy", "--to", "127.0.0.1:9", "--control", socket});
  EXPECT_EQ(second.wait(), 2);
  EXPECT_NE(second.err().find("another proxy"), std::string::npos) << second.err();
  Process third = netsim({"proxy", "--to", "127.0.0.1:9", "--control", file});
  EXPECT_EQ(third.wait(), 2);
  EXPECT_EQ(read(file), "not a socket");
  first.signal(SIGKILL);
  first.wait();
  ASSERT_TRUE(std::filesystem::exists(socket));
  Process fourth = netsim({"proxy", "--to", "127.0.0.1:9", "--control", socket});
  ASSERT_TRUE(fourth.wait_for("Ctrl-C ends"));
  EXPECT_EQ(ask(socket, {"status"}).code, 0);
  fourth.signal(SIGINT);
  EXPECT_EQ(fourth.wait(), 0);
}

TEST(Program, ExitsWithOneAboveMaxLateness) {
  UdpPeer server, client;
  for (const bool strict : {true, false}) {
    // No datagram is within 1 us; all are within 10 s.
    Process proxy = netsim(
        {"proxy", "--to", io::to_text(server.address()), "--delay", "1", "--max-lateness", strict ? "1" : "10000000"});
    ASSERT_TRUE(proxy.wait_for("Ctrl-C ends"));
    client.connect(*io::parse_address(proxy.after("listening on "), 1));
    for (int i = 0; i < 50; ++i) {
      ASSERT_TRUE(client.send("x"));
      ASSERT_TRUE(server.receive());
    }
    proxy.signal(SIGTERM);
    EXPECT_EQ(proxy.wait(), strict ? 1 : 0);
    EXPECT_EQ(proxy.out().find("TOO LATE: p99 ") != std::string::npos, strict) << proxy.out();
    EXPECT_NE(proxy.out().find("own error: sent later than scheduled by p50"), std::string::npos) << proxy.out();
  }
}

TEST(Program, FailsMaxLatenessIfNothingWasMeasured) {
  const std::string json = testing::TempDir() + "nothing.json";
  Process proxy =
      netsim({"proxy", "--to", "127.0.0.1:9", "--duration", "0.05", "--max-lateness", "10000000", "--json", json});
  EXPECT_EQ(proxy.wait(), 1);
  EXPECT_NE(proxy.out().find("NOTHING WAS JUDGED"), std::string::npos) << proxy.out();
  const Json lateness = Json::parse(read(json))["lateness"];
  EXPECT_EQ(lateness["judged"], false);
  EXPECT_EQ(lateness["in_time"], false);
}

TEST(Program, ReportsTheResultOfEachProxyEvent) {
  UdpPeer server, client;
  const std::string json = testing::TempDir() + "events.json", script = testing::TempDir() + "events.textproto";
  std::ofstream(script) << "event { at_s: 0 client: \"1\" outage_ms: 3600000 }\nevent { at_s: 0 profile: \"lan\" }\n"
                           "event { at_s: 3600 client: \"1\" rebind { dead_after_ms: 1 } }\n";
  Process proxy = netsim({"proxy", "--to", io::to_text(server.address()), "--script", script, "--json", json});
  ASSERT_TRUE(proxy.wait_for("Ctrl-C ends"));
  client.connect(*io::parse_address(proxy.after("listening on "), 1));
  // The outage drops all datagrams of one client; a datagram of the other shows that the first was read.
  ASSERT_TRUE(client.send("x"));
  UdpPeer other;
  other.connect(*io::parse_address(proxy.after("listening on "), 1));
  ASSERT_TRUE(other.send("y"));
  ASSERT_TRUE(server.receive());
  proxy.signal(SIGINT);
  EXPECT_EQ(proxy.wait(), 0);
  for (const char* part :
       {"event at 0.000 s: outage of 3600 s, for client 1: unfinished; it was not over when the proxy ended",
        "event at 0.000 s: network lan: applied\n",
        "event at 3600.000 s: new address, the old one dead after 1 ms, for client 1: not-reached; the proxy ended "
        "before it"})
    EXPECT_NE(proxy.out().find(part), std::string::npos) << part << " not in\n" << proxy.out();
  const Json events = Json::parse(read(json))["events"];
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0]["fate"], "unfinished");
  EXPECT_EQ(events[1]["fate"], "applied");
  EXPECT_TRUE(events[1]["until_s"].is_null());
  EXPECT_EQ(events[2]["fate"], "not-reached");
  EXPECT_EQ(events[2]["at_s"], 3600);
}

TEST(Program, ReportsAProxyEndedEarlyAsInterrupted) {
  const std::string json = testing::TempDir() + "short.json";
  Process proxy = netsim({"proxy", "--to", "127.0.0.1:9", "--duration", "3600", "--json", json});
  ASSERT_TRUE(proxy.wait_for("Ctrl-C ends"));
  proxy.signal(SIGINT);
  EXPECT_EQ(proxy.wait(), 1);
  EXPECT_NE(proxy.err().find("tandem-netsim proxy: interrupted after "), std::string::npos) << proxy.err();
  EXPECT_NE(proxy.out().find("0 clients"), std::string::npos) << proxy.out();
  EXPECT_EQ(Json::parse(read(json))["interrupted"], true);
}

/// Control socket whose proxy never answers.
TEST(Control, ReportsAnInterruptedWait) {
  const std::string socket = testing::TempDir() + "mute.sock";
  std::filesystem::remove(socket);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  socket.copy(address.sun_path, sizeof address.sun_path - 1);
  const io::Fd listening{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  ASSERT_EQ(::bind(listening.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::listen(listening.get(), 1), 0);
  Process control = netsim({"control", socket, "delay", "20"});
  pollfd comes{listening.get(), POLLIN, 0};
  ASSERT_EQ(::poll(&comes, 1, UdpPeer::kPatienceMs), 1);  // signals are blocked before it connects
  const io::Fd asker{::accept(listening.get(), nullptr, nullptr)};
  control.signal(SIGINT);
  EXPECT_EQ(control.wait(), 1);
  EXPECT_NE(control.err().find("tandem-netsim control: interrupted after the command was sent"), std::string::npos)
      << control.err();
}

TEST(Program, LogsEveryProxyDecisionAndFollowsAScript) {
  UdpPeer server, client;
  const std::string log = testing::TempDir() + "proxy.csv", script = testing::TempDir() + "script.textproto";
  std::ofstream(script) << "event { at_s: 0 client: \"1\" outage_ms: 3600000 }\n";
  Process proxy =
      netsim({"proxy", "--to", io::to_text(server.address()), "--script", script, "--log", log, "--delay", "5"});
  ASSERT_TRUE(proxy.wait_for("Ctrl-C ends"));
  const auto address = *io::parse_address(proxy.after("listening on "), 1);
  client.connect(address);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(client.send("down for an hour"));
  UdpPeer other;
  other.connect(address);
  ASSERT_TRUE(other.send("up"));
  EXPECT_EQ(server.receive()->bytes, "up");
  proxy.signal(SIGINT);
  EXPECT_EQ(proxy.wait(), 0);
  const auto rows = parse_decision_csv(read(log), log);
  ASSERT_TRUE(rows) << to_text(rows.error());
  ASSERT_EQ(rows->size(), 21U);
  EXPECT_EQ(std::ranges::count(*rows, Outcome::kOutage, &Decision::outcome), 20);
  EXPECT_EQ(std::ranges::count(*rows, Outcome::kDeliver, &Decision::outcome), 1);
  // The time decided by the network, to the nanosecond, not the actual time of sending.
  const auto passed = std::ranges::find(*rows, Outcome::kDeliver, &Decision::outcome);
  EXPECT_EQ(passed->out - passed->in, 5ms);

  std::ofstream(script) << "event { at_s: 1 client: \"trainee\" outage_ms: 1 }\n";
  Process wrong = netsim({"proxy", "--to", "127.0.0.1:9", "--script", script});
  EXPECT_EQ(wrong.wait(), 2);
  EXPECT_NE(wrong.err().find(script + ":1:"), std::string::npos) << wrong.err();
}

// Commands executed in the same process: effect of a change on all clients, one client, one direction and later
// clients.
TEST(ProxyControl, ChangesAllOneOrOneDirectionAndFutureClients) {
  UdpPeer server, a, b, late;
  Running proxy{server.address(), {}};
  ProxyControl control{*proxy, {}, [](const std::string& name) -> std::expected<ProxyControl::Network, std::string> {
                         if (name == "deaf")
                           return ProxyControl::Network{link_from({.loss = 1}), {"half of a round trip"}};
                         return std::unexpected("no network " + name);
                       }};
  a.connect(proxy->listening());
  b.connect(proxy->listening());
  ASSERT_TRUE(a.send("a"));
  const auto address_a = server.receive()->from;
  ASSERT_TRUE(b.send("b"));
  const auto address_b = server.receive()->from;
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.clients == 2; }));
  const auto passes = [&](UdpPeer& client) {
    EXPECT_TRUE(client.send("x"));
    return server.receive(100).has_value();
  };

  const auto deaf = control.execute("profile deaf client 2 up");
  EXPECT_TRUE(deaf.done);
  EXPECT_NE(deaf.text.find("\nnote: half of a round trip\n"), std::string::npos) << deaf.text;
  EXPECT_EQ(control.changes()[0].notes, std::vector<std::string>{"half of a round trip"});
  EXPECT_TRUE(passes(a));
  EXPECT_FALSE(passes(b));
  ASSERT_TRUE(server.send_to(address_b, "down is open"));
  EXPECT_EQ(b.receive()->bytes, "down is open");

  EXPECT_TRUE(control.execute("loss 100").done);  // all clients, including later ones
  EXPECT_FALSE(passes(a));
  late.connect(proxy->listening());
  EXPECT_FALSE(passes(late));
  ASSERT_TRUE(server.send_to(address_a, "lost"));
  EXPECT_FALSE(a.receive(100));

  EXPECT_TRUE(control.execute("loss 0 client 1").done);
  EXPECT_TRUE(passes(a));
  EXPECT_FALSE(passes(late));
  EXPECT_TRUE(control.execute("reset").done);
  EXPECT_TRUE(passes(a));
  EXPECT_TRUE(passes(b));
  EXPECT_TRUE(passes(late));

  const auto refused = control.execute("profile nowhere");
  EXPECT_FALSE(refused.understood);
  EXPECT_NE(refused.text.find("no network nowhere"), std::string::npos);
  EXPECT_EQ(control.changes().size(), 4U);
  proxy.end();
  EXPECT_FALSE(control.execute("delay 1").done);  // after the end: an error instead of waiting
}

// 29 bytes with headers take 232 ms at 1 kbit/s: a hundred of them stay in the queue for longer than any test.
TEST(ProxyStatusView, ShowsQueuedAndInFlightDatagramsPerClient) {
  UdpPeer server, busy, quiet;
  LinkSpec link;
  link.up.rate.bits_per_s = 1000;
  Running proxy{server.address(), link};
  busy.connect(proxy->listening());
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(busy.send("x"));
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.total[0].in == 100; }));
  quiet.connect(proxy->listening());
  ASSERT_TRUE(quiet.send("x"));
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.clients == 2; }));
  const ProxyStatus status = proxy->status();
  EXPECT_GT(status.client[0].queue[0], Duration{}) << "100 datagrams wait for the rate";
  EXPECT_LE(status.client[0].queue[0], std::chrono::milliseconds(100 * 232));
  EXPECT_LT(status.client[1].queue[0], status.client[0].queue[0]) << "a queue of its own";
  EXPECT_EQ(status.client[0].queue[1], Duration{}) << "no rate down";
  EXPECT_NE(status_text(status).find("waiting in the queue now: up "), std::string::npos) << status_text(status);
  const auto json = nlohmann::json::parse(status_json(status, {}));
  EXPECT_EQ(json["clients"][0]["up"]["queue_ms"].get<double>(), 1e3 * seconds(status.client[0].queue[0]));
  EXPECT_EQ(json["clients"][0]["down"]["queue_ms"], 0.0);

  ProxyStatusView view{*proxy};
  view.take_snapshot();
  const auto table = view.table(5);
  ASSERT_EQ(table.size(), 5U);
  const std::size_t end = table[0].find(" queue") + 6;  // numbers are right-aligned with their heading
  ASSERT_NE(table[0].find(" queue"), std::string::npos) << table[0];
  const double shown = std::stod(table[1].substr(end - 6, 6));
  EXPECT_GT(shown, 1000) << table[1];
  EXPECT_LE(shown, 100 * 232) << table[1];
  EXPECT_EQ(std::stod(table[2].substr(end - 6, 6)), 0) << table[2];
}

TEST(ProxyStatusView, FitsEightyColumnsAndTheGivenRows) {
  UdpPeer server;
  Running proxy{server.address(), {}};
  std::vector<std::unique_ptr<UdpPeer>> clients;
  for (int i = 0; i < 9; ++i) {
    clients.push_back(std::make_unique<UdpPeer>());
    clients.back()->connect(proxy->listening());
    ASSERT_TRUE(clients.back()->send("x"));
    ASSERT_TRUE(server.receive());
  }
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.total[0].out == 9; }));
  ProxyStatusView view{*proxy};
  EXPECT_TRUE(view.line().empty());
  EXPECT_TRUE(view.table(10).empty());
  for (int i = 0; i < 5; ++i) view.take_snapshot();
  const auto line = io::lay_out_items(view.line(), 2, 79);
  ASSERT_FALSE(line.empty());
  EXPECT_NE(line[0].find("9 clients"), std::string::npos) << line[0];
  EXPECT_NE(io::join_items(view.line()).find("late p99"), std::string::npos);
  for (std::size_t rows = 0; rows < 30; ++rows) {
    const auto table = view.table(rows);
    EXPECT_LE(table.size(), rows);
    for (const std::string& row : table) EXPECT_LE(row.size(), 79U) << row;
  }
  for (const std::size_t width : {40U, 60U, 79U, 99U, 199U})
    for (const std::string& row : view.table(30, width)) {
      EXPECT_LE(row.size(), width) << row;
      EXPECT_NE(row.back(), ' ') << "whole columns: " << row;
    }
  EXPECT_EQ(view.table(30).size(), 1U + 2U * 9U);
  EXPECT_NE(view.table(10).back().find("and 5 more"), std::string::npos) << view.table(10).back();
  EXPECT_NE(view.table(30)[1].find("127.0.0.1:"), std::string::npos);
}

}  // namespace
}  // namespace tandem::netsim
