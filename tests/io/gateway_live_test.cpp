// Open pages of tandem-console: live values, orders, limits, loss and return of the server.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>

#include <chrono>
#include <list>
#include <map>
#include <thread>

#include "tests/io/free_address.h"
#include "tests/io/machine_witness.h"
#include "tests/io/metrics_page.h"
#include "tests/io/multi_client_fixture.h"
#include "tests/io/slow_disk.h"
#include "tests/io/web_fixture.h"

namespace tandem::test {
namespace {

TEST(GatewayLive, ShowsHandsAndToolAndTakesOrders) {
  const Process host = hosting("one_axis");
  const Process trainer = client(address_of(host), "trainer");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  WebPage page = gateway.page();
  const Json hello = page.next("hello"), scene = page.next("scene");
  EXPECT_EQ(hello["role"], "INSTRUCTOR");
  EXPECT_EQ(scene["tick_hz"], 1000);
  EXPECT_EQ(scene["seats"][0]["name"], "trainer");
  const auto moved = [](const Json& state) {
    return state["phase"] == "RUNNING" && state["seats"][0]["x"].is_array() && state["tools"][0]["x"].is_array() &&
           std::abs(state["tools"][0]["x"][0].get<double>()) > 1e-3 && state["seats"][0]["rtt_ms"].is_number();
  };
  const Json running = state_where(page, moved);
  ASSERT_FALSE(running.is_null());
  EXPECT_EQ(running["seats"][0]["engaged"], true);
  EXPECT_TRUE(running["age_ms"].is_number());
  std::int64_t tick = 0, n = 0, states = 0;
  for (; states < 120; ++states) {  // each is newer than the one before
    const Json state = page.next("state");
    ASSERT_FALSE(state.is_null());
    ASSERT_GE(state["tick"].get<std::int64_t>(), tick);
    ASSERT_GT(state["n"].get<std::int64_t>(), n);
    tick = state["tick"];
    n = state["n"];
  }
  EXPECT_EQ(page.order({{"order", "stop"}, {"why", "a hand"}})["ok"], true);
  const Json stopped = state_where(page, [](const Json& state) {
    return state["phase"] == "STOPPED" && state["stop"].is_object();  // datagrams and status come on two ways
  });
  ASSERT_FALSE(stopped.is_null());
  EXPECT_EQ(stopped["stop"]["why"], "a hand");
  EXPECT_EQ(stopped["stop"]["yours"], true);
  EXPECT_EQ(page.order({{"order", "resume"}, {"stop", stopped["stop"]["number"]}})["ok"], true);
  const Json event = page.next("event");
  ASSERT_FALSE(event.is_null());
  EXPECT_NE(event["text"].get<std::string>().find("stop 1 is over"), std::string::npos) << event;
  const Json resumed = state_where(page, [](const Json& state) { return state["phase"] == "RUNNING"; });
  EXPECT_TRUE(resumed["stop"].is_null());
}

TEST(GatewayLive, WarnsThatAStopWasCarriedOutAndIsNotStored) {
  const Folder folder;
  const std::string disk = folder.write("disk", "nospace");
  Process host(on_slow_disk(disk, {TANDEM_SERVER, "run", "one_axis", "--listen", free_address()}));
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  WebGateway gateway(address_of(host));
  gateway.open_url();
  WebPage page = gateway.page();
  static_cast<void>(page.next("state"));
  EXPECT_EQ(page.order({{"order", "stop"}, {"why", "a hand"}})["ok"], true);
  const Json warned = page.until([](const Json& m) { return m["type"] == "notice" && m["level"] == "warning"; });
  ASSERT_FALSE(warned.is_null());
  const std::string text = warned["text"];
  EXPECT_EQ(text.find("the session is STOPPED, but this is not stored yet: "), 0u) << text;
  EXPECT_NE(text.find("No space left on device"), std::string::npos) << text;
}

TEST(GatewayLive, SendsThreeStatesAtMostWithoutAcknowledgement) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  WebPage fast = gateway.page(), slow(gateway.at, gateway.cookie);
  for (int n = 0; n < 120; ++n) ASSERT_FALSE(fast.next("state").is_null());
  // `slow` did not read meanwhile, so it acknowledged nothing: three states wait for it, then newer ones come.
  const Json first = slow.next("state"), second = slow.next("state"), third = slow.next("state"),
             next = slow.next("state");
  EXPECT_EQ(third["n"], 3);
  EXPECT_EQ(next["n"], 4);
  EXPECT_GT(next["dropped"].get<int>(), third["dropped"].get<int>() + 30) << next;
}

TEST(GatewayLive, ClosesFloodsAndFramesThatAreNone) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  WebPage flood = gateway.page(), large = gateway.page(), junk = gateway.page(), good = gateway.page();
  for (int n = 0; n < 600 && flood.send(Json{{"type", "ack"}, {"n", 0}}); ++n) {
  }
  EXPECT_TRUE(flood.until([](const Json&) { return false; }).is_null());
  EXPECT_EQ(flood.close_code(), 1008U) << flood.close_reason();
  large.send(std::string(20000, ' '));
  EXPECT_TRUE(large.until([](const Json&) { return false; }).is_null());
  EXPECT_EQ(large.close_code(), 1009U);
  junk.send(std::string("no JSON"));
  EXPECT_TRUE(junk.until([](const Json&) { return false; }).is_null());
  EXPECT_EQ(junk.close_code(), 1008U);
  good.send(Json{{"type", "launch"}, {"id", 5}});
  const Json reply = good.next("reply");
  EXPECT_EQ(reply["ok"], false);
  EXPECT_EQ(reply["id"], 5);
  EXPECT_FALSE(good.next("state").is_null()) << "others do not notice";
}

