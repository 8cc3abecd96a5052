// Invalid parameters and broken recordings: every error is reported with its location, and nothing is started.
#include <gtest/gtest.h>

#include "netsim/profiles/capacity_csv.h"
#include "netsim/profiles/network_csv.h"
#include "netsim/profiles/profile_loader.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

struct Case {
  const char* text;
  const char* message;  ///< part of the error message
};

void expect_profile(const std::vector<Case>& cases, bool inside_both = true) {
  for (const Case& bad : cases) {
    const std::string text =
        inside_both ? "version: 1\nboth {\n" + std::string(bad.text) + "\n}\n" : "version: 1\n" + std::string(bad.text);
    const auto profile = parse_profile(text, "p.textproto");
    ASSERT_FALSE(profile) << bad.text;
    EXPECT_NE(to_text(profile.error()).find(bad.message), std::string::npos) << bad.text << "\n"
                                                                             << to_text(profile.error());
  }
}

TEST(BadInput, RejectsStatesWithoutAnExit) {
  expect_profile({
      {"gilbert_elliott { p_percent: 5 r_percent: 0 }", "p.textproto:3:43: both.gilbert_elliott.r_percent = 0"},
      {"gilbert_elliott { p_percent: 5 }", "both.gilbert_elliott.r_percent: is missing"},
      {"gilbert_elliott { p_percent: 5 r_percent: -1 }", "both.gilbert_elliott.r_percent = -1"},
      {"gilbert_elliott { p_percent: 5 r_percent: 1 h_percent: 60 k_percent: 50 }", "is above k_percent"},
      {"four_state { p13_percent: 5 p31_percent: 0 }", "a burst would never end"},
      {"bad_periods { good_mean_s: 0 bad_mean_ms: 5 loss_bad_percent: 100 }", "both.bad_periods.good_mean_s = 0"},
      {"bad_periods { good_mean_s: 5 bad_mean_ms: 5 loss_bad_percent: 100.1 }", "loss_bad_percent = 100.1"},
  });
  GilbertElliottSpec stuck{.p = 0.1, .r = 0};
  PathSpec spec;
  spec.loss.gilbert_elliott = stuck;
  EXPECT_THROW(Path(spec, RandomKey{1}), std::invalid_argument);
}

TEST(BadInput, RejectsInvalidQueuesAndRates) {
  expect_profile({
      {"rate { rate_bit_s: 1e6 queue_bytes: 0 }", "p.textproto:3:37: both.rate.queue_bytes = 0"},
      {"rate { rate_bit_s: 1e6 queue_datagrams: 0 }", "both.rate.queue_datagrams = 0"},
      {"rate { rate_bit_s: 1e6 queue_ms: -1 }", "both.rate.queue_ms = -1"},
      {"rate { rate_bit_s: -1e6 }", "p.textproto:3:20: both.rate.rate_bit_s = -1e6"},
      {"rate { rate_bit_s: 0 }", "both.rate.rate_bit_s = 0"},
      {"rate { queue_ms: 5 }", "both.rate: needs exactly one of rate_bit_s, capacity"},
      {"rate { rate_bit_s: 1e6 capacity {} }", "both.rate: needs exactly one of rate_bit_s, capacity"},
      {"rate { capacity { file: \"\" } }", "both.rate.capacity.file"},
      {"rate { capacity {} competing_peak_ms: 5 competing_period_ms: 50 }", "not with a recorded capacity"},
      {"rate { rate_bit_s: 1e6 queue_ms: 5 drop: MIDDLE }", "p.textproto:3:"},
      {"rate { rate_bit_s: 1e6 codel { target_ms: 100 interval_ms: 100 } }", "target_ms must be below interval_ms"},
      {"rate { rate_bit_s: 1e6 overhead_bytes: -1 }", "p.textproto:3:"},
  });
  expect_profile({{"up { rate { capacity { file: \"a\" } } } down { rate { capacity { file: \"b\" } } }",
                   "down.rate.capacity: names another file"}},
                 false);
}

