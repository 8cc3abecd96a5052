// Validation of a scenario's text against its scene, and of limits against reports.
#include "netsim/scenario/scenario.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "netsim/scenario/shipped_scenarios.h"
#include "proto/text/scenario_text.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::netsim {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Returns shipped scenes, a network known only by name, and no motions.
ScenarioSources sources() {
  return {
      .scene = [](const std::string& name) -> std::expected<SceneSpec, InputErrors> {
        if (const EmbeddedFile* scene = find_shipped_scene(name)) return parse_scene(scene->text, name);
        return std::unexpected(InputErrors{{"", 0, 0, "", "", "no such scene"}});
      },
      .network = [](const ScenarioNetworkSpec& spec) -> std::expected<ScenarioLink, InputErrors> {
        if (spec.profile && spec.profile->text == "unknown")
          return std::unexpected(
              InputErrors{{"", 0, 0, "", "", "no such network"}, {"other.textproto", 3, 1, "x", "", "is wrong"}});
        return ScenarioLink{{}, "a network"};
      },
      .motion =
          [](const std::string& option) -> std::expected<std::shared_ptr<const hal::sim::RecordedMotion>, InputErrors> {
        return std::unexpected(InputErrors{{"", 0, 0, "", "", "no motion " + option}});
      }};
}

std::expected<Scenario, InputErrors> make(const std::string& text) {
  ScenarioReading reading = read_scenario_text(text, "folder/some.textproto");
  if (!reading.spec) return std::unexpected(std::move(reading.errors));
  return make_scenario(*reading.spec, sources(), std::move(reading.errors));
}

std::string mistakes(const std::string& text) {
  const auto made = make(text);
  return made ? "" : to_text(made.error());
}