TEST(GatewayLive, DropsABrowserThatDoesNotRead) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  WebPage stalled(gateway.at, gateway.cookie, {}, true), good = gateway.page();
  // It acknowledges what it never read, so that the gateway always has more for it.
  bool open = true;
  for (std::uint64_t n = 1; open && n < 6000; ++n) {
    open = stalled.send(Json{{"type", "ack"}, {"n", n}});
    stalled.send(Json{{"type", "launch"}, {"id", n}});
    std::this_thread::sleep_for(std::chrono::milliseconds(18));
  }
  EXPECT_FALSE(open) << "the gateway closed the connection";
  EXPECT_FALSE(good.next("state").is_null());
}

/// Four sessions on one server without keys of its own, so that a gateway on this computer may see all of them.
struct FourSessions {
  Folder folder;
  Process host =
      serving(folder.write("s.textproto",
                           "version: 1 listen: \"127.0.0.1:0\" metrics: \"127.0.0.1:0\"\n"
                           "session { name: \"a\" scene: \"one_axis\" } session { name: \"b\" scene: \"one_axis\" }\n"
                           "session { name: \"c\" scene: \"one_axis\" } session { name: \"d\" scene: \"one_axis\" }"));
  std::string address = address_of(host);
};

TEST(GatewayLive, ServesThirtyPagesOnFourSessions) {
  FourSessions four;
  WebGateway gateway(four.address, {"--session", "a"});
  ASSERT_NE(gateway.at.port, 0) << gateway.process.err();
  gateway.open_url();
  std::vector<WebPage> pages;
  for (int n = 0; n < 30; ++n) {
    pages.push_back(gateway.page());
    ASSERT_EQ(pages.back().status(), 101U) << n;
  }
  std::map<std::string, std::string> sessions;  // id by name
  const Json hello = pages[0].until([](const Json& m) { return m["type"] == "hello" && m["sessions"].size() == 4; });
  for (const Json& session : hello["sessions"]) sessions[session["name"]] = session["id"];
  ASSERT_EQ(sessions.size(), 4U);
  const char* names[] = {"a", "b", "c", "d"};
  for (std::size_t k = 0; k < pages.size(); ++k) {
    const std::string id = sessions[names[k % 4]];
    ASSERT_TRUE(pages[k].send(Json{{"type", "watch"}, {"id", 1}, {"session", id}}));
    EXPECT_EQ(pages[k].next("reply")["ok"], true) << k;
    const Json scene = pages[k].until([&id](const Json& m) { return m["type"] == "scene" && m["session"] == id; });
    EXPECT_EQ(scene["name"], names[k % 4]);
  }
  for (int round = 0; round < 30; ++round)
    for (std::size_t k = 0; k < pages.size(); ++k) {
      const Json state = pages[k].next("state");
      ASSERT_FALSE(state.is_null()) << k;
      if (round < 29) continue;
      EXPECT_TRUE(state["age_ms"].is_number()) << k << ": by datagrams";
    }
  // All pages share one place of a watching console, so that another one finds room.
  Process watching({TANDEM_CLIENT, "watch", "--server", four.address, "--session", "b"});
  EXPECT_TRUE(watching.wait_for("waiting")) << watching.err();
  pages[0].send(Json{{"type", "watch"}, {"id", 2}, {"session", std::string(32, '0')}});
  EXPECT_EQ(pages[0].next("reply")["ok"], false);
  pages[1].send(Json{{"type", "order"}, {"id", 3}, {"order", "stop"}, {"why", "only b"}});
  EXPECT_EQ(pages[1].next("reply")["ok"], true);
  EXPECT_FALSE(state_where(pages[1], [](const Json& s) { return s["stop"].is_object(); }).is_null());
  EXPECT_TRUE(pages[0].next("state")["stop"].is_null()) << "an order is for the watched session";
}

