// Decisions of the gateway without sockets: tokens, origins, frames of browsers and their rights.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "proto/rpc/rpc_texts.h"
#include "server/console/acknowledgement_window.h"
#include "server/console/browser_frame.h"
#include "server/console/one_time_token.h"
#include "server/console/request_rules.h"

namespace tandem::console {
namespace {

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

TEST(RequestRules, SplitTheHostIntoNameAndPort) {
  const auto is = [](std::string_view host, std::string_view name, unsigned port) {
    const HostName split = split_host(host, 443);
    return split.name == name && split.port == port;
  };
  EXPECT_TRUE(is("127.0.0.1:7080", "127.0.0.1", 7080));
  EXPECT_TRUE(is("lab.example", "lab.example", 443)) << "the usual port";
  EXPECT_TRUE(is("[::1]:7080", "::1", 7080));
  EXPECT_TRUE(is("[::1]", "::1", 443));
  for (const char* host : {"", ":7080", "a:", "a:b", "a:70800", "a:-1", "a:80x", "[::1", "[::1]80", "a:80:90"})
    EXPECT_TRUE(split_host(host, 443).name.empty() || std::string_view(host) == ":7080") << host;
  EXPECT_TRUE(is_loopback_name("127.0.0.1") && is_loopback_name("localhost") && is_loopback_name("::1"));
  for (const char* name : {"", "evil.example", "127.0.0.1.evil.example", "127.0.0.2", "localhost."})
    EXPECT_FALSE(is_loopback_name(name)) << name;
}

TEST(RequestRules, AcceptTheOwnOriginOnly) {
  EXPECT_TRUE(origin_allowed("http://127.0.0.1:7080", "127.0.0.1:7080", false));
  EXPECT_TRUE(origin_allowed("https://lab.example", "lab.example", true));
  for (const char* origin :
       {"", "null", "http://localhost:7080", "http://127.0.0.1:70800", "https://127.0.0.1:7080", "http://evil.example"})
    EXPECT_FALSE(origin_allowed(origin, "127.0.0.1:7080", false)) << origin;
  EXPECT_FALSE(origin_allowed("http://127.0.0.1:7080", "127.0.0.1:7080", true)) << "TLS needs https";
  EXPECT_FALSE(origin_allowed("http://", "", false));
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
      {R"({"type":"order","id":1,"order":"pause","why":""})", {kInstructor, kEvaluator, kOperator}},
      {R"({"type":"order","id":1,"order":"resume","stop":1})", {kInstructor, kEvaluator, kOperator}},
      {R"({"type":"order","id":1,"order":"authority","tool":0,"version":0,"alpha":[1]})", {kInstructor}},
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

/// The page checks names before it sends them.
TEST(Names, HaveOneRuleInServerAndPage) {
  std::ifstream file(TANDEM_PAGE_NAMES);
  const std::string source{std::istreambuf_iterator<char>(file), {}};
  const std::regex line(R"(kNamePattern = '\[(.*)\]\{1,(\d+)\}';)");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(source, found, line)) << TANDEM_PAGE_NAMES;
  const std::regex page("[" + std::regex_replace(found[1].str(), std::regex(R"(\\\\)"), "\\") + "]{1," +
                        found[2].str() + "}");
  for (int c = 1; c < 128; ++c) {
    const std::string text(1, static_cast<char>(c));
    EXPECT_EQ(std::regex_match(text, page), rpc::is_name(text)) << c;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, rpc::kNameMax, rpc::kNameMax + 1}) {
    const std::string text(size, 'x');
    EXPECT_EQ(std::regex_match(text, page), rpc::is_name(text)) << size;
  }
}

}  // namespace
}  // namespace tandem::console