TEST(Scenario, ReadsEveryKeyOfAFile) {
  const auto s = make(
      "version: 1 summary: \"sum\" scene: \"contact\" duration_s: 15 seed: 7 seeds: 3 channel: RAW mfs: TANK\n"
      "network { delay_ms: 5 } seat_network { seat: \"trainee\" network { loss_percent: 3 } }\n"
      "fault { kind: PAUSE seat: \"trainer\" seat: \"trainee\" at_s: 1.5 for_ms: 250 } fault { kind: SERVER_LATE at_s: "
      "2 for_ms: 3 }\n"
      "endpoint { seat: \"trainer\" offset_ms: -4 drift_ppm: 50 step { at_s: 1 by_ms: 2 } wake: UNIFORM late_max_ms: "
      "0.5 }\n"
      "seat_limits { phase: \"alignment\" force_error_rms_n { max: 0.1 } }\n"
      "seat_limits { seat: \"trainer\" loss_percent { min: 1 max: 2 } }\n"
      "tool_limits { held_s { max: 0 } } session_limits { duration_s { min: 14 } }\n");
  ASSERT_TRUE(s) << to_text(s.error());
  EXPECT_EQ(s->name, "some");
  EXPECT_EQ(s->summary, "sum");
  EXPECT_EQ(s->seed, 7u);
  EXPECT_EQ(s->seeds, 3u);
  EXPECT_EQ(s->setup.scene.duration, 15);
  EXPECT_EQ(s->setup.scene.channel.law, LawKind::kRaw);
  EXPECT_EQ(s->setup.scene.channel.mfs, MfsMode::kTank);
  EXPECT_TRUE(s->setup.seat_networks.contains("trainee"));
  using namespace std::chrono_literals;
  const std::vector<Fault> faults{{Fault::Kind::kPause, "trainer", 1500ms, 250ms},
                                  {Fault::Kind::kPause, "trainee", 1500ms, 250ms},
                                  {Fault::Kind::kServerLate, "", 2s, 3ms}};
  EXPECT_EQ(s->setup.faults, faults);
  const EndpointSpec endpoint{-4ms, 50, {{1s, 2ms}}, {WakeSpec::Kind::kUniform, 500us}};
  EXPECT_EQ(s->setup.endpoints.at("trainer"), endpoint);
  // Every MASTER seat, both directions, the tool, the session.
  std::vector<std::string> limits;
  for (const Limit& l : s->limits) limits.push_back(l.subject + " " + l.metric + " " + range_text(l));
  EXPECT_EQ(limits, (std::vector<std::string>{"trainer in alignment force_error_rms_n at most 0.1 N",
                                              "trainee in alignment force_error_rms_n at most 0.1 N",
                                              "trainer up_loss_percent 1 to 2 %", "trainer down_loss_percent 1 to 2 %",
                                              "tool held_s at most 0 s", "session duration_s at least 14 s"}));
  const std::string text = effective_scenario_text(*s);
  for (const char* part :
       {"  7 to 9\n", "duration_s", "network of trainee", "PAUSE of trainer", "SERVER_LATE of server",
        "fault[0].for_ms", "endpoint of trainer.drift_ppm", "at most 0.1  N", "UNIFORM"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " not in\n" << text;
}

TEST(Scenario, ChangesNetworksAtTheirTimes) {
  using namespace std::chrono_literals;
  const auto s = make(
      "version: 1 scene: \"contact\"\n"
      "event { at_s: 2 client: \"trainee\" outage_ms: 400 mode: HOLD direction: UP } event { at_s: 3 profile: \"any\" "
      "}\n"
      "event { at_s: 4 client: \"trainer\" rebind { dead_after_ms: 20 } }\n");
  ASSERT_TRUE(s) << to_text(s.error());
  ASSERT_EQ(s->setup.events.size(), 3u);
  EXPECT_EQ(s->setup.events[0].at, 2s);
  EXPECT_EQ(s->setup.events[0].clients, std::vector<std::string>{"trainee"});
  EXPECT_EQ(s->setup.events[0].outage->length, 400ms);
  EXPECT_EQ(s->setup.events[0].outage->mode, OutageSpec::Mode::kHold);
  EXPECT_EQ(s->setup.events[0].direction, Direction::kUp);
  EXPECT_TRUE(s->setup.events[1].link);
  EXPECT_EQ(s->setup.events[2].rebind->dead_after, 20ms);
  const std::string text = effective_scenario_text(*s);
  for (const char* part : {"outage up of trainee", "HOLD", "network any of every seat", "new address of trainer",
                           "event[2].dead_after_ms"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " not in\n" << text;
  EXPECT_NE(mistakes("version: 1 scene: \"contact\"\nevent { at_s: 1 }")
                .find("2:1: event[0]: needs exactly one of outage_ms, profile, rebind"),
            std::string::npos);
  const std::string all = mistakes(
      "version: 1 scene: \"contact\"\nevent { at_s: 1 client: \"traine\" outage_ms: 5 }\nevent { at_s: 2 profile: "
      "\"unknown\" }\n");
  for (const char* part : {"some.textproto:2:25: event[0].client[0] = \"traine\": no seat of scene contact is called "
                           "so; did you mean trainer?",
                           "some.textproto:3:26: event[1].profile = \"unknown\": no such network"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " not in\n" << all;
}

TEST(Scenario, ListsEveryMistakeWithItsPlace) {
  const std::string text =
      "version: 1\n"
      "scene: \"free_motion\"\n"
      "sceds: 3\n"
      "network { profile: \"lan\" loss_percent: 101 }\n"
      "\n\n\n\n"
      "fault { kind: POUSE at_s: 1 for_ms: 0 }\n";
  const std::string all = mistakes(text);
  for (const char* part : {"some.textproto:3:1: sceds: unknown key; did you mean seeds?",
                           "some.textproto:4:40: network.loss_percent = 101: must be in [0, 100] %",
                           "9:15: fault[0].kind = POUSE: unknown; did you mean PAUSE?",
                           "9:37: fault[0].for_ms = 0: must be in (0, 3600000] ms"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " not in\n" << all;
}

TEST(Scenario, ReportsBrokenRulesOnceTheKeysAreValid) {
  const std::string all = mistakes(
      "version: 1\n"
      "scene: \"free_motion\"\n"
      "seat_limits { tracking_rms_m { max: -1 } }\n"
      "seat_limits { gate_trips { } }\n"
      "seat_limits { effort_peak_n { min: 3 max: 2 } }\n"
      "tool_limits { tool: \"tool\" }\n"
      "fault { kind: SERVER_LATE seat: \"trainer\" at_s: 1 for_ms: 1 }\n"
      "endpoint { wake: UNIFORM }\n"
      "endpoint { late_max_ms: 1 step { at_s: 2 by_ms: 1 } step { at_s: 2 by_ms: 1 } }\n"
      "seat_network { network { trace_interval_ms: 1 } }\n");
  for (const char* part :
       {"3:37: seat_limits[0].tracking_rms_m.max = -1: must be in [0, 10] m",
        "4:15: seat_limits[1].gate_trips: needs min, max or both",
        "5:36: seat_limits[2].effort_peak_n.min = 3: is above max = 2", "6:1: tool_limits[0]: limits nothing",
        "7:33: fault[0].seat[0] = \"trainer\": SERVER_LATE concerns the server",
        "8:18: endpoint[0].wake = UNIFORM: UNIFORM needs late_max_ms",
        "9:25: endpoint[1].late_max_ms = 1: is for wake: UNIFORM",
        "9:66: endpoint[1].step[1].at_s = 2: steps must ascend", "10:1: seat_network[0]: needs seat",
        "network.trace_interval_ms = 1: is for a profile that is a recording"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " not in\n" << all;
}

TEST(Scenario, ReportsMistakesOfAllKindsTogetherAndOnce) {
  const std::string all = mistakes(
      "version: 1\n"
      "scene: \"free_motion\"\n"
      "duration_s: 0\n"
      "network { profile: \"unknown\" loss_percent: 101 }\n"
      "event { at_s: 1 client: \"traine\" outage_ms: 5 directoin: UP }\n"
      "event { at_s: 2 outage_ms: 0 }\n"
      "fault { kind: PAUSE seat: \"absent\" at_s: 1 for_ms: 0 }\n"
      "endpoint { wake: UNIFORM late_max_ms: x }\n"
      "endpoint { drift_ppm: 1e9 }\n"
      "seat_limits { trackin_rms_m { max: 1 } }\n"
      "seat_limits { phase: \"evaluation\" effort_peak_n { max: 1 } }\n");
  const std::vector<std::string> each{"3:13: duration_s = 0: must be",
                                      "4:20: network.profile = \"unknown\": no such network",
                                      "3:1: x: is wrong",  // in the file of that network
                                      "4:44: network.loss_percent = 101: must be in [0, 100] %",
                                      "5:25: event[0].client[0] = \"traine\": no seat",
                                      "5:47: event[0].directoin: unknown key",
                                      "6:28: event[1].outage_ms = 0: must be",
                                      "7:27: fault[0].seat[0] = \"absent\": no seat",
                                      "7:52: fault[0].for_ms = 0: must be",
                                      "8:39: endpoint[0].late_max_ms = x: must be a number",
                                      "9:23: endpoint[1].drift_ppm = 1e9: must be",
                                      "10:15: seat_limits[0].trackin_rms_m: unknown key"};
  for (const std::string& part : each) EXPECT_NE(all.find(part), std::string::npos) << part << " not in\n" << all;
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(all, '\n')), each.size()) << all;
}

TEST(Scenario, ChecksNamesAgainstTheScene) {
  const std::string all = mistakes(
      "version: 1\n"
      "scene: \"free_motion\"\n"
      "network { profile: \"unknown\" }\n"
      "seat_network { seat: \"trainee\" network { } }\n"
      "seat_network { seat: \"trainee\" network { } }\n"
      "hand { seat: \"trainr\" motion: \"a.csv\" }\n"
      "hand { seat: \"trainer\" motion: \"a.csv\" }\n"
      "fault { kind: PAUSE seat: \"absent\" at_s: 1 for_ms: 1 }\n"
      "endpoint { offset_ms: 1 } endpoint { seat: \"trainee\" }\n"
      "seat_limits { seat: \"trianee\" gate_trips { max: 1 } }\n"
      "seat_limits { phase: \"demo\" tracking_rms_m { max: 1 } }\n"
      "seat_limits { phase: \"evaluation\" gate_trips { max: 1 } }\n"
      "seat_limits { phase: \"evaluation\" force_error_rms_n { max: 1 } }\n"
      "seat_limits { force_error_percent { max: 1 } }\n"
      "tool_limits { tool: \"tol\" held_s { max: 1 } }\n");
  for (const char* part :
       {"some.textproto:3:20: network.profile = \"unknown\": no such network", "other.textproto:3:1: x: is wrong",
        "5:22: seat_network[1].seat[0] = \"trainee\": has a network already",
        "6:14: hand[0].seat = \"trainr\": no MASTER seat of scene free_motion is called so; did you mean trainer?",
        "7:32: hand[1].motion = \"a.csv\": no motion a.csv", "8:27: fault[0].seat[0] = \"absent\"",
        "9:27: endpoint[1]: seat trainee has a clock already",
        "10:21: seat_limits[0].seat[0] = \"trianee\": no seat of scene free_motion is called so; did you mean trainee?",
        "11:22: seat_limits[1].phase = \"demo\"",
        "12:22: seat_limits[2].phase = \"evaluation\": gate_trips is counted over the whole run",
        "13:35: seat_limits[3].force_error_rms_n: force errors are measured in phases",
        "14:15: seat_limits[4].force_error_percent: force errors", "15:21: tool_limits[0].tool[0] = \"tol\""})
    EXPECT_NE(all.find(part), std::string::npos) << part << " not in\n" << all;
  EXPECT_NE(mistakes("version: 1 scene: \"none\" seat_limits { seat: \"x\" gate_trips { max: 1 } }")
                .find("scene = \"none\": no such scene"),
            std::string::npos);
  EXPECT_EQ(
      mistakes("version: 1 scene: \"none\" seat_limits { seat: \"x\" gate_trips { max: 1 } }").find("seat_limits"),
      std::string::npos)
      << "without a scene the existence of seats is unknown";
  EXPECT_NE(mistakes("version: 1 scene: \"free_motion\" duration_s: 12 seat_limits { phase: \"evaluation\" "
                     "effort_peak_n { max: 1 } }")
                .find("begins at 12 s, when the run of 12 s is over"),
            std::string::npos);
}

/// Returns the valid keys of a message, as listed in the error message about an unknown key.
std::vector<std::string> keys_of(const std::string& block) {
  const std::string answer = mistakes("version: 1 scene: \"contact\" " + block + " { no_such_key: 1 }");
  std::istringstream words(answer.substr(answer.find("known here: ") + 12));
  std::vector<std::string> keys;
  for (std::string word; words >> word;) {
    if (word.back() == ',') word.pop_back();
    if (word.find_first_of(":/") != std::string::npos) break;  // the next error
    keys.push_back(word);
  }
  return keys;
}

TEST(Scenario, MeasuresEveryLimitOfTheSchema) {
  for (const auto& [block, words] : std::vector<std::pair<std::string, std::set<std::string>>>{
           {"seat_limits", {"seat", "phase"}}, {"tool_limits", {"tool"}}, {"session_limits", {}}, {"feel", {}}}) {
    const auto keys = keys_of(block);
    EXPECT_GE(keys.size(), words.size() + 1) << block;
    for (const std::string& key : keys)
      if (!words.contains(key)) {
        EXPECT_EQ(mistakes("version: 1 scene: \"contact\" " + block + " { " + key + " { min: 0.5 max: 1 } }"), "")
            << block;
      }
  }
  EXPECT_EQ(keys_of("seat_limits").size(), 28u);
  EXPECT_EQ(keys_of("feel").size(), 12u);
}

TEST(Scenario, AcceptsEveryFaultOfTheEngine) {
  for (const FaultName& fault : kFaultNames) {
    const auto s =
        make("version: 1 scene: \"contact\" fault { kind: " + std::string(fault.name) + " at_s: 1 for_ms: 1 }");
    ASSERT_TRUE(s) << to_text(s.error());
    EXPECT_EQ(s->setup.faults.front().kind, fault.kind);
  }
}

TEST(Scenario, JudgesLimitsAsComputedByHand) {
  Limit most{.phase = {}, .metric = "effort_peak_n", .subject = "a", .unit = "N", .min = {}, .max = 2.0};
  EXPECT_TRUE(holds(most, 2));
  EXPECT_FALSE(holds(most, std::nextafter(2.0, 3.0)));
  EXPECT_EQ(slack(most, 1.5), 0.5);
  EXPECT_EQ(margin_percent(most, 1.5), 25);
  EXPECT_EQ(margin_percent(most, 3), -50);
  EXPECT_EQ(range_text(most), "at most 2 N");
  Limit both = most;
  both.min = 1.5;
  EXPECT_TRUE(holds(both, 1.5));
  EXPECT_FALSE(holds(both, 1.4));
  EXPECT_EQ(slack(both, 1.6), 1.6 - 1.5) << "the nearer end";
  EXPECT_NEAR(margin_percent(both, 1.2), -20, 1e-12);
  EXPECT_EQ(range_text(both), "1.5 to 2 N");
  for (const Limit& limit : {most, both}) {
    EXPECT_FALSE(holds(limit, kNaN)) << "unknown is not fine";
    EXPECT_EQ(slack(limit, kNaN), -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(margin_percent(limit, kNaN)));
  }
  Limit none = most;
  none.max = 0;
  none.min = 0;
  EXPECT_EQ(range_text(none), "exactly 0 N");
  EXPECT_TRUE(std::isnan(margin_percent(none, 0))) << "no share of nothing";
  EXPECT_EQ(short_number(0.00612345), "0.0061234");
  EXPECT_EQ(short_number(1e6), "1000000");
  EXPECT_EQ(short_number(kNaN), "none");
}

TEST(Scenario, JudgesFeelLimits) {
  const auto s =
      make("version: 1 scene: \"contact\" feel { stiffness_felt_n_m { min: 360 } trips_per_min { max: 1 } }");
  ASSERT_TRUE(s) << to_text(s.error());
  ASSERT_EQ(s->limits.size(), 2u);
  EXPECT_EQ(s->limits[0].subject, "feel");
  server::RunReport report;
  const auto hold = [&](double stiffness, double trips) {
    report.feel = {{"stiffness_felt_n_m", stiffness}, {"trips_per_min", trips}};
    return std::pair(holds(s->limits[0], value_of(s->limits[0], report)),
                     holds(s->limits[1], value_of(s->limits[1], report)));
  };
  EXPECT_EQ(hold(390, 0.5), std::pair(true, true));
  EXPECT_EQ(hold(45, 0.5), std::pair(false, true));
  EXPECT_EQ(hold(390, 24), std::pair(true, false));
  EXPECT_EQ(hold(kNaN, 0), std::pair(false, true)) << "no hand pressed";
  EXPECT_NE(mistakes("version: 1 scene: \"contact\" feel { stiffness { min: 360 } }"), "");
  EXPECT_NE(mistakes("version: 1 scene: \"contact\" feel { engaged_share { min: 2 } }"), "");
}

TEST(Scenario, ReadsValuesFromTheirPlaceInTheReport) {
  server::RunReport report;
  report.duration_s = 9;
  report.seats.resize(2);
  report.seats[1].metrics.tracking_rms_m = 0.25;
  report.seats[1].metrics.joint_rms_rad = {0.1, 0.3, 0.2};
  report.seats[1].gate_trips = 4;
  report.seats[1].last.engaged = true;
  report.seats[1].link.down.longest_gap_ms = 17;
  report.tools.push_back({"t", 1.5, 0.5, 2.5});
  server::PhaseReport phase{"p", 0, 1, {}};
  phase.seats.resize(2);
  phase.seats[1].tracking_rms_m = 0.75;
  report.phases.push_back(phase);
  const auto value = [&](Limit::Of of, std::size_t index, const std::string& metric,
                         std::optional<std::size_t> in = {}) {
    return value_of(
        {.of = of, .index = index, .phase = in, .metric = metric, .subject = "", .unit = "", .min = {}, .max = {}},
        report);
  };
  using enum Limit::Of;
  EXPECT_EQ(value(kSeat, 1, "tracking_rms_m"), 0.25);
  EXPECT_EQ(value(kSeat, 1, "tracking_rms_m", 0), 0.75);
  EXPECT_EQ(value(kSeat, 1, "joint_rms_rad"), 0.3);
  EXPECT_EQ(value(kSeat, 1, "gate_trips"), 4);
  EXPECT_EQ(value(kSeat, 1, "engaged_at_end"), 1);
  EXPECT_EQ(value(kSeat, 0, "engaged_at_end"), 0);
  EXPECT_EQ(value(kSeat, 1, "down_longest_gap_ms"), 17);
  EXPECT_EQ(value(kTool, 0, "held_s"), 2.5);
  EXPECT_EQ(value(kTool, 0, "penetration_max_m"), 0.5);
  EXPECT_EQ(value(kSession, 0, "duration_s"), 9);
  report.feel = {{"drag_n", 0.5}, {"gain_max", kNaN}};
  EXPECT_EQ(value(kFeel, 0, "drag_n"), 0.5);
  EXPECT_TRUE(std::isnan(value(kFeel, 0, "gain_max")));
  EXPECT_TRUE(std::isnan(value(kFeel, 0, "overshoot"))) << "not judged";
  EXPECT_TRUE(std::isnan(value(kSeat, 2, "gate_trips")));
  EXPECT_TRUE(std::isnan(value(kSeat, 1, "joint_rms_rad", 1)));
  EXPECT_TRUE(std::isnan(value(kTool, 1, "held_s")));
}

TEST(Scenario, ParsesOrRejectsAnyText) {
  const std::string whole(shipped_scenarios().front().text);
  for (std::size_t n = 0; n < whole.size(); n += 7) {
    EXPECT_NO_FATAL_FAILURE(mistakes(whole.substr(0, n)));
    std::string flipped = whole;
    flipped[n] = static_cast<char>(flipped[n] ^ 0x15);
    EXPECT_NO_FATAL_FAILURE(mistakes(flipped));
  }
  EXPECT_NE(mistakes(""), "");
  EXPECT_NE(mistakes("version: 1"), "");
}

TEST(Scenario, HasADescriptionAndALimitInEveryShippedFile) {
  ASSERT_GE(shipped_scenarios().size(), 6u);
  for (const EmbeddedFile& shipped : shipped_scenarios()) {
    const auto spec = parse_scenario_text(shipped.text, shipped.name);
    ASSERT_TRUE(spec) << shipped.name << "\n" << to_text(spec.error());
    EXPECT_FALSE(spec->summary.empty()) << shipped.name;
    const auto s = make_scenario(*spec, sources());
    ASSERT_TRUE(s) << shipped.name << "\n" << to_text(s.error());
    EXPECT_GE(s->limits.size(), 5u) << shipped.name;
    EXPECT_TRUE(std::ranges::any_of(s->limits, [](const Limit& l) { return l.of == Limit::Of::kSession && l.min; }))
        << shipped.name << " would pass without running";
    EXPECT_EQ(find_shipped_scenario(shipped.name), &shipped);
  }
  EXPECT_EQ(find_shipped_scenario("nothing"), nullptr);
}

}  // namespace
}  // namespace tandem::netsim