TEST(GatewayLive, ComesBackAfterTheServerWasKilled) {
  Process host = hosting("one_axis");
  const std::string address = address_of(host);
  WebGateway gateway(address);
  gateway.open_url();
  WebPage page = gateway.page();
  const std::string before = page.next("scene")["session"];
  host.signal(SIGKILL);
  EXPECT_EQ(host.wait(), -SIGKILL);
  const Json lost = page.until([](const Json& m) { return m["type"] == "notice" && m["level"] == "error"; });
  EXPECT_NE(lost["text"].get<std::string>().find("trying again"), std::string::npos) << lost;
  EXPECT_EQ(lost["server"], "lost");
  EXPECT_EQ(page.order({{"order", "stop"}, {"why", "x"}})["ok"], false);
  const Process again = hosting("one_axis", {"--listen", address});
  const Json back = page.until([](const Json& m) { return m["type"] == "notice" && m["level"] == "info"; });
  EXPECT_EQ(back["server"], "back") << back;
  const Json scene = page.until([&](const Json& m) { return m["type"] == "scene" && m["session"] != before; });
  EXPECT_FALSE(scene.is_null());
  EXPECT_FALSE(state_where(page, [](const Json& s) { return s["age_ms"].is_number(); }).is_null());
}

/// A socket that listens at this address of loopback.
io::Fd listener(const std::string& address) {
  io::Fd socket{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.find(':') + 1))));
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int on = 1;
  ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  EXPECT_EQ(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at), 0);
  EXPECT_EQ(::listen(socket.get(), 8), 0);
  return socket;
}
io::Fd first_connection(const io::Fd& listener) {
  pollfd file{listener.get(), POLLIN, 0};
  EXPECT_EQ(::poll(&file, 1, 30000), 1);
  return io::Fd{::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC)};
}
bool is_open(const io::Fd& connection) {
  pollfd file{connection.get(), POLLRDHUP, 0};
  return connection.get() >= 0 && ::poll(&file, 1, 0) == 0;
}

/// Another program has the server's port and is silent, so that the gateway waits for it when the order comes.
TEST(GatewayLive, RefusesAnOrderWithoutAServerAtOnceAndNeverCarriesItOutLater) {
  Process host = hosting("one_axis");
  const std::string address = address_of(host);
  WebGateway gateway(address, {"--timeout", "5"});
  gateway.open_url();
  WebPage page = gateway.page();
  EXPECT_FALSE(page.next("scene").is_null());
  EXPECT_EQ(http_get(gateway.at, "/healthz").status, 200U);
  host.signal(SIGKILL);
  EXPECT_EQ(host.wait(), -SIGKILL);
  io::Fd silent = listener(address);
  const auto is = [](const char* server) {
    return [server](const Json& m) { return m["type"] == "notice" && m["server"] == server; };
  };
  EXPECT_FALSE(page.until(is("lost")).is_null());
  EXPECT_TRUE(gateway.process.wait_for("the connection to the server is lost (")) << gateway.process.err();
  const HttpReply health = http_get(gateway.at, "/healthz");
  EXPECT_EQ(health.status, 503U);
  EXPECT_NE(health.body.find("no connection to a server: "), std::string::npos) << health.body;
  const io::Fd asked = first_connection(silent);
  ASSERT_TRUE(is_open(asked)) << "the gateway joins again";
  const Json reply = page.order({{"order", "stop"}, {"why", "too late"}});
  EXPECT_EQ(reply["ok"], false);
  EXPECT_NE(reply["text"].get<std::string>().find("not carried out"), std::string::npos) << reply;
  EXPECT_TRUE(is_open(asked)) << "it was refused before that join has ended";
  silent = {};
  const Process again = hosting("one_axis", {"--listen", address});
  EXPECT_FALSE(page.until(is("back")).is_null());
  EXPECT_TRUE(gateway.process.wait_for("the connection to the server is back")) << gateway.process.err();
  EXPECT_EQ(http_get(gateway.at, "/healthz").status, 200U);
  EXPECT_EQ(page.order({{"order", "stop"}, {"why", "first"}})["ok"], true);
  const Json state = state_where(page, [](const Json& s) { return s["stop"].is_object(); });
  EXPECT_EQ(state["stop"]["number"], 1) << state << " the order of before was not carried out";
}

TEST(GatewayLive, ShowsLiveValuesAgainAfterItWasStopped) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  WebPage page = gateway.page();
  EXPECT_FALSE(state_where(page, [](const Json& s) { return s["age_ms"].is_number(); }).is_null());
  gateway.process.signal(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::seconds(4));  // the server sends nothing to a watcher that is silent so long
  gateway.process.signal(SIGCONT);
  unsigned seen = 0;  // more states than those of before that wait for the page
  EXPECT_FALSE(state_where(page, [&](const Json& s) { return s["age_ms"].is_number() && ++seen == 60; }).is_null());
}

