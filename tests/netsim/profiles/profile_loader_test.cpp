#include "netsim/profiles/profile_loader.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "netsim/profiles/network_csv.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

TEST(Profiles, AreValidAndDescribedIfShipped) {
  std::set<std::string> names;
  for (const EmbeddedFile& shipped : shipped_profiles()) {
    const auto profile = shipped_profile(shipped.name);
    ASSERT_TRUE(profile) << to_text(profile.error());
    EXPECT_EQ(profile->name, shipped.name);
    EXPECT_GE(profile->version, 1U);
    EXPECT_FALSE(profile->summary.empty()) << shipped.name;
    EXPECT_TRUE(!profile->sources.empty() || profile->name == "ideal") << shipped.name;
    names.insert(profile->name);
  }
  for (const char* name : {"ideal",
                           "lan",
                           "campus",
                           "metro",
                           "wifi-good",
                           "wifi-busy",
                           "wifi-roaming",
                           "4g",
                           "5g",
                           "5g-urllc",
                           "5g-rural",
                           "intercity",
                           "transcontinental",
                           "intercontinental",
                           "starlink",
                           "geo-satellite",
                           "burst-loss",
                           "random-loss-1",
                           "random-loss-5",
                           "random-loss-10",
                           "outage",
                           "stall",
                           "reorder",
                           "duplicate",
                           "bufferbloat",
                           "telesurgery-100",
                           "telesurgery-300",
                           "telesurgery-500",
                           "telesurgery-loss-10",
                           "telesurgery-loss-30",
                           "telesurgery-loss-50",
                           "comm-loss",
                           "g1050-a",
                           "g1050-b",
                           "g1050-c",
                           "worst"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

// Section 4 of the network design: 30 virtual minutes at 1 kHz, tolerance 10 % up to p95, 20 % at p99.
TEST(Profiles, MatchTheirPromisedQuantiles) {
  for (const EmbeddedFile& shipped : shipped_profiles()) {
    const auto profile = shipped_profile(shipped.name);
    ASSERT_TRUE(profile);
    for (const ProfileCheck& check : profile->checks) {
      SCOPED_TRACE(profile->name + " " + name(check.direction));
      Path path{profile->link[check.direction], Path::key_for(1, 0, check.direction)};
      std::vector<double> all;
      for (std::int64_t i = 0; i < 1'800'000; ++i) {
        const PathDecision v = path.send(Time{i * 1ms}, kSize);
        if (!dropped(v.outcome)) all.push_back(static_cast<double>((v.at - Time{i * 1ms}).count()));
      }
      const std::array q{0.05, 0.50, 0.95, 0.99};
      for (std::size_t i = 0; i < q.size(); ++i) {
        const auto nth = all.begin() + static_cast<std::ptrdiff_t>(q[i] * static_cast<double>(all.size() - 1));
        std::nth_element(all.begin(), nth, all.end());
        const double ms = *nth / 1e6;
        EXPECT_NEAR(ms, check.delay_ms[i], check.delay_ms[i] * (i < 3 ? 0.10 : 0.20)) << q[i];
      }
    }
  }
}

TEST(Profiles, LoseTheShareInTheirName) {
  const std::map<std::string, double> shares{
      {"random-loss-1", 0.01},       {"random-loss-5", 0.05},       {"random-loss-10", 0.10},     {"burst-loss", 0.05},
      {"telesurgery-loss-10", 0.10}, {"telesurgery-loss-30", 0.30}, {"telesurgery-loss-50", 0.50}};
  for (const auto& [name, share] : shares) {
    SCOPED_TRACE(name);
    const auto profile = shipped_profile(name);
    ASSERT_TRUE(profile);
    constexpr std::size_t n = 1'800'000;
    const double lost = static_cast<double>(count_of(decisions(path_of(profile->link.up), n), Outcome::kLost)) / n;
    EXPECT_NEAR(lost, share, 0.05 * share);
  }
}

TEST(Profiles, HaveTheMeanInTheNameOfTelesurgery) {
  for (const auto& [name, mean_ms] :
       {std::pair{"telesurgery-100", 100.0}, {"telesurgery-300", 300.0}, {"telesurgery-500", 500.0}}) {
    auto profile = shipped_profile(name);
    ASSERT_TRUE(profile);
    profile->link.up.order = ArrivalOrder::kFree;  // the parameters describe the raw process; fifo order adds delay
    const auto all = delays(decisions(path_of(profile->link.up), 1'800'000));
    double sum = 0;
    for (const double d : all) sum += d / 1e6;
    EXPECT_NEAR(sum / static_cast<double>(all.size()), mean_ms, 0.05 * mean_ms) << name;
  }
}

TEST(Profiles, HaveNoModelInIdeal) {
  const auto profile = shipped_profile("ideal");
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->link, LinkSpec{});
}

TEST(Profiles, MapEveryKeyToItsSpec) {
  const auto profile = parse_profile(R"(
    version: 3 summary: "all" source: "here" source: "there"
    up {
      loss_percent: 2.5
      bad_periods { good_mean_s: 2 bad_mean_ms: 30 loss_bad_percent: 80 loss_good_percent: 1 }
      rate { rate_bit_s: 1e6 overhead_bytes: 46 queue_bytes: 5000 queue_ms: 20 }
      floor_ms: 1.5
      body { log_logistic { median_ms: 0.75 shape: 2.4 cap_ms: 25 } tau_ms: 8 }
      stall { rate_per_s: 0.6 length_min_ms: 8 alpha: 1.35 cap_ms: 400 }
      order: FREE
      reorder { probability_percent: 1 displacement: 4 hold_limit_ms: 70 }
      duplicate { probability_percent: 2 delay_max_ms: 5 }
    }
    down { body { uniform { low_ms: 1 high_ms: 2 } } }
    outage { start_s: 10 length_ms: 400 period_s: 10 mode: HOLD direction: DOWN hold_bytes: 9000 }
  )",
                                     "dir/mine.textproto");
  ASSERT_TRUE(profile) << to_text(profile.error());
  EXPECT_EQ(profile->name, "mine");
  EXPECT_EQ(profile->version, 3U);
  EXPECT_EQ(profile->sources.size(), 2U);
  PathSpec up;
  up.loss.probability = 0.025;
  up.loss.periods = BadPeriodsSpec{.good_mean = 2s, .bad_mean = 30ms, .loss_good = 0.01, .loss_bad = 0.8};
  up.rate = {.bits_per_s = 1'000'000, .overhead_bytes = 46, .queue_bytes = 5000, .queue_wait = 20ms};
  up.floor = 1500us;
  up.body = {.kind = BodySpec::Kind::kLogLogistic, .scale = 750us, .shape = 2.4, .cap = 25ms, .tau = 8ms};
  up.stall = {.rate_per_s = 0.6, .length_min = 8ms, .alpha = 1.35, .cap = 400ms};
  up.order = ArrivalOrder::kFree;
  up.reorder = {.probability = 0.01, .displacement = 4, .hold_limit = 70ms};
  up.duplicate = {.probability = 0.02, .delay_max = 5ms};
  EXPECT_EQ(profile->link.up, up);
  PathSpec down;
  down.body = {.kind = BodySpec::Kind::kUniform, .low = 1ms, .high = 2ms, .shape = 0};
  down.outages = {{.start = 10s, .length = 400ms, .period = 10s, .mode = OutageSpec::Mode::kHold, .hold_bytes = 9000}};
  EXPECT_EQ(profile->link.down, down);
}

std::string mistakes(std::string_view text) {
  const auto profile = parse_profile(text, "p.textproto");
  return profile ? "none" : to_text(profile.error());
}

TEST(Profiles, ListEveryMistakeWithItsPlace) {
  const std::string text = mistakes(
      "version: 1\n"
      "both {\n"
      "  floor_mss: 3\n"
      "  loss_percent: 101\n"
      "  body { log_normal { median_ms: nan shape: 0.5 cap_ms: 1e400 } }\n"
      "  stall { rate_per_s: -1 }\n"
      "}\n");
  EXPECT_NE(text.find("p.textproto:3:3: both.floor_mss: unknown key; did you mean floor_ms?"), std::string::npos)
      << text;
  EXPECT_NE(text.find("p.textproto:4:17: both.loss_percent = 101"), std::string::npos) << text;
  EXPECT_NE(text.find("p.textproto:5:34: both.body.log_normal.median_ms = nan"), std::string::npos) << text;
  EXPECT_NE(text.find("p.textproto:5:57: both.body.log_normal.cap_ms = 1e400"), std::string::npos) << text;
  EXPECT_NE(text.find("p.textproto:6:23: both.stall.rate_per_s"), std::string::npos) << text;
  EXPECT_NE(text.find("both.stall.alpha: is missing"), std::string::npos) << text;
}

TEST(Profiles, CheckRulesBetweenNumbers) {
  EXPECT_NE(mistakes("").find("no key is set"), std::string::npos);
  EXPECT_NE(mistakes("version: 1").find("needs `both"), std::string::npos);
  EXPECT_NE(mistakes("version: 1 up {}").find("needs `both"), std::string::npos);
  EXPECT_NE(mistakes("version: 1 both {} up {}").find("up: both directions"), std::string::npos);
  EXPECT_NE(mistakes("both {}").find("version: is missing"), std::string::npos);
  EXPECT_NE(mistakes("version: 1 both { body {} }").find("exactly one of"), std::string::npos);
  EXPECT_NE(mistakes("version: 1 both { body { uniform { low_ms: 3 high_ms: 2 } } }").find("above high_ms"),
            std::string::npos);
  EXPECT_NE(mistakes("version: 1 both {} outage { start_s: 1 length_ms: 2000 period_s: 2 }").find("longer than"),
            std::string::npos);
  EXPECT_NE(mistakes("version: 1 both {} outage { start_s: 1 length_ms: 2 hold_bytes: 5 }").find("mode: HOLD"),
            std::string::npos);
  EXPECT_NE(mistakes("version: 1 both { rate { rate_bit_s: 1000.5 } }").find("whole number"), std::string::npos);
  EXPECT_NE(mistakes("version: 1 both { stall { rate_per_s: 100 length_min_ms: 1 alpha: 1 cap_ms: 1000 } }").find("32"),
            std::string::npos);
}

TEST(Profiles, SuggestTheNearestForAnUnknownName) {
  const auto profile = shipped_profile("wifi-bussy");
  ASSERT_FALSE(profile);
  EXPECT_NE(to_text(profile.error()).find("did you mean wifi-busy?"), std::string::npos);
}

TEST(NetworkCsv, PlaysARecordingInSteps) {
  const auto recorded = parse_network_csv(
      "seq[1],t_s[s],delay_ms[ms],lost[1]\n0,5,10,0\n1,5.5,20.5,0\n2,6,,\n3,6.5,7,1\n", "r.csv", Duration{});
  ASSERT_TRUE(recorded) << to_text(recorded.error());
  EXPECT_FALSE(recorded->rtt_split);
  EXPECT_EQ(recorded->rows, 4U);
  EXPECT_EQ(recorded->lost, 2U);
  EXPECT_EQ(recorded->length, 2s);
  Path path = path_of(recorded->link.up);
  EXPECT_EQ(path.send(Time{}, 1).at, Time{10ms});
  EXPECT_EQ(path.send(Time{499ms}, 1).at, Time{509ms});
  EXPECT_EQ(path.send(Time{500ms}, 1).at, Time{520'500us});
  EXPECT_EQ(path.send(Time{1s}, 1).outcome, Outcome::kLost);
  EXPECT_EQ(path.send(Time{1500ms}, 1).outcome, Outcome::kLost);
  EXPECT_EQ(path.send(Time{2s}, 1).at, Time{2010ms});  // repeats from the start
  EXPECT_EQ(path.send(Time{2h + 600ms}, 1).at, Time{2h + 620'500us});
}

TEST(NetworkCsv, SplitsRoundTripsEvenly) {
  const auto recorded = parse_network_csv("rtt_ms[ms]\n10\n20\n", "r.csv", 100ms);
  ASSERT_TRUE(recorded) << to_text(recorded.error());
  EXPECT_TRUE(recorded->rtt_split);
  EXPECT_EQ(recorded->length, 200ms);
  EXPECT_EQ(path_of(recorded->link.down).send(Time{150ms}, 1).at, Time{160ms});
}

TEST(NetworkCsv, ListsEveryMistakeWithItsLine) {
  const auto text = [](std::string_view csv, Duration interval = 1ms) {
    const auto recorded = parse_network_csv(csv, "r.csv", interval);
    return recorded ? std::string("none") : to_text(recorded.error());
  };
  EXPECT_NE(text("t_s[s],rtt_ms[ms]\n0,1\n1,x\n0.5,2\n2,-1\n").find("r.csv:3:2: rtt_ms = x"), std::string::npos);
  EXPECT_NE(text("t_s[s],rtt_ms[ms]\n0,1\n1,x\n0.5,2\n2,-1\n").find("r.csv:4:1: t_s = 0.5: time does not go on"),
            std::string::npos);
  EXPECT_NE(text("t_s[s],rtt_ms[ms]\n0,1\n1,x\n0.5,2\n2,-1\n").find("r.csv:5:2: rtt_ms = -1"), std::string::npos);
  EXPECT_NE(text("rtt_ms[ms]\n1\n", Duration{}).find("--trace-interval"), std::string::npos);
  EXPECT_NE(text("a[1]\n1\n").find("needs a column"), std::string::npos);
  EXPECT_NE(text("rtt_ms[ms]\n").find("holds no row"), std::string::npos);
  EXPECT_NE(text(""), "none");
  EXPECT_NE(text("rtt_ms[ms]\nnan\n").find("must be a number"), std::string::npos);
}

}  // namespace
}  // namespace tandem::netsim
