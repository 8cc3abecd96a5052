// Seats that persons hold in browsers: tandem-console with real servers and clients.
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <vector>

#include "tests/io/cut_path.h"
#include "tests/io/web_fixture.h"

namespace tandem::test {
namespace {

/// Returns a page of another browser, by an invitation of this one.
WebPage invited(WebGateway& gateway, WebPage& page) {
  page.send(Json{{"type", "invite"}, {"id", 77}});
  const Json reply = page.next("reply");
  EXPECT_EQ(reply["ok"], true) << reply;
  const std::string cookie = cookie_of(http_get(gateway.at, reply["text"].get<std::string>()));
  EXPECT_FALSE(cookie.empty());
  return WebPage(gateway.at, cookie);
}

Json take(WebPage& page, const std::string& seat, const std::string& ticket = {}) {
  Json wish{{"type", "take"}, {"id", 5}, {"seat", seat}};
  if (!ticket.empty()) wish["ticket"] = ticket;
  page.send(wish);
  return page.next("reply");
}

/// Returns the page's seat once a condition holds for it; null: it never did.
template <class Condition>
Json seat_where(WebPage& page, Condition condition) {
  return page.until([&](const Json& message) { return message["type"] == "seat" && condition(message); });
}
bool held(const Json& seat) { return seat["engaged"] == true && seat["phase"] == "RUNNING"; }

void point(WebPage& page, const Json& x, bool pressed = true) {
  page.send(Json{{"type", "pointer"}, {"x", x}, {"pressed", pressed}});
}

TEST(BrowserSeats, LetTwoBrowsersShareATool) {
  const Process host = hosting("lesson");
  WebGateway gateway(address_of(host), {"--allow-browser-seats"});
  gateway.open_url();
  WebPage leader = gateway.page();
  const Json hello = leader.next("hello");
  EXPECT_NE(hello["may"].dump().find("\"seat\""), std::string::npos) << hello;
  WebPage follower = invited(gateway, leader);
  EXPECT_EQ(take(leader, "instructor")["ok"], true);
  EXPECT_EQ(take(follower, "trainee")["ok"], true);
  const Json began = seat_where(leader, held);
  ASSERT_FALSE(began.is_null());
  ASSERT_FALSE(seat_where(follower, held).is_null());
  EXPECT_EQ(began["alpha"], 1) << "the scene gives the tool to the instructor";
  // The follower rests, and the leader points 20 mm to the side: tool and follower come along.
  Json aim = began["x"];
  const double to = aim[0].get<double>() + 0.02;
  aim[0] = to;
  Json moved;
  for (int n = 0; n < 1200 && moved.is_null(); ++n) {
    point(leader, aim);
    const Json state = leader.next("state");
    ASSERT_FALSE(state.is_null());
    const Json &tool = state["tools"][0]["x"], &hand = state["seats"][1]["x"];
    if (tool.is_array() && hand.is_array() && std::abs(tool[0].get<double>() - to) < 0.003 &&
        std::abs(hand[0].get<double>() - to) < 0.006)
      moved = state;
  }
  ASSERT_FALSE(moved.is_null()) << "neither tool nor follower came within 20 s";
  // The follower resists: both feel a force, up to the limit of the seat.
  const Json resists = began["x"];
  bool felt = false;
  for (int n = 0; n < 1200 && !felt; ++n) {
    point(leader, aim);
    point(follower, resists);
    ASSERT_FALSE(leader.next("state").is_null());
    const Json seat = follower.next("seat");
    ASSERT_FALSE(seat.is_null());
    const double force = seat["f"].is_array() ? std::abs(seat["f"][0].get<double>()) : 0;
    EXPECT_LE(force, seat["force_limit_n"].get<double>());
    felt = force > 0.2;
  }
  EXPECT_TRUE(felt);
  // One leaves; the other sees the seat free.
  follower.send(Json{{"type", "leave"}, {"id", 6}});
  EXPECT_EQ(seat_where(follower, [](const Json& seat) { return seat["ended"].is_string(); })["ended"], "left");
  EXPECT_FALSE(state_where(leader, [](const Json& state) { return state["seats"][1]["taken"] == false; }).is_null());
}

TEST(BrowserSeats, AreFreeAfterTheirPageIsGone) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host), {"--allow-browser-seats"});
  gateway.open_url();
  WebPage stays = gateway.page();
  {
    WebPage goes = invited(gateway, stays);
    EXPECT_EQ(take(goes, "trainer")["ok"], true);
    ASSERT_FALSE(state_where(stays, [](const Json& state) { return state["seats"][0]["taken"] == true; }).is_null());
  }
  ASSERT_FALSE(state_where(stays, [](const Json& state) { return state["seats"][0]["taken"] == false; }).is_null());
  EXPECT_EQ(take(stays, "trainer")["ok"], true);
  EXPECT_FALSE(seat_where(stays, [](const Json& seat) { return seat["joined"] == true; }).is_null());
}

