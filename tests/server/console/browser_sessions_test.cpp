// Cookies of browsers with their persons, and the body with which a person signs in.
#include "server/console/browser_sessions.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "common/base/rng.h"
#include "server/console/join_body.h"
#include "tests/common/base/counts.h"

namespace tandem::console {
namespace {

using std::chrono_literals::operator""s;
using Sessions = BrowserSessions<int>;

std::shared_ptr<int> person(int number) { return std::make_shared<int>(number); }

TEST(BrowserSessions, KnowAPersonByTheSecretOnly) {
  Sessions sessions{60s};
  EXPECT_EQ(sessions.find(""), nullptr);
  ASSERT_TRUE(sessions.add("aa", person(1), CookieLife::kLasting, Time{}));
  ASSERT_TRUE(sessions.add("ab", person(2), CookieLife::kLasting, Time{}));
  EXPECT_EQ(*sessions.find("aa"), 1);
  EXPECT_EQ(*sessions.find("ab"), 2);
  for (const char* wrong : {"", "a", "ac", "aaa", "AA"}) EXPECT_EQ(sessions.find(wrong), nullptr) << wrong;
}

TEST(BrowserSessions, EndSixtySecondsAfterTheLastSocket) {
  Sessions sessions{60s};
  ASSERT_TRUE(sessions.add("ticket", person(1), CookieLife::kIdle, Time{}));
  ASSERT_TRUE(sessions.add("house", person(2), CookieLife::kLasting, Time{}));
  sessions.opened("ticket");
  sessions.opened("ticket");
  EXPECT_EQ(sessions.expire(Time{} + 3600s), 0U) << "two sockets are open";
  sessions.closed("ticket", Time{} + 3600s);
  EXPECT_EQ(sessions.expire(Time{} + 7200s), 0U) << "one socket is open";
  sessions.closed("ticket", Time{} + 7200s);
  EXPECT_EQ(sessions.expire(Time{} + 7259s), 0U);
  EXPECT_NE(sessions.find("ticket"), nullptr);
  sessions.closed("ticket", Time{} + 7259s);  // a socket that was never opened changes nothing
  EXPECT_EQ(sessions.expire(Time{} + 7260s), 1U);
  EXPECT_EQ(sessions.find("ticket"), nullptr);
  EXPECT_NE(sessions.find("house"), nullptr) << "it lasts";
  ASSERT_TRUE(sessions.add("never", person(3), CookieLife::kIdle, Time{} + 7260s));
  EXPECT_EQ(sessions.expire(Time{} + 7320s), 1U) << "no socket ever came";
}

TEST(BrowserSessions, ReleaseThePersonAtTheEnd) {
  Sessions sessions{60s};
  auto one = person(1);
  const std::weak_ptr<int> seen = one;
  ASSERT_TRUE(sessions.add("a", std::move(one), CookieLife::kIdle, Time{}));
  EXPECT_FALSE(seen.expired());
  sessions.expire(Time{} + 60s);
  EXPECT_TRUE(seen.expired()) << "the control connection ends with it";
}

TEST(BrowserSessions, AreBoundedAndForgetTheLongestIdle) {
  Sessions sessions{60s};
  for (std::size_t i = 0; i < Sessions::kMax; ++i)
    ASSERT_TRUE(
        sessions.add("c" + std::to_string(i), person(0), CookieLife::kLasting, Time{} + std::chrono::seconds(i)));
  sessions.opened("c0");
  ASSERT_TRUE(sessions.add("new", person(0), CookieLife::kIdle, Time{} + 100s));
  EXPECT_NE(sessions.find("c0"), nullptr) << "its socket is open";
  EXPECT_EQ(sessions.find("c1"), nullptr);
  EXPECT_NE(sessions.find("c2"), nullptr);
  for (std::size_t i = 2; i < Sessions::kMax; ++i) sessions.opened("c" + std::to_string(i));
  sessions.opened("new");
  EXPECT_FALSE(sessions.add("more", person(0), CookieLife::kIdle, Time{} + 200s)) << "all have open sockets";
  EXPECT_EQ(sessions.size(), Sessions::kMax);
}

// All browsers of an audience share one cookie, which the gateway makes once.
TEST(BrowserSessions, KeepAPinnedCookieForAnyNumberOfOthers) {
  Sessions sessions{60s};
  ASSERT_TRUE(sessions.add("audience", person(1), CookieLife::kPinned, Time{}));
  for (std::size_t i = 0; i < 2 * Sessions::kMax; ++i) {
    const CookieLife life = i % 2 == 0 ? CookieLife::kLasting : CookieLife::kIdle;
    ASSERT_TRUE(sessions.add("c" + std::to_string(i), person(2), life, Time{} + std::chrono::seconds(1 + i)));
  }
  EXPECT_NE(sessions.find("audience"), nullptr);
  sessions.expire(Time{} + 3600s);
  EXPECT_NE(sessions.find("audience"), nullptr);
}

// No order of calls ends a cookie with an open socket, or exceeds the bound.
TEST(BrowserSessions, KeepOpenOnesForAnyOrderOfCalls) {
  const std::uint64_t seeds = test::seeds(50);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    RandomStream rng(seed);
    Sessions sessions{60s};
    std::vector<int> open(100);
    Time now{};
    for (int step = 0; step < 1000; ++step) {
      const auto i = static_cast<std::size_t>(rng.below(open.size()));
      const std::string secret = "s" + std::to_string(i);
      now += std::chrono::seconds(rng.below(20));
      switch (rng.below(4)) {
        case 0:
          if (sessions.find(secret) == nullptr)
            static_cast<void>(sessions.add(secret, person(0), CookieLife::kIdle, now));
          break;
        case 1:
          if (sessions.find(secret) != nullptr) {
            sessions.opened(secret);
            ++open[i];
          }
          break;
        case 2:
          if (open[i] > 0) {
            sessions.closed(secret, now);
            --open[i];
          }
          break;
        default:
          sessions.expire(now);
      }
      ASSERT_LE(sessions.size(), Sessions::kMax);
      for (std::size_t k = 0; k < open.size(); ++k) {
        if (open[k] == 0) continue;
        ASSERT_NE(sessions.find("s" + std::to_string(k)), nullptr) << "seed " << seed;
      }
    }
  }
}

constexpr const char *kForm = "application/x-www-form-urlencoded", *kJson = "application/json";

TEST(JoinBody, IsAFormOrJson) {
  const auto form = parse_join_body(kForm, "ticket=ticket%3aABC+%0d%0a&name=ann_1");
  ASSERT_TRUE(form) << form.error();
  EXPECT_EQ(form->ticket, "ticket:ABC") << "without the line break";
  EXPECT_EQ(form->name, "ann_1");
  const auto json = parse_join_body("application/json; charset=utf-8", R"({"ticket":"ticket:ABC"})");
  ASSERT_TRUE(json) << json.error();
  EXPECT_EQ(json->ticket, "ticket:ABC");
  EXPECT_EQ(json->name, "");
  EXPECT_TRUE(parse_join_body(kForm, "ticket=a&name="));
}

TEST(JoinBody, MayHaveANameOfTheProtocol) {
  for (const std::string& name : {std::string("ann_1-B"), std::string(32, 'x'), std::string(" ann ")}) {
    const auto body = parse_join_body(kForm, "ticket=a&name=" + name);
    ASSERT_TRUE(body) << body.error();
    EXPECT_EQ(body->name, name == " ann " ? "ann" : name);
  }
  for (const std::string& name : {std::string("Ann+Lee"), std::string("J%C3%BCrgen"), std::string(33, 'x')}) {
    const auto body = parse_join_body(kForm, "ticket=a&name=" + name);
    ASSERT_FALSE(body) << name;
    EXPECT_EQ(body.error(), "\"name\" must be 1 to 32 characters of A-Z a-z 0-9 _ -");
  }
}

TEST(JoinBody, IsRefusedWithoutItsTicketInTheText) {
  const std::string secret = "ticket:SECRETSECRET";
  const std::pair<const char*, std::string> rows[] = {
      {"text/plain", "ticket=" + secret},
      {"", "ticket=" + secret},
      {kForm, ""},
      {kForm, "ticket"},
      {kForm, "ticket="},
      {kForm, "ticket=" + secret + "&more=1"},
      {kForm, "ticket=" + secret + "%"},
      {kForm, "ticket=" + secret + "%4"},
      {kForm, "ticket=" + secret + "%zz"},
      {kForm, "ticket=" + secret + "&name=%3Cb%3E"},
      {kForm, "ticket=" + secret + "&name=" + std::string(33, 'a')},
      {kForm, "ticket=" + std::string(1025, 'a')},
      {kForm, "ticket=" + secret + "&name=" + std::string(kJoinBodyMax, 'a')},
      {kJson, "{"},
      {kJson, "[]"},
      {kJson, R"({"ticket":1})"},
      {kJson, R"({"ticket":")" + secret + R"(","role":"operator"})"},
      {kJson, std::string(kJoinBodyMax, '[')}};
  for (const auto& [type, text] : rows) {
    const auto body = parse_join_body(type, text);
    ASSERT_FALSE(body) << text;
    EXPECT_FALSE(body.error().empty());
    EXPECT_EQ(body.error().find("SECRET"), std::string::npos) << body.error();
  }
}

}  // namespace
}  // namespace tandem::console