TEST(GatewayLive, FallsBackToTheStatusWithoutAPlaceToWatch) {
  const Process host = hosting("one_axis");
  std::list<Process> watching;
  for (int n = 0; n < 8; ++n) {
    watching.push_back(Process({TANDEM_CLIENT, "watch", "--server", address_of(host)}));
    ASSERT_TRUE(watching.back().wait_for("s waiting")) << watching.back().err();
  }
  WebGateway gateway(address_of(host));
  gateway.open_url();
  WebPage page = gateway.page();
  const Json warned = page.next("notice");
  EXPECT_EQ(warned["level"], "warning");
  EXPECT_NE(warned["text"].get<std::string>().find("all 8 places"), std::string::npos) << warned;
  EXPECT_TRUE(warned["text"].get<std::string>().ends_with("; the page shows the status five times per second"));
  const Json state = page.next("state");
  EXPECT_TRUE(state["age_ms"].is_null());
  EXPECT_EQ(state["phase"], "WAITING");
  watching.front().signal(SIGINT);
  EXPECT_EQ(watching.front().wait(), 0);
  EXPECT_FALSE(state_where(page, [](const Json& s) { return s["age_ms"].is_number(); }).is_null()) << "a place is free";
}

/// Ticks that began more than 1 ms late, and all ticks.
struct TickCounts {
  double late = 0, all = 0;
};
TickCounts ticks_of(const std::string& metrics) {
  const std::string text = page(metrics);
  const auto sum = [&text](const std::string& name) {
    double total = 0;
    for (std::size_t at = text.find("\n" + name); at != std::string::npos; at = text.find("\n" + name, at + 1)) {
      const std::size_t line = text.find('\n', at + 1);
      total += std::strtod(text.c_str() + text.rfind(' ', line) + 1, nullptr);
    }
    return total;
  };
  return {sum("tandem_tick_late_total"), sum("tandem_tick_lateness_seconds_count")};
}

// The same run without and with a gateway that is flooded and then killed. The rate of late ticks may not rise; a
// machine that stands still by itself is not judged.
TEST(GatewayLive, KilledAndFloodedItMakesNoTickOfTheServerLate) {
  repeat_disturbed("a flooded gateway beside a server", [] {
    FourSessions four;
    std::string metrics = four.host.after("metrics on http://");
    metrics = metrics.substr(0, metrics.find('/'));
    EXPECT_FALSE(metrics.empty()) << four.host.out();
    const Process trainer = client(four.address, "trainer", {"--session", "a"});
    MachineWitness witness;
    const auto phase = [&metrics](const auto& work) {
      const TickCounts before = ticks_of(metrics);
      work();
      const TickCounts after = ticks_of(metrics);
      return TickCounts{after.late - before.late, after.all - before.all};
    };
    const TickCounts quiet = phase([] { std::this_thread::sleep_for(std::chrono::seconds(2)); });
    const TickCounts flooded = phase([&four] {
      WebGateway gateway(four.address, {"--session", "a"});
      gateway.open_url();
      for (int round = 0; round < 20; ++round) {
        WebPage flood = gateway.page();
        for (int n = 0; n < 500 && flood.send(Json{{"type", "ack"}, {"n", 0}}); ++n) {
        }
        for (int n = 0; n < 20; ++n) static_cast<void>(http_get(gateway.at, "/?token=" + std::to_string(n)));
      }
      WebPage page = gateway.page();
      EXPECT_FALSE(page.next("state").is_null());
      gateway.process.signal(SIGKILL);
      EXPECT_EQ(gateway.process.wait(), -SIGKILL);
      std::this_thread::sleep_for(std::chrono::seconds(3));  // the server notices that the watcher is gone
    });
    EXPECT_GT(quiet.all, 1000);
    EXPECT_GT(flooded.all, 1000);
    std::printf("[ gateway  ] late ticks: quiet %.0f of %.0f, with the gateway %.0f of %.0f\n", quiet.late, quiet.all,
                flooded.late, flooded.all);
    if (witness.machine_stood_still()) return false;
    EXPECT_LE(flooded.late / flooded.all, quiet.late / quiet.all + 0.02);
    Process sessions({TANDEM_CLIENT, "sessions", "--server", four.address, "--json"});
    EXPECT_EQ(sessions.wait(), 0) << sessions.err();
    EXPECT_NE(sessions.out().find("\"running\""), std::string::npos) << "no seat changed\n" << sessions.out();
    return true;
  });
}

}  // namespace
}  // namespace tandem::test