TEST(BrowserSeats, AreRefusedWithTheReason) {
  const Process host = hosting("one_axis");
  const Process trainer = client(address_of(host), "trainer");
  WebGateway none(address_of(host)), gateway(address_of(host), {"--allow-browser-seats"});
  none.open_url();
  WebPage without = none.page();
  EXPECT_NE(take(without, "trainer")["text"].get<std::string>().find("--allow-browser-seats"), std::string::npos);
  gateway.open_url();
  WebPage page = gateway.page();
  page.send(Json{{"type", "leave"}, {"id", 3}});
  EXPECT_EQ(page.next("reply")["text"], "this page has no seat");
  ASSERT_FALSE(state_where(page, [](const Json& state) { return state["seats"][0]["taken"] == true; }).is_null());
  for (const char* seat : {"trainer", "absent"}) {
    EXPECT_EQ(take(page, seat)["ok"], true) << "the server decides, and its reply comes with the seat";
    const Json over = seat_where(page, [](const Json& s) { return s["ended"].is_string(); });
    ASSERT_FALSE(over.is_null());
    EXPECT_EQ(over["joined"], false);
    EXPECT_NE(over["ended"].get<std::string>().find(seat), std::string::npos) << over;
  }
}

TEST(BrowserSeats, EndWithTheReasonIfNoDatagramArrives) {
  const Process host = hosting("one_axis");
  CutPath path(address_of(host));
  path.cut_datagrams();
  WebGateway gateway(path.address(), {"--allow-browser-seats"});
  gateway.open_url();
  WebPage page = gateway.page();
  EXPECT_EQ(take(page, "trainer")["ok"], true);
  const Json over = seat_where(page, [](const Json& seat) { return seat["ended"].is_string(); });
  ASSERT_FALSE(over.is_null());
  EXPECT_NE(over["ended"].get<std::string>().find("may block UDP"), std::string::npos) << over;
  EXPECT_EQ(take(page, "trainee")["ok"], true) << "the place at the gateway is free";
}

TEST(BrowserSeats, EndWithTheGateway) {
  const Process host = hosting("one_axis");
  WebGateway gateway(address_of(host), {"--allow-browser-seats"});
  gateway.open_url();
  WebPage page = gateway.page();
  EXPECT_EQ(take(page, "trainer")["ok"], true);
  ASSERT_FALSE(seat_where(page, held).is_null());
  gateway.process.signal(SIGINT);
  EXPECT_EQ(gateway.process.wait(), 0) << gateway.process.err();
  WebGateway next(address_of(host));
  next.open_url();
  WebPage later = next.page();
  EXPECT_FALSE(state_where(later, [](const Json& state) { return state["seats"][0]["taken"] == false; }).is_null());
}

TEST(ConsolePlay, GivesAToolAndAPartnerWithOneCommand) {
  Process play({TANDEM_CONSOLE, "--play", "--listen", "127.0.0.1:0"});
  ASSERT_TRUE(play.wait_for("/join\n")) << play.err();
  const std::string url = play.after("once: http://127.0.0.1:");
  const WebAddress at{static_cast<std::uint16_t>(std::stoul(url)), false};
  WebPage page(at, cookie_of(http_get(at, url.substr(url.find('/')))));
  const Json hello = page.next("hello");
  EXPECT_EQ(hello["play"], "instructor");
  EXPECT_EQ(take(page, "instructor")["ok"], true);
  const Json began = seat_where(page, held);
  ASSERT_FALSE(began.is_null());
  EXPECT_FALSE(state_where(page, [](const Json& state) { return state["seats"][1]["engaged"] == true; }).is_null())
      << "the simulated partner";
  play.signal(SIGINT);
  EXPECT_EQ(play.wait(), 0) << play.err();
}

}  // namespace
}  // namespace tandem::test
