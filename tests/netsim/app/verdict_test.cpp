// Verdicts of scenarios: independent of parallel runs, every failure reported with its causes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "netsim/app/scenario_loader.h"
#include "netsim/app/test_report.h"
#include "netsim/system/run_simulation.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::json;
using State = SeedOutcome::State;

Scenario scenario(const std::string& text, const std::string& file = "some.textproto") {
  auto loaded = load_scenario_text(text, file, false);
  if (!loaded) throw std::runtime_error(to_text(loaded.error()));
  return std::move(*loaded);
}

/// Two seconds on one axis over a network with random impairments.
Scenario small(const std::string& more = "") {
  return scenario(
      "version: 1 scene: \"one_axis\" duration_s: 2 seeds: 6 network { delay_ms: 5 jitter_ms: 5 loss_percent: 5 }\n"
      "seat_limits { loss_percent { min: 1 max: 10 } effort_peak_n { max: 3.4 } }\n" +
      more);
}

/// Removes the machine-dependent parts of a JSON value.
void without_cpu(Json& json) {
  if (json.is_object()) json.erase("cpu_s");
  for (Json& child : json)
    if (child.is_structured()) without_cpu(child);
}

Json verdicts(const TestResult& result) {
  Json json = Json::parse(test_json(result));
  without_cpu(json);
  return json;
}

TEST(Verdict, IsIndependentOfTheNumberOfJobs) {
  std::vector<Json> all;
  for (const std::size_t jobs : {1u, 2u, 5u}) {
    const TestResult result = run_tests({small(), small()}, {.jobs = jobs, .reports = true});
    EXPECT_TRUE(result.passed()) << test_summary(result);
    all.push_back(verdicts(result));
    EXPECT_EQ(all.back(), all.front()) << jobs;
  }
  const Json& seeds = all.front()["scenarios"][0]["seeds"];
  ASSERT_EQ(seeds.size(), 6u);
  EXPECT_NE(seeds[0]["trace_hash"], seeds[1]["trace_hash"]) << "another seed, another run";
  EXPECT_EQ(seeds[0]["report"]["seats"][0]["link"]["up"]["loss_percent"], seeds[0]["values"][1]);
}

TEST(Verdict, SharesNothingBetweenSimulationsInOneProcess) {
  // The tsan build detects shared state; this test detects its effects.
  const Scenario s = small();
  const auto hash = [&](std::uint64_t seed) {
    SimulationConfig setup = s.setup;
    setup.seed = seed;
    return run_simulation(setup).report.trace_hash;
  };
  const std::vector<std::string> alone{hash(1), hash(2), hash(3)};
  std::vector<std::string> together(3);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < 3; ++i) threads.emplace_back([&, i] { together[i] = hash(i + 1); });
  }
  EXPECT_EQ(together, alone);
}

