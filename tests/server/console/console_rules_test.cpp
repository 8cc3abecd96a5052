// Decisions of the gateway without sockets: tokens, cookies, origins, frames of browsers and their rights, JSON.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "proto/rpc/rpc_messages.h"
#include "server/console/acknowledgement_window.h"
#include "server/console/browser_frame.h"
#include "server/console/live_json.h"
#include "server/console/one_time_token.h"
#include "server/console/request_rules.h"

namespace tandem::console {
namespace {

using nlohmann::json;
using std::chrono_literals::operator""s;

constexpr rpc::Id kId{std::byte{0xab}};

auto parse(std::string_view text, AccessRole role = AccessRole::kInstructor) {
  return parse_browser_frame(text, role, kId);
}

TEST(OneTimeToken, IsValidOnceAndUntilItExpires) {
  OneTimeToken token("abc", Time{} + 10s);
  EXPECT_FALSE(token.redeem("", Time{}));
  EXPECT_FALSE(token.redeem("abd", Time{}));
  EXPECT_FALSE(token.redeem("abcd", Time{}));
  EXPECT_TRUE(token.redeem("abc", Time{} + 9s));
  EXPECT_FALSE(token.redeem("abc", Time{} + 9s)) << "second use";
  EXPECT_FALSE(token.redeem("", Time{} + 9s)) << "a redeemed token equals no text";
  OneTimeToken late("abc", Time{} + 10s);
  EXPECT_FALSE(late.redeem("abc", Time{} + 10s));
}

TEST(BrowserCookies, AreBoundedAndForgetTheOldest) {
  BrowserCookies cookies;
  EXPECT_FALSE(cookies.contains(""));
  for (std::size_t i = 0; i <= BrowserCookies::kMax; ++i) cookies.add("c" + std::to_string(i));
  EXPECT_FALSE(cookies.contains("c0"));
  EXPECT_TRUE(cookies.contains("c1"));
  EXPECT_TRUE(cookies.contains("c" + std::to_string(BrowserCookies::kMax)));
  EXPECT_FALSE(cookies.contains(""));
}

TEST(RequestRules, AcceptTheOwnHostAndOriginOnly) {
  EXPECT_TRUE(host_allowed("127.0.0.1:7080", 7080));
  EXPECT_TRUE(host_allowed("localhost:7080", 7080));
  EXPECT_TRUE(host_allowed("[::1]:7080", 7080));
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:7081", "evil.example:7080", "127.0.0.1.evil.example:7080",
                           "127.0.0.1:17080", ":7080"})
    EXPECT_FALSE(host_allowed(host, 7080)) << host;
  EXPECT_TRUE(origin_allowed("http://127.0.0.1:7080", "127.0.0.1:7080"));
  for (const char* origin :
       {"", "null", "http://localhost:7080", "http://127.0.0.1:70800", "https://127.0.0.1:7080", "http://evil.example"})
    EXPECT_FALSE(origin_allowed(origin, "127.0.0.1:7080")) << origin;
  EXPECT_FALSE(origin_allowed("http://", ""));
}

TEST(RequestRules, FindTheCookieAndTheToken) {
  EXPECT_EQ(cookie_value("tandem=1f", "tandem"), "1f");
  EXPECT_EQ(cookie_value("a=b; tandem=1f; c=d", "tandem"), "1f");
  EXPECT_EQ(cookie_value("xtandem=1f; tandemx=2", "tandem"), "");
  EXPECT_EQ(cookie_value(";;; =", "tandem"), "");
  EXPECT_EQ(token_of("/?token=12"), "12");
  EXPECT_EQ(token_of("/"), "");
  EXPECT_EQ(token_of("/x?token=12"), "");
}

TEST(BrowserFrame, BecomesTheMessageOfTheServer) {
  const auto stop = parse(R"({"type":"order","id":7,"order":"stop","why":"a hand"})");
  ASSERT_TRUE(stop);
  EXPECT_EQ(std::get<Order>(*stop).id, 7U);
  EXPECT_EQ(std::get<rpc::StopSession>(std::get<Order>(*stop).body), (rpc::StopSession{kId, "a hand"}));
  const auto authority =
      parse(R"({"type":"order","id":1,"order":"authority","tool":0,"version":5,"alpha":[0.25,0.75]})");
  ASSERT_TRUE(authority);
  EXPECT_EQ(std::get<rpc::SetAuthority>(std::get<Order>(*authority).body),
            (rpc::SetAuthority{kId, 0, 5, {0.25, 0.75}}));
  const auto ack = parse(R"({"type":"ack","n":123})");
  ASSERT_TRUE(ack);
  EXPECT_EQ(std::get<Ack>(*ack).n, 123U);
}

