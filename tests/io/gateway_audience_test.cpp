// The audience of tandem-console: many pages that watch without a ticket. Real programs on loopback.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "tests/io/cut_path.h"
#include "tests/io/multi_client_fixture.h"
#include "tests/io/web_fixture.h"

namespace tandem::test {
namespace {

std::size_t open_files(const Process& process) {
  const std::filesystem::directory_iterator files("/proc/" + std::to_string(process.id()) + "/fd");
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}
/// Opens /watch as a browser with these cookies does.
HttpReply watch(const WebAddress& at, const Fields& fields = {}) { return http_get(at, "/watch", fields); }
/// Whether the page may take a seat in the browser.
bool offers_seats(const Json& hello) {
  const Json& may = hello["may"];
  return std::ranges::find(may, Json("seat")) != may.end();
}
bool is_live(const Json& state) { return state["age_ms"].is_number(); }

TEST(GatewayAudience, WatchesWithoutATicketAndCostsTheServerNothingMore) {
  constexpr std::size_t kPages = 200;
  const Process host = hosting("one_axis");
  const Process trainer = client(address_of(host), "trainer");
  WebGateway gateway(address_of(host), {"--audience", std::to_string(kPages), "--allow-browser-seats"});
  gateway.open_url();
  gateway.process.wait_for("/watch\n");
  WebPage instructor = gateway.page();
  EXPECT_TRUE(offers_seats(instructor.next("hello")));
  ASSERT_FALSE(state_where(instructor, is_live).is_null());
  const HttpReply admitted = watch(gateway.at);
  ASSERT_EQ(admitted.status, 303U) << admitted.body;
  EXPECT_EQ(admitted.fields.at("location"), "/");
  const std::string cookie = cookie_of(admitted);
  ASSERT_FALSE(cookie.empty());
  const std::size_t before = open_files(host);
  std::vector<WebPage> pages;
  for (std::size_t n = 0; n < kPages; ++n) {
    pages.emplace_back(gateway.at, cookie);
    ASSERT_EQ(pages.back().status(), 101U) << n;
  }
  const Json hello = pages[0].next("hello");
  EXPECT_EQ(hello["role"], "OBSERVER");
  EXPECT_FALSE(offers_seats(hello)) << hello;
  for (std::size_t n = 0; n < kPages; ++n) ASSERT_FALSE(state_where(pages[n], is_live).is_null()) << n;
  EXPECT_EQ(open_files(host), before) << "the server has a connection for the gateway, not for each page";
  EXPECT_EQ(WebPage(gateway.at, cookie).status(), 503U) << "one page too many";
  EXPECT_EQ(watch(gateway.at).status, 503U);
  EXPECT_EQ(gateway.page().status(), 101U) << "the audience takes no place of other persons";

  const Json refused = pages[0].order({{"order", "stop"}, {"why", "by a spectator"}});
  EXPECT_EQ(refused["ok"], false) << refused;
  pages[1].send(Json{{"type", "take"}, {"id", 8}, {"seat", "trainee"}, {"ticket", "ticket:AAAA"}});
  EXPECT_EQ(pages[1].next("reply")["text"], "the audience only watches; sign in at /join with a ticket");
  pages[2].send(Json{{"type", "invite"}, {"id", 8}});
  EXPECT_EQ(pages[2].next("reply")["ok"], false);
  EXPECT_EQ(instructor.order({{"order", "stop"}, {"why", "look"}})["ok"], true);
  EXPECT_FALSE(state_where(pages[3], [](const Json& s) { return s["stop"].is_object(); }).is_null());

  const HttpReply kept = watch(gateway.at, {{"Cookie", gateway.cookie}});
  EXPECT_EQ(kept.status, 303U);
  EXPECT_EQ(cookie_of(kept), "") << "a person keeps their own rights";
}

TEST(GatewayAudience, WatchesWhereEachPersonSignsIn) {
  const MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  const auto ticket = [&](const std::string& role) {
    Process made(
        {TANDEM_SERVER, "ticket", "--session", "a", "--workstation", "desk", "--role", role, "--state", fixture.state});
    EXPECT_EQ(made.wait(), 0) << made.err();
    fixture.folder.write(role + ".ticket", made.out());
    return fixture.folder.file(role + ".ticket");
  };
  const auto refusal = [&](Words more, int code) {
    Words words{TANDEM_CONSOLE, "--server", fixture.address, "--listen", "127.0.0.1:0", "--state", fixture.own};
    words.insert(words.end(), more.begin(), more.end());
    Process process(std::move(words));
    EXPECT_EQ(process.wait(), code);
    return process.err();
  };
  EXPECT_NE(refusal({"--sign-in", "--audience", "5"}, 2).find("give it with --audience-ticket FILE"),
            std::string::npos);
  EXPECT_NE(refusal({"--sign-in", "--audience-ticket", ticket("observer")}, 2).find("--audience N"), std::string::npos);
  EXPECT_NE(refusal({"--sign-in", "--audience", "5", "--audience-ticket", "none"}, 2).find("--audience-ticket: none"),
            std::string::npos);
  EXPECT_NE(refusal({"--sign-in", "--audience", "5", "--audience-ticket", ticket("operator")}, 1)
                .find("the audience may only"),
            std::string::npos);

  const WebGateway gateway(fixture.address, {"--sign-in", "--state", fixture.own, "--audience", "5",
                                             "--audience-ticket", ticket("observer"), "--return-within", "1"});
  WebPage page(gateway.at, cookie_of(watch(gateway.at)));
  EXPECT_EQ(page.next("hello")["role"], "OBSERVER");
  // Persons may stay away for 1 s. The audience stays longer.
  unsigned seen = 0;
  EXPECT_TRUE(is_live(state_where(page, [&](const Json& s) { return is_live(s) && ++seen == 200; })));
}

TEST(GatewayAudience, GivesThePlaceOfAPageThatVanishedToAnother) {
  const Process host = hosting("one_axis");
  const WebGateway gateway(address_of(host), {"--audience", "1"});
  const std::string cookie = cookie_of(watch(gateway.at));
  const WebPage vanished(gateway.at, cookie);  // it reads nothing, as a computer that sleeps
  ASSERT_EQ(vanished.status(), 101U);
  EXPECT_EQ(WebPage(gateway.at, cookie).status(), 503U);
  unsigned status = 0;
  for (int attempt = 0; attempt < 120 && status != 101; ++attempt) {
    std::this_thread::sleep_for(std::chrono::milliseconds{500});
    status = WebPage(gateway.at, cookie).status();
  }
  EXPECT_EQ(status, 101U);
}

/// A gateway whose audience watches by a ticket.
WebGateway with_ticket(const MultiClientFixture& fixture, const std::string& server) {
  Process made({TANDEM_SERVER, "ticket", "--session", "a", "--workstation", "desk", "--role", "observer", "--state",
                fixture.state});
  EXPECT_EQ(made.wait(), 0) << made.err();
  fixture.folder.write("observer.ticket", made.out());
  return WebGateway(server, {"--sign-in", "--state", fixture.own, "--audience", "5", "--audience-ticket",
                             fixture.folder.file("observer.ticket")});
}

TEST(GatewayAudience, SeesLiveValuesAgainAfterAGapOfTheNetwork) {
  const MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  CutPath path(fixture.address);
  const WebGateway gateway = with_ticket(fixture, path.address());
  WebPage page(gateway.at, cookie_of(watch(gateway.at)));
  ASSERT_FALSE(state_where(page, is_live).is_null());
  const auto notices = [&page](const char* server) {
    return !page.until([&](const Json& m) { return m["type"] == "notice" && m.value("server", "") == server; })
                .is_null();
  };
  path.cut_datagrams();
  ASSERT_FALSE(state_where(page, [](const Json& state) { return !is_live(state); }).is_null());
  path.heal();
  EXPECT_FALSE(state_where(page, is_live).is_null()) << "its ticket was used";
  path.cut();
  ASSERT_TRUE(notices("lost"));
  path.heal();
  EXPECT_TRUE(notices("back")) << "its ticket was used";
  EXPECT_FALSE(state_where(page, is_live).is_null());
}

TEST(GatewayAudience, SaysThatItsConnectionIsLost) {
  const MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  WebGateway gateway = with_ticket(fixture, fixture.address);
  ASSERT_EQ(watch(gateway.at).status, 303U);
  fixture.host.signal(SIGKILL);
  HttpReply reply;
  for (int attempt = 0; attempt < 300 && reply.status != 503; ++attempt) {
    std::this_thread::sleep_for(std::chrono::milliseconds{100});
    reply = watch(gateway.at);
  }
  EXPECT_EQ(reply.status, 503U);
  EXPECT_NE(reply.body.find("must start it again with a new ticket"), std::string::npos) << reply.body;
  EXPECT_TRUE(gateway.process.wait_for("the audience has lost its connection")) << gateway.process.err();
}

TEST(GatewayAudience, IsNoneUnlessItIsAllowed) {
  const Process host = hosting("one_axis");
  const WebGateway gateway(address_of(host));
  const HttpReply reply = watch(gateway.at);
  EXPECT_EQ(reply.status, 404U);
  EXPECT_NE(reply.body.find("--audience N"), std::string::npos) << reply.body;
  EXPECT_EQ(cookie_of(reply), "");
}

}  // namespace
}  // namespace tandem::test
