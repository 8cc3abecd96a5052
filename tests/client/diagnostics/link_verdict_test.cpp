#include "client/diagnostics/link_verdict.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

LinkTestResult perfect() {
  LinkTestResult f;
  f.seconds = 10;
  f.tick_hz = 1000;
  f.up = f.down = LinkTestResult::Direction{10'000, 0, 0, 0.001};
  f.rtt_min = f.rtt_p50 = f.rtt_p99 = f.rtt_max = 0.001;
  f.jitter = 0.0001;
  f.silence_limit = 0.020;
  f.loop_age_max = 0.100;
  f.clock_step = f.transit_step = 0.0;
  f.ticks = 10'000;
  return f;
}

bool advises(const LinkVerdict& v, const std::string& about) {
  for (const std::string& advice : v.advice)
    if (advice.find(about) != std::string::npos) return true;
  return false;
}

TEST(LinkVerdict, ReportsNothingForAPerfectLink) {
  const LinkVerdict v = assess_link(perfect());
  EXPECT_EQ(v.grade, LinkGrade::kGood);
  EXPECT_TRUE(v.advice.empty());
  EXPECT_NE(v.text.find("one room"), std::string::npos);
}

TEST(LinkVerdict, NamesEachProblemAndItsRemedy) {
  struct Case {
    const char* what;
    std::function<void(LinkTestResult&)> spoil;
    LinkGrade grade;
    const char* advice;
  };
  const Case cases[] = {
      {"slow", [](auto& f) { f.rtt_p50 = f.rtt_p99 = 0.080; }, LinkGrade::kUsable, "nearer server"},
      {"too old", [](auto& f) { f.rtt_p50 = f.rtt_p99 = 0.099; }, LinkGrade::kBad, "loop_age_max 100 ms"},
      {"a bit slow", [](auto& f) { f.rtt_p50 = 0.01, f.rtt_p99 = 0.021; }, LinkGrade::kUsable, "round trips of 21 ms"},
      {"jitter", [](auto& f) { f.jitter = 0.008; }, LinkGrade::kUsable, "Wi-Fi"},
      {"much jitter", [](auto& f) { f.jitter = 0.012; }, LinkGrade::kBad, "Wi-Fi"},
      {"a little loss", [](auto& f) { f.up->lost = 20; }, LinkGrade::kUsable, "0.2 % lost on the way up"},
      {"some loss up", [](auto& f) { f.up->lost = 500; }, LinkGrade::kUsable, "5 % lost on the way up"},
      {"much loss down", [](auto& f) { f.down->lost = 2000; }, LinkGrade::kBad, "20 % lost on the way down"},
      {"one gap", [](auto& f) { f.down->longest_gap = 0.03, f.pauses = 1; }, LinkGrade::kUsable,
       "30 ms down, 1 time beyond"},
      {"gaps", [](auto& f) { f.down->longest_gap = 0.03, f.pauses = 9; }, LinkGrade::kBad, "9 times beyond"},
      {"outage", [](auto& f) { f.down->longest_gap = 0.4, f.pauses = 1; }, LinkGrade::kBad,
       "400 ms down, 1 time beyond"},
      {"outage up", [](auto& f) { f.up->longest_gap = 0.4; }, LinkGrade::kBad, "up to 400 ms up"},
      {"gone for a while", [](auto& f) { f.down->longest_gap = 2, f.pauses = 1; }, LinkGrade::kBad,
       "no datagram came for 2.0 s"},
      {"lost", [](auto& f) { f.down->longest_gap = f.silent_at_end = 3, f.pauses = 1; }, LinkGrade::kBad,
       "in the last 3.0 s"},
      {"late", [](auto& f) { f.late_ticks = 100; }, LinkGrade::kUsable, "not the network"},
      {"very late", [](auto& f) { f.missed_ticks = 1000; }, LinkGrade::kBad, "not the network"},
      {"clock", [](auto& f) { f.clock_step = -0.25; }, LinkGrade::kUsable, "set by -250.0 ms"},
      {"route", [](auto& f) { f.transit_step = 0.03; }, LinkGrade::kUsable, "30.0 ms longer"},
      {"forged", [](auto& f) { f.refused = 3; }, LinkGrade::kUsable, "3 datagrams"},
      {"nothing", [](auto& f) { f.up.reset(), f.down.reset(); }, LinkGrade::kBad, "firewall"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    LinkTestResult f = perfect();
    c.spoil(f);
    const LinkVerdict v = assess_link(f);
    EXPECT_EQ(v.grade, c.grade);
    EXPECT_EQ(v.advice.size(), 1u);
    EXPECT_TRUE(advises(v, c.advice)) << (v.advice.empty() ? "" : v.advice.front());
    EXPECT_FALSE(v.text.empty());
  }
}

TEST(LinkVerdict, ReportsATestThatLostItsServerAsIncomplete) {
  LinkTestResult f = perfect();
  EXPECT_FALSE(server_lost(f));
  f.silent_at_end = 0.4;
  EXPECT_FALSE(server_lost(f)) << "an outage may end";
  f.silent_at_end = 0.6;
  EXPECT_TRUE(server_lost(f));
  EXPECT_NE(assess_link(f).text.find("the server was lost"), std::string::npos);
  f.silence_limit = 0.7;
  EXPECT_FALSE(server_lost(f)) << "this scene waits so long";
}

TEST(LinkVerdict, ReportsUnknownInsteadOfZero) {
  LinkTestResult f = perfect();
  f.up.reset();
  f.down.reset();
  f.rtt_min = f.rtt_p50 = f.rtt_p99 = f.rtt_max = f.jitter = std::nullopt;
  const std::string text = summary(f);
  EXPECT_NE(text.find("way up        not known"), std::string::npos) << text;
  EXPECT_NE(text.find("median not known"), std::string::npos) << text;
}

}  // namespace
}  // namespace tandem::client