TEST(Verdict, ReportsABrokenLimitWithValueRangeAndReplay) {
  const TestResult result =
      run_tests({small("seat_limits { seat: \"trainer\" up_loss_percent { min: 90 } tracking_rms_m { max: 0 } }")}, {});
  EXPECT_FALSE(result.passed());
  const ScenarioResult& r = result.scenarios.front();
  EXPECT_EQ(r.failed(), 6u);
  const auto all = causes(r.scenario, r.seeds[0]);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(std::regex_match(all[0], std::regex("trainer: tracking_rms_m = [0-9.e-]+ m, must be at most 0 m")))
      << all[0];
  EXPECT_TRUE(std::regex_match(all[1], std::regex("trainer: up_loss_percent = [0-9.]+ %, must be at least 90 %")))
      << all[1];
  const std::string text = test_summary(result);
  for (const char* part : {"FFFFFF", "FAIL 6 of 6", "BROKEN", "FAIL some, seed 3", "0 of 6 seeds passed, 6 failed",
                           "  replay: tandem-netsim test some.textproto --seed 3 --seeds 1 --trace some-3.csv\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " not in\n" << text;
  const Json json = verdicts(result);
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_EQ(json["scenarios"][0]["seeds"][2]["causes"].size(), 2u);
}

TEST(Verdict, FailsALimitWithoutAMeasuredValue) {
  // The first second after engaging is excluded: a run of half a second has no tracking error.
  Scenario s = scenario("version: 1 scene: \"one_axis\" duration_s: 0.5 seat_limits { tracking_rms_m { max: 1 } }");
  const TestResult result = run_tests({s}, {});
  EXPECT_EQ(result.scenarios[0].seeds[0].state, State::kFail);
  const Json json = verdicts(result);
  EXPECT_TRUE(json["scenarios"][0]["seeds"][0]["values"][0].is_null());
  EXPECT_EQ(json["scenarios"][0]["seeds"][0]["causes"][0], "trainer: tracking_rms_m = none, must be at most 1 m");
}

TEST(Verdict, ReportsASessionThatCannotStartAsOneFailedSeed) {
  Scenario late = scenario("version: 1 scene: \"one_axis\" network { delay_ms: 5000 }", "late.textproto");
  Scenario link = small();
  link.name = "impossible";
  link.setup.network.up.loss.probability = 2;  // no parser accepts this; the engine itself rejects it
  const TestResult result = run_tests({late, link, small()}, {});
  EXPECT_EQ(result.scenarios[0].seeds[0].state, State::kTrouble);
  EXPECT_NE(result.scenarios[0].seeds[0].trouble.find("loop_age_max_ms"), std::string::npos);
  EXPECT_EQ(result.scenarios[1].seeds[5].state, State::kTrouble);
  EXPECT_NE(result.scenarios[1].seeds[5].trouble.find("loss"), std::string::npos)
      << result.scenarios[1].seeds[5].trouble;
  EXPECT_TRUE(result.scenarios[2].passed());
  EXPECT_NE(test_summary(result).find("TTTTTT"), std::string::npos);
}

TEST(Verdict, ReportsACrashedProcessAsOneFailedSeed) {
  // A trace that cannot be written completely throws in the seed's own process.
  const TestResult result = run_tests({small()}, {.seeds = 1, .trace = "/dev/full"});
  const SeedOutcome& seed = result.scenarios[0].seeds[0];
  EXPECT_EQ(seed.state, State::kCrash);
  EXPECT_EQ(causes(result.scenarios[0].scenario, seed).size(), 1u);
  EXPECT_NE(seed.trouble.find("/dev/full"), std::string::npos) << seed.trouble;
  EXPECT_NE(junit_xml(result).find("<error message=\"the run crashed: threw: "), std::string::npos);
}

TEST(Verdict, KeepsTheSameFailFastSeedsForAnyNumberOfJobs) {
  std::vector<Json> all;
  for (const std::size_t jobs : {1u, 3u}) {
    const TestResult result = run_tests({small(), small("seat_limits { gate_trips { min: 1 } }"), small()},
                                        {.jobs = jobs, .fail_fast = true});
    EXPECT_EQ(result.scenarios[0].count(State::kPass), 6u);
    EXPECT_EQ(result.scenarios[1].count(State::kNotRun), 5u);
    EXPECT_EQ(result.not_run(), 11u);
    all.push_back(verdicts(result));
  }
  EXPECT_EQ(all[0], all[1]);
  EXPECT_EQ(all[0]["seeds_not_run"], 11);
}

/// Returns an error if a text is not well-formed for an XML reader: elements closed in order, attributes quoted,
/// entities escaped.
std::string xml_trouble(const std::string& xml) {
  static const std::regex part(
      R"(<\?xml [^<>]*\?>|<(/?)([a-z-]+)((?: [a-z]+="(?:[^<>&"]|&(?:amp|lt|gt|quot|#10);)*")*)(/?)>|[^<>&]+|&(?:amp|lt|gt|quot|#10);)");
  std::vector<std::string> open;
  auto at = xml.begin();
  for (std::smatch m; at != xml.end(); at = m[0].second) {
    if (!std::regex_search(at, xml.end(), m, part, std::regex_constants::match_continuous))
      return std::string(at, xml.end()).substr(0, 60);
    if (!m[2].matched) continue;
    if (m[1].length() > 0) {
      if (open.empty() || open.back() != m[2]) return "closes " + m[2].str();
      open.pop_back();
    } else if (m[4].length() == 0) {
      open.push_back(m[2]);
    }
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

TEST(Verdict, EscapesEveryTextInJUnit) {
  TestResult result = run_tests({small()}, {.seeds = 3});
  ScenarioResult& r = result.scenarios.front();
  r.scenario.name = "<a&\"b'>";
  r.scenario.summary =
      "control \x01\x1f\x7f tab\tline\nend \xC3\xA9 broken \xC3 \xFF \xED\xA0\x80 \xEF\xBF\xBF \xF4\x90\x80\x80 ]]>";
  r.seeds[1].state = State::kCrash;
  r.seeds[1].trouble = "]]> </failure> & <testcase> \x1b[31m";
  r.seeds[1].recording = "a & b/<\"x\">.mcap";
  r.seeds[2].state = State::kNotRun;
  const std::string xml = junit_xml(result);
  EXPECT_EQ(xml_trouble(xml), "");
  EXPECT_NE(xml.find("value=\"control ??\x7f tab\tline&#10;end \xC3\xA9 broken ? ? ??? ??? ???? ]]&gt;\""),
            std::string::npos)
      << xml;
  EXPECT_NE(xml.find("name=\"recording\" value=\"a &amp; b/&lt;&quot;x&quot;&gt;.mcap\"/>"), std::string::npos) << xml;
  EXPECT_NE(xml.find("<system-out>\n[[ATTACHMENT|a &amp; b/&lt;&quot;x&quot;&gt;.mcap]]\n<"), std::string::npos) << xml;
  EXPECT_NE(xml.find("tests=\"3\" failures=\"0\" errors=\"1\" skipped=\"1\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("<skipped message=\"not run\"/>"), std::string::npos);
  EXPECT_NE(xml_trouble("<a><b></a></b>"), "") << "the check itself bites";
  EXPECT_NE(xml_trouble("<a x=\"&\"/>"), "");
}

TEST(Verdict, AppliesAScenarioOutageAndReportsARedNetwork) {
  const TestResult result = run_tests(
      {scenario("version: 1 scene: \"one_axis\" duration_s: 4 event { at_s: 2 client: \"trainer\" outage_ms: 600 }\n"
                "seat_limits { longest_gap_ms { min: 600 max: 602 } gate_trips { min: 1 } }")},
      {});
  EXPECT_TRUE(result.passed()) << test_summary(result);
  ASSERT_EQ(result.scenarios[0].seeds[0].bands.size(), 1u);
  EXPECT_EQ(result.scenarios[0].seeds[0].bands[0], (std::pair<std::string, std::string>{"trainer", "red"}));
  EXPECT_NE(test_summary(result).find("network for force feedback, at the worst seed: red: trainer"), std::string::npos)
      << test_summary(result);
}

TEST(Verdict, ReportsEventsAndFaultsOutsideTheSession) {
  const TestResult result = run_tests(
      {scenario("version: 1 scene: \"one_axis\" duration_s: 1 seeds: 2\n"
                "event { at_s: 0 outage_ms: 1 } event { at_s: 0.5 outage_ms: 5 } event { at_s: 90 outage_ms: 5 }\n"
                "fault { kind: PAUSE at_s: 70 for_ms: 5 }")},
      {});
  const std::string text = test_summary(result);
  for (const char* part :
       {"  note: the outage at 0 s was over before the session began, at ",
        "  note: the outage at 90 s came after the end of the run, ",
        "  note: the fault PAUSE at 70 s came after the end of the run, ", "(seed 1, the others alike)"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " not in\n" << text;
  EXPECT_EQ(text.find("the outage at 0.5 s"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(test_json(result));
  EXPECT_EQ(json["scenarios"][0]["seeds"][1]["notes"].size(), 3u);
}

TEST(Verdict, DescribesTheWorstSeedsNetworkPerDirection) {
  TestResult result = run_tests({scenario("version: 1 scene: \"one_axis\" duration_s: 4 seeds: 2 event { at_s: 2 "
                                          "client: \"trainer\" direction: UP outage_ms: 300 }")},
                                {});
  // The same text as that of `run`, for the affected seed.
  auto& seeds = result.scenarios[0].seeds;
  SimulationConfig setup = result.scenarios[0].scenario.setup;
  setup.seed = 1;
  setup.monitor_quality = true;
  const std::string words = quality_report(run_simulation(setup).links, false);
  EXPECT_EQ(seeds[0].network_text, words);
  EXPECT_NE(words.find("    up: red; "), std::string::npos) << words;
  EXPECT_NE(words.find("    down: green; "), std::string::npos) << words;
  EXPECT_NE(test_summary(result).find("\n  seed 1, network of trainer: red, "), std::string::npos)
      << test_summary(result);
  EXPECT_NE(test_summary(result).find(words.substr(words.find("    up: red; "))), std::string::npos)
      << test_summary(result);
  seeds[1].badness = 3.5;  // above every share of red in the other scenario
  EXPECT_NE(test_summary(result).find("\n  seed 2, network of trainer: red, "), std::string::npos)
      << test_summary(result);
  for (SeedOutcome& s : seeds) s.network_text.clear();  // crashed, or never started
  EXPECT_EQ(test_summary(result).find("    up: "), std::string::npos);
}

TEST(Verdict, QuotesReplayCommandsForAShell) {
  Scenario s = small();
  s.file = "my folder/it's; rm.textproto";
  s.name = "it's; rm";
  EXPECT_EQ(replay_command(s, 3),
            "tandem-netsim test 'my folder/it'\\''s; rm.textproto' --seed 3 --seeds 1 --trace 'it'\\''s; rm-3.csv'");
}

TEST(Verdict, TransfersOutcomesBetweenProcessesUnchanged) {
  SeedOutcome o{.seed = ~0ULL,
                .state = State::kFail,
                .trouble = "a\n\"b\"",
                .violations = {{"finite", "x", 0.1, false, 1ULL << 60}},
                .values = {0.1, std::nan(""), 1e300},
                .bands = {{"x", "red"}},
                .notes = {"a note"},
                .network_text = "  network: \n",
                .badness = 2.25,
                .trace_hash = "abc",
                .duration_s = 1.0 / 3,
                .cpu_s = 0.2,
                .report = "{\"a\":1}"};
  const SeedOutcome back = outcome_from_bytes(to_bytes(o));
  EXPECT_EQ(back.seed, o.seed);
  EXPECT_EQ(back.state, o.state);
  EXPECT_EQ(back.trouble, o.trouble);
  EXPECT_EQ(back.violations[0].count, 1ULL << 60);
  EXPECT_EQ(back.values[0], 0.1);
  EXPECT_TRUE(std::isnan(back.values[1]));
  EXPECT_EQ(back.duration_s, 1.0 / 3);
  EXPECT_EQ(back.report, o.report);
  EXPECT_EQ(back.bands, o.bands);
  EXPECT_EQ(back.notes, o.notes);
  EXPECT_EQ(back.network_text, o.network_text);
  EXPECT_EQ(back.badness, o.badness);
}

TEST(Verdict, ReportsGapsOfARecordedNetworkOncePerScenario) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "scenario_recordings";
  fs::create_directories(folder);
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("rtt.csv", "t_s[s],rtt_ms[ms]\n0,10\n0.1,20\n5.1,10\n5.2,10\n");
  write("bare.csv", "rtt_ms[ms]\n10\n20\n");
  write("of_seat.textproto",
        "version: 1 scene: \"one_axis\" duration_s: 1 seeds: 2 seat_network { seat: \"trainer\" network { profile: "
        "\"rtt.csv\" } }\n"
        "event { at_s: 0.5 profile: \"rtt.csv\" }\nevent { at_s: 0.7 profile: \"lan\" }\n");
  write("of_event.textproto",
        "version: 1 scene: \"one_axis\" duration_s: 1 event { at_s: 0.5 profile: \"rtt.csv\" }\n");
  for (const char* name : {"of_seat.textproto", "of_event.textproto"}) {
    auto loaded = load_scenarios({(folder / name).string()});
    ASSERT_TRUE(loaded) << to_text(loaded.error());
    const std::string check = effective_scenario_text(loaded->front());
    const TestResult result = run_tests(std::move(*loaded), {});
    const std::string table = test_summary(result),
                      split = (folder / "rtt.csv").string() +
                              ": the recording holds round trips; each direction gets half of them";
    const std::string gap = (folder / "rtt.csv").string() + ":3: the recording has 1 gap";
    for (const std::string& part : {split, gap}) {
      EXPECT_NE(table.find("  note: " + part), std::string::npos) << name << "\n" << table;
      EXPECT_EQ(table.find(part), table.rfind(part)) << table;
      EXPECT_NE(check.find("note: " + part), std::string::npos) << check;
    }
    EXPECT_EQ(verdicts(result)["scenarios"][0]["notes"].size(), 2u);
    EXPECT_EQ(verdicts(result)["scenarios"][0]["notes"][0], split);
  }
  write("of_seat.textproto", "version: 1 scene: \"one_axis\" network { profile: \"rtt.csv\" trace_interval_ms: 5 }\n");
  write("of_event.textproto",
        "version: 1 scene: \"one_axis\" network { profile: \"bare.csv\" trace_interval_ms: 5 }\n");
  const auto twice = load_scenarios({(folder / "of_seat.textproto").string()});
  ASSERT_FALSE(twice);
  EXPECT_NE(
      to_text(twice.error())
          .find(":1:49: network.profile = \"rtt.csv\": trace_interval_ms is for a recording without a column of times"),
      std::string::npos)
      << to_text(twice.error());
  EXPECT_TRUE(load_scenarios({(folder / "of_event.textproto").string()}));
  fs::remove_all(folder);
}

TEST(Verdict, ResolvesFilesRelativeToTheScenario) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "scenario_files";
  fs::create_directories(folder / "data");
  const auto write = [&](const fs::path& name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("data/net.textproto", "version: 1\nboth { floor_ms: 3 }\n");
  write("data/rtt.csv", "t_s[s],rtt_ms[ms]\n0,10\n1,20\n");
  write("data/move.csv", "t_s[s],px[m],py[m],pz[m]\n0,0,0,0\n0.5,0.02,0,0\n1,0,0,0\n2,0,0,0\n");
  write("good.textproto",
        "version: 1 scene: \"one_axis\" duration_s: 1.5\nnetwork { profile: \"data/net.textproto\" loss_percent: 2 }\n"
        "seat_network { seat: \"trainer\" network { profile: \"data/rtt.csv\" } }\n"
        "hand { seat: \"trainer\" motion: \"data/move.csv,scale=1\" }\nseat_limits { alpha_mean { min: 0 } }\n");
  write("bad.textproto",
        "version: 1 scene: \"none.textproto\"\nnetwork { profile: \"data/other.csv\" }\nhand { seat: \"trainer\" "
        "motion: \"no.csv\" }\n");
  auto good = load_scenarios({(folder / "good.textproto").string()});
  ASSERT_TRUE(good) << to_text(good.error());
  EXPECT_EQ(good->front().setup.network.up.floor, std::chrono::milliseconds(3));
  EXPECT_EQ(good->front().setup.network.up.loss.probability, 0.02);
  EXPECT_TRUE(good->front().setup.motions.contains("trainer"));
  EXPECT_FALSE(good->front().setup.seat_networks.at("trainer").up.trace == nullptr);
  EXPECT_TRUE(run_tests(std::move(*good), {}).passed());
  const auto bad = load_scenarios({(folder / "bad.textproto").string()});
  ASSERT_FALSE(bad);
  const std::string all = to_text(bad.error());
  for (const std::string& part :
       {":1:19: scene = \"none.textproto\": there is no file " + (folder / "none.textproto").string(),
        std::string(":2:20: network.profile = \"data/other.csv\": there is no file")})
    EXPECT_NE(all.find(part), std::string::npos) << part << " not in\n" << all;
  // A folder denotes all its scenarios; a file named twice is read once.
  const auto both = load_scenarios({folder.string(), (folder / "good.textproto").string()});
  ASSERT_FALSE(both);
  fs::remove(folder / "bad.textproto");
  EXPECT_EQ(load_scenarios({folder.string(), (folder / "good.textproto").string()})->size(), 1u);
  EXPECT_TRUE(load_scenarios({folder.string()})->front().name == "good");
  // Other valid files in a folder are skipped and named; invalid files are reported as faulty scenarios.
  write("lan.textproto", "version: 1\nboth { floor_ms: 3 }\n");
  write("day.textproto", "event { at_s: 1 client: \"trainer\" outage_ms: 400 }\n");
  write("scene.textproto", std::string(find_shipped_scene("one_axis")->text));
  write("README.md", "# not a scenario\n");
  std::vector<std::string> left_out;
  EXPECT_EQ(load_scenarios({folder.string()}, &left_out)->size(), 1u);
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_NE(left_out[0].find(": left out, as they are no scenarios: day.textproto (a script), lan.textproto (a "
                             "profile), scene.textproto (a scene)"),
            std::string::npos)
      << left_out[0];
  write("zz.textproto", "version: 1 both { flor_ms: 3 }\n");
  const auto lost = load_scenarios({folder.string()});
  ASSERT_FALSE(lost);
  EXPECT_NE(to_text(lost.error()).find("zz.textproto: is no scene, profile or script without mistakes; as a profile:"),
            std::string::npos)
      << to_text(lost.error());
  for (const char* name : {"zz", "good"}) fs::remove(folder / (std::string(name) + ".textproto"));
  const auto none = load_scenarios({folder.string()});
  ASSERT_FALSE(none);
  EXPECT_NE(to_text(none.error()).find("this folder holds no scenario, only day.textproto"), std::string::npos)
      << to_text(none.error());
  fs::remove_all(folder);
  EXPECT_EQ(load_scenarios({"shipped", "free-motion-lan"})->size(), load_scenarios({"shipped"})->size());
  const auto shipped = load_scenario_text("version: 1 scene: \"../x.textproto\"", "x", true);
  ASSERT_FALSE(shipped);
  EXPECT_NE(to_text(shipped.error()).find("names shipped scenes and profiles only"), std::string::npos);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace tandem::netsim