TEST(BadInput, RejectsContradictoryParameters) {
  expect_profile({
      {"order: FREE slots { period_ms: 5 }", "slots"},
      {"stall { rate_per_s: 1 length_min_ms: 9 alpha: 1.5 cap_ms: 8 }",
       "both.stall.cap_ms = 8: is below length_min_ms"},
      {"body { uniform { low_ms: 3 high_ms: 2 } }", "above high_ms"},
      {"body { uniform { high_ms: 2 } exponential { mean_ms: 1 cap_ms: 5 } }", "exactly one"},
      {"congestion_loss { wait_low_ms: 5 wait_high_ms: 4 queue_percent: 10 }", "congestion_loss"},
      {"loss_pattern { lost: 6 of: 5 }", "is above `of`"},
      {"floor_ms: -0.1", "p.textproto:3:11: both.floor_ms = -0.1"},
      {"loss_percent: nan", "both.loss_percent = nan"},
      {"floor_ms: \"five\"", "p.textproto:3:"},
  });
  expect_profile(
      {
          {"both {} outage { start_s: 1 mean_gap_s: 5 length_ms: 5 }", "needs exactly one of"},
          {"both {} outage { mean_gap_s: 5 period_s: 9 length_ms: 5 }", "not with mean_gap_s"},
          {"both {} outage { start_s: 1 period_s: 1 length_ms: 5 length_max_ms: 1000 }", "must be longer than"},
          {"both {} outage { start_s: 1 length_ms: 5 length_max_ms: 9 }", "needs mean_gap_s or period_s"},
          {"shared: 2 both {}", "p.textproto:2:"},
      },
      false);
}

TEST(BadInput, RejectsTheSameInEngineSpecs) {
  const auto keys = [](const PathSpec& spec) {
    std::string text;
    for (const SpecError& problem : problems(spec)) text += problem.key + " ";
    return text;
  };
  PathSpec spec;
  spec.mtu = {.bytes = 28};
  spec.corruption = {.probability = 1.5, .mode = CorruptionSpec::Mode::kBitFlips, .bits = 0};
  EXPECT_EQ(keys(spec), "corruption.probability corruption.bits mtu.bytes ");
  spec = {};
  spec.mtu.above = MtuSpec::Above::kFragment;
  spec.rate.recorded = true;
  EXPECT_EQ(keys(spec), "rate.trace mtu.above ");
  spec = {};
  spec.outages = {{.length = 5ms, .loss_at_start = 6ms},
                  {.length = 5ms, .scope = OutageSpec::Scope::kAll},
                  {.length = 5ms, .length_max = 9ms},
                  {.length = 5ms, .period = 9ms, .length_max = 9ms},
                  {.length = 5ms, .mode = OutageSpec::Mode::kHoldLast, .hold_bytes = 5}};
  EXPECT_EQ(
      keys(spec),
      "outages[0].loss_at_start outages[1].scope outages[2].length_max outages[3].length_max outages[4].hold_bytes ");
  // A wrong length causes no second error at its neighbour.
  spec.outages = {{.length = -5ms}};
  EXPECT_EQ(keys(spec), "outages[0].length ");
}

std::string recording(std::string_view csv, Duration interval = 1ms) {
  const auto read = parse_network_csv(csv, "r.csv", interval);
  return read ? "none" : to_text(read.error());
}

TEST(BadInput, RejectsBrokenDelayRecordings) {
  const std::string head = "t_s[s],delay_ms[ms]\n";
  for (const Case& bad : std::vector<Case>{
           {"0,1\n1,2\n0.5,3\n", "r.csv:4:1: t_s = 0.5: time does not go on"},
           {"0,1\n0,2\n", "r.csv:3:1: t_s = 0: time does not go on"},
           {"0,1\n1,fast\n", "r.csv:3:2: delay_ms = fast: must be a number"},
           {"0,1\nsoon,2\n", "r.csv:3:1: t_s = soon: must be a number of seconds"},
           {"0,1\n,2\n", "r.csv:3:1: t_s"},
           {"0,1\n1\n", "r.csv:3:"},
           {"0,1\n1,2,3\n", "r.csv:3:"},
           {"0,1\n1,1e9\n", "r.csv:3:2: delay_ms = 1e9"},
           {"0,1\n1,-2\n", "r.csv:3:2: delay_ms = -2"},
           {"0,1\n1,0x10\n", "r.csv:3:2: delay_ms = 0x10"},
           {"0,1\n1,2 ms\n", "r.csv:3:2: delay_ms = 2 ms"},
           {"0,inf\n", "r.csv:2:2: delay_ms = inf"},
       }) {
    EXPECT_NE(recording(head + bad.text).find(bad.message), std::string::npos) << recording(head + bad.text);
  }
}