TEST(BrowserFrame, IsRefusedOutOfRange) {
  for (const char* text :
       {R"({"type":"order","id":1,"order":"authority","tool":0,"version":5,"alpha":[0.5,0.6]})",
        R"({"type":"order","id":1,"order":"authority","tool":0,"version":5,"alpha":[-0.5,1.5]})",
        R"({"type":"order","id":1,"order":"authority","tool":0,"version":5,"alpha":[]})",
        R"({"type":"order","id":1,"order":"authority","tool":0,"version":5,"alpha":[1,null]})",
        R"({"type":"order","id":1,"order":"authority","tool":9999,"version":5,"alpha":[1]})",
        R"({"type":"order","id":1,"order":"authority","tool":0,"version":4294967296,"alpha":[1]})",
        R"({"type":"order","id":1,"order":"stop","why":"\u001b[2J"})", R"({"type":"order","id":1,"order":"stop"})",
        R"({"type":"order","id":1,"order":"stop","why":"x","more":1})", R"({"type":"order","id":1,"order":"format"})",
        R"({"type":"order","id":1,"order":"drain","grace_s":3601})",
        R"({"type":"order","id":1,"order":"resume","stop":-1})", R"({"type":"launch","id":1})"}) {
    const auto frame = parse(text, AccessRole::kInstructor);
    ASSERT_FALSE(frame) << text;
    EXPECT_FALSE(frame.error().close) << text;
    EXPECT_EQ(frame.error().id, 1U) << text;
    EXPECT_FALSE(frame.error().text.empty()) << text;
  }
  for (const std::string text : {"", "[", "[]", "1", "null", "{", "{\"type\":NaN}"}) {
    const auto frame = parse(text);
    ASSERT_FALSE(frame) << text;
    EXPECT_TRUE(frame.error().close) << text;
  }
  EXPECT_FALSE(parse(std::string(kFrameMax, '['))) << "deep nesting ends without a crash";
}

// An independent copy of the rights: one row per order, the roles that may give it.
TEST(BrowserFrame, IsRefusedForRolesWithoutTheRight) {
  using enum AccessRole;
  const std::pair<const char*, std::vector<AccessRole>> rows[] = {
      {R"({"type":"order","id":1,"order":"stop","why":""})", {kInstructor, kOperator}},
      {R"({"type":"order","id":1,"order":"pause","why":""})", {kInstructor, kTrainee, kEvaluator, kOperator}},
      {R"({"type":"order","id":1,"order":"resume","stop":1})", {kInstructor, kTrainee, kEvaluator, kOperator}},
      {R"({"type":"order","id":1,"order":"authority","tool":0,"version":0,"alpha":[1]})", {kInstructor, kTrainee}},
      {R"({"type":"order","id":1,"order":"remove","seat":"trainee","why":""})", {kInstructor, kOperator}},
      {R"({"type":"order","id":1,"order":"drain","grace_s":1})", {kOperator}}};
  for (const auto& [text, roles] : rows)
    for (std::uint8_t r = 0; r < kAccessRoles; ++r) {
      const auto role = static_cast<AccessRole>(r);
      const bool may = std::ranges::find(roles, role) != roles.end();
      EXPECT_EQ(parse(text, role).has_value(), may) << text << " as " << to_text(role);
    }
}

TEST(AcknowledgementWindow, SendsThreeAndDropsUntilOneIsAcknowledged) {
  AcknowledgementWindow window;
  EXPECT_EQ(window.next(), 1U);
  EXPECT_EQ(window.next(), 2U);
  EXPECT_EQ(window.next(), 3U);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(window.next(), 0U);
  EXPECT_EQ(window.dropped(), 1000U);
  EXPECT_FALSE(window.acknowledge(4)) << "never sent";
  EXPECT_EQ(window.next(), 0U);
  EXPECT_TRUE(window.acknowledge(2));
  EXPECT_TRUE(window.acknowledge(1)) << "late, without effect";
  EXPECT_EQ(window.next(), 4U);
  EXPECT_EQ(window.next(), 5U);
  EXPECT_EQ(window.next(), 0U);
}

TEST(LiveJson, WritesNullForUnknownAndNotFiniteValues) {
  rpc::Status status;
  status.session_id = kId;
  status.name = "contact";
  status.time_s = std::numeric_limits<double>::quiet_NaN();
  status.seats = {{"trainer", AccessRole::kInstructor, true, true, true}};
  status.tools = {{"tool0", {std::numeric_limits<double>::infinity()}}};
  status.held = "\xff broken";
  const json state = json::parse(state_json(status, 4, 2, 9));
  EXPECT_TRUE(state["t"].is_null());
  EXPECT_TRUE(state["tools"][0]["wanted"][0].is_null());
  EXPECT_TRUE(state["seats"][0]["rtt_ms"].is_null());
  EXPECT_TRUE(state["stop"].is_null());
  EXPECT_EQ(state["n"], 4);
  EXPECT_EQ(state["dropped"], 2);
  const json hello = json::parse(hello_json(status, AccessRole::kEvaluator, "1"));
  EXPECT_EQ(hello["may"], json({"pause", "resume"}));
  EXPECT_EQ(hello["role"], "EVALUATOR");
  EXPECT_EQ(hello["sessions"][0]["id"], "ab000000000000000000000000000000");
  EXPECT_TRUE(json::parse(reply_json({}, false, "x"))["id"].is_null());
}

}  // namespace
}  // namespace tandem::console