TEST(BadInput, RejectsWrongUnitsOfARecording) {
  EXPECT_EQ(recording("t_s[ms],rtt_ms[s]\n0,1\n1,2\n"),
            "r.csv:1:2: rtt_ms = [s]: its unit must be [ms]; convert the column\n"
            "r.csv:1:1: t_s = [ms]: its unit must be [s]; convert the column\n");
  EXPECT_NE(
      recording("t_send_s[us],delay_ms[ms],lost[%]\n0,1,0\n").find("r.csv:1:1: t_send_s = [us]: its unit must be [s]"),
      std::string::npos);
  EXPECT_NE(recording("t_s[s],delay_ms[ms],lost[%]\n0,1,0\n").find("r.csv:1:3: lost = [%]: its unit must be [1]"),
            std::string::npos);
  EXPECT_NE(recording("delay_ms[msec]\n1\n").find("r.csv:1:1: delay_ms = [msec]"), std::string::npos);
  // Words after the unit are free, and unknown columns are ignored.
  EXPECT_EQ(recording("t_send_s[s since first row],rtt_ms[ms],v[furlong],lost[1; 0 or 1]\n0,1,7,0\n1,2,7,1\n"), "none");
}

TEST(BadInput, FindsGapsOfARecordingWithTheirLine) {
  // Rows every 10 ms; 5 s are missing after line 4 and 2 s after line 6.
  const auto read = parse_network_csv("t_s[s],delay_ms[ms]\n0,1\n0.01,2\n0.02,3\n5.02,4\n5.03,5\n7.03,6\n7.04,7\n",
                                      "r.csv", Duration{});
  ASSERT_TRUE(read) << to_text(read.error());
  EXPECT_EQ(read->gaps, 2U);
  EXPECT_EQ(read->gap_longest, 5s);
  EXPECT_EQ(read->gap_line, 4U);
  EXPECT_EQ(path_of(read->link.up).send(Time{3s}, 1).at, Time{3s + 3ms});  // the last delay stays in force
  const auto slow = parse_network_csv("t_s[s],delay_ms[ms]\n0,1\n60,2\n120,3\n", "r.csv", Duration{});
  ASSERT_TRUE(slow);
  EXPECT_EQ(slow->gaps, 0U);  // one row per minute is the regular distance here
}

TEST(BadInput, RejectsBrokenCapacityRecordings) {
  const auto text = [](std::string_view trace) {
    const auto link = parse_capacity(trace, "c.trace");
    return link ? std::string("none") : to_text(link.error());
  };
  const std::string head = "direction[up|down],t_ms[ms],opportunities[count]\n";
  for (const auto& [trace, message] : std::vector<std::pair<std::string, std::string>>{
           {"direction[up|down],t_ms[s],opportunities[count]\nup,5,1\ndown,1,1\n",
            "c.trace:1:2: t_ms = [s]: its unit must be [ms]"},
           {"1\n3\n2\n", "c.trace:3:1: t_ms = 2: time goes back"},
           {"1\ntwo\n", "c.trace:2:1: t_ms = two: must be a whole number"},
           {"1\n2.5\n", "c.trace:2:1: t_ms = 2.5: must be a whole number"},
           {"1\n-2\n", "c.trace:2:1: t_ms = -2: must be a whole number"},
           {"1\n\n2\n", "c.trace:2:1"},
           {"1\n99999999999999999999\n", "c.trace:2:1"},
           {"", "holds no opportunity up"},
           {head + "up,5,1\nup,4,1\ndown,1,1\n", "c.trace:3:2: t_ms = 4: time does not go on"},
           {head + "up,5,-1\ndown,1,1\n", "c.trace:2:3: opportunities = -1"},
           {head + "up,5,1.5\ndown,1,1\n", "c.trace:2:3: opportunities = 1.5"},
           {head + "up,x,1\ndown,1,1\n", "c.trace:2:2: t_ms = x"},
           {head + "sideways,5,1\ndown,1,1\n", "c.trace:2:1: direction = sideways: must be up or down"},
           {head + "up,5\n", "c.trace:2:"},
           {head, "holds no opportunity up"},
       }) {
    EXPECT_NE(text(trace).find(message), std::string::npos) << trace << " -> " << text(trace);
  }
}

}  // namespace
}  // namespace tandem::netsim
