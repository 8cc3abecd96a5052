#include "netsim/feel/feel_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "netsim/feel/noticeable.h"
#include "tests/netsim/feel/feel_support.h"

namespace tandem::netsim {
namespace {

FeelReport report_of(std::vector<FeelSeed> seeds) {
  FeelReport r;
  r.scene = "contact";
  r.network = "delay 100 ms";
  r.channel = "set_position";
  r.spec = tandem::test::set_position("contact");
  r.seeds = std::move(seeds);
  r.numbers = summarised(r.seeds);
  r.one_way_s = 0.1;
  return r;
}
const std::vector<FeelSeed> kThree{{1, {{"stiffness_felt_n_m", 40}, {"drag_1hz_n", 1}}},
                                   {2, {{"stiffness_felt_n_m", 50}, {"drag_1hz_n", 4}}},
                                   {3, {{"stiffness_felt_n_m", 60}, {"drag_1hz_n", 1}}}};

TEST(FeelSummary, TakesTheLeastStiffnessAndTheGreatestDragAsWorst) {
  const auto numbers = summarised(kThree);
  EXPECT_DOUBLE_EQ(numbers.at("stiffness_felt_n_m").mean, 50);
  EXPECT_DOUBLE_EQ(numbers.at("stiffness_felt_n_m").worst, 40);
  EXPECT_EQ(numbers.at("stiffness_felt_n_m").worst_seed, 1u);
  EXPECT_DOUBLE_EQ(numbers.at("drag_1hz_n").worst, 4);
  EXPECT_EQ(numbers.at("drag_1hz_n").worst_seed, 2u);
}

TEST(FeelSummary, ReportsUnknownIfASeedLacksTheValue) {
  std::vector<FeelSeed> seeds = kThree;
  seeds[1].values.erase("drag_1hz_n");
  const FeelNumber drag = summarised(seeds).at("drag_1hz_n");
  EXPECT_TRUE(std::isnan(drag.mean));
  EXPECT_TRUE(std::isnan(drag.worst));
  EXPECT_EQ(drag.worst_seed, 2u);
}

TEST(FeelLimit, HoldsForTheMeanAndOneAndAHalfTimesForTheWorst) {
  const FeelLimit most{"drag_1hz_n", 2, false}, least{"stiffness_felt_n_m", 50, true};
  EXPECT_TRUE(most.holds({2, 3, 1}));
  EXPECT_FALSE(most.holds({2.01, 2.5, 1}));
  EXPECT_FALSE(most.holds({2, 3.01, 1}));
  EXPECT_FALSE(most.holds({NAN, NAN, 1}));
  EXPECT_TRUE(least.holds({50, 34, 1}));
  EXPECT_FALSE(least.holds({49, 45, 1}));
  EXPECT_FALSE(least.holds({60, 33, 1}));
}

TEST(FeelLimit, ParsesTextAndSuggestsTheNearestKey) {
  const auto limit = parse_feel_limit("drag_1hz_n<=0.15");
  ASSERT_TRUE(limit);
  EXPECT_EQ(limit->key, "drag_1hz_n");
  EXPECT_DOUBLE_EQ(limit->end, 0.15);
  EXPECT_FALSE(limit->at_least);
  EXPECT_TRUE(parse_feel_limit("stiffness_felt_n_m>=360")->at_least);
  for (const char* bad :
       {"", "drag_1hz_n", "drag_1hz_n<0.15", "drag_1hz_n<=", "drag_1hz_n<=nan", "drag_1hz_n<=1N", "drag_1hz_n=<1"})
    EXPECT_FALSE(parse_feel_limit(bad)) << bad;
  EXPECT_NE(parse_feel_limit("drag_1h_n<=1").error().find("did you mean drag_1hz_n"), std::string::npos);
}

TEST(FeelReport, PassesOnlyWhenEveryLimitHoldsAndEverythingWasMeasured) {
  FeelReport r = report_of(kThree);
  EXPECT_TRUE(r.passed());
  r.limits = {{"drag_1hz_n", 3, false}};
  EXPECT_TRUE(r.passed());
  r.limits.push_back({"stiffness_felt_n_m", 360, true});
  EXPECT_FALSE(r.passed());
  r.limits = {{"gain_max", 1.3, false}};
  EXPECT_FALSE(r.passed()) << "a number that was not measured keeps no limit";
  EXPECT_NE(feel_text(r).find("gain_max: was not measured"), std::string::npos);
  r.limits.clear();
  r.troubles = {"seed 1: it did not begin"};
  EXPECT_FALSE(r.passed());
}

TEST(FeelReport, FitsEightyColumnsAndMarksNoticeableValues) {
  FeelReport r = report_of({{1, {}}});
  for (const FeelSection& section : feel_sections())
    for (const FeelKey& key : section.keys) r.seeds[0].values[std::string(key.key)] = 123.456;
  r.numbers = summarised(r.seeds);
  r.limits = {{"stiffness_felt_n_m", 360, true}};
  r.troubles = {
      "seed 1, probe press: the session never ran because of a reason that needs more than one line of a terminal to "
      "be shown in full"};
  std::istringstream lines(feel_text(r));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_NE(feel_text(r).find("FAIL stiffness_felt_n_m"), std::string::npos);
  EXPECT_NE(feel_text(r).find("steps softer than the 392 N/m"), std::string::npos);
}

TEST(FeelReport, SaysNothingAboutPerceptionWithoutASeed) {
  const std::string perception = "Perception by a person";
  EXPECT_NE(feel_text(report_of(kThree)).find(perception), std::string::npos);
  EXPECT_EQ(feel_text(report_of({})).find(perception), std::string::npos) << "interrupted before a seed ended";
  EXPECT_TRUE(nlohmann::json::parse(feel_json(report_of({})))["noticed"].empty());
}

TEST(FeelReport, WritesEveryNumberAsJsonWithoutNan) {
  std::vector<FeelSeed> seeds = kThree;
  seeds[0].values["gain_max"] = NAN;
  const auto json = nlohmann::json::parse(feel_json(report_of(seeds)));
  EXPECT_EQ(json["feel"]["stiffness_felt_n_m"]["worst"], 40);
  EXPECT_EQ(json["feel"]["stiffness_felt_n_m"]["unit"], "N/m");
  EXPECT_TRUE(json["feel"]["gain_max"]["mean"].is_null());
  EXPECT_EQ(json["seeds"][1]["drag_1hz_n"], 4);
}

TEST(FeelReport, TransfersProbeResultsBetweenProcessesUnchanged) {
  ProbeResult result;
  result.values = {{"gain_max", 5.25}, {"overshoot", NAN}};
  result.exposure = {10, 9, 1, 0.5, 3, 0.25};
  result.lived_s = 12;
  result.trouble = "no";
  const ProbeResult back = probe_result_from_bytes(to_bytes(result));
  EXPECT_EQ(back.values.at("gain_max"), 5.25);
  EXPECT_TRUE(std::isnan(back.values.at("overshoot")));
  EXPECT_EQ(back.exposure.trips, 3);
  EXPECT_EQ(back.exposure.error_square, 0.25);
  EXPECT_EQ(back.lived_s, 12);
  EXPECT_EQ(back.trouble, "no");
}

TEST(FeelKeys, MatchTheKeysOfProbes) {
  FeelSetup setup = contact_over(0);
  setup.scene.send.rate = 500;  // the shares of datagrams exist only then
  const DrawnHand hand{HandKind::kPlain, 1, 0};
  setup.recordings = {{"still", hand.move([](double t) { return hal::Vec3(0.01 * t, 0, 0); }, 2)}};
  FeelValues all;
  Exposure exposure;
  for (const ProbeName& one : kProbes) {
    const ProbeResult result = run_probe(one.probe, setup, 1);
    all.insert(result.values.begin(), result.values.end());
    exposure.add(result.exposure);
  }
  put_exposure(exposure, all);
  std::size_t count = 0;
  for (const FeelSection& section : feel_sections())
    for (const FeelKey& key : section.keys) {
      EXPECT_TRUE(all.contains(std::string(key.key))) << key.key << " is in the report and no probe measures it";
      ++count;
    }
  EXPECT_EQ(all.size(), count) << "a number is measured and not reported";
}

TEST(Noticeable, AppliesToForceStepsAndForceDelay) {
  const std::map<std::string, FeelNumber> felt{{"stiffness_felt_n_m", {in_series(400, kBone) / 1.23, 1, 1}},
                                               {"stiffness_tissue_n_m", {in_series(400, kBone) / 1.23 / 1.23, 1, 1}},
                                               {"force_share", {1 / 1.07, 1, 1}},
                                               {"apparent_mass_1hz_kg", {0.021, 1, 1}}};
  for (const bool local : {true, false}) {
    std::map<std::string, double> n;
    for (const auto& [key, value] : noticeable_numbers(
             local ? tandem::test::shipped("contact") : tandem::test::set_position("contact"), felt, 0.05))
      n[key] = value;
    EXPECT_NEAR(n.at("stiffness_lost_steps"), 1, 1e-9);
    EXPECT_NEAR(n.at("bone_tissue_steps"), 1, 1e-9);
    EXPECT_NEAR(n.at("force_lost_steps"), 1, 1e-9);
    EXPECT_NEAR(n.at("mass_added_steps"), 1, 1e-9);
    EXPECT_NEAR(n.at("others_late_s"), 0.1, 1e-12);
    EXPECT_NEAR(n.at("own_contact_late_s"), local ? 0 : 0.1, 1e-12);
  }
  for (const auto& [key, value] : noticeable_numbers(tandem::test::shipped("contact"), {}, NAN))
    EXPECT_TRUE(std::isnan(value)) << key;
  const auto j = nlohmann::json::parse(feel_json(report_of(kThree)));
  EXPECT_NEAR(j.at("noticeable").at("others_late_s").get<double>(), 0.2, 1e-12);
  EXPECT_TRUE(j.at("noticeable").at("mass_added_steps").is_null());
}

TEST(Noticeable, AStepIsTheWeberFraction) {
  EXPECT_NEAR(noticeable_steps(123, 100, 0.23), 1, 1e-9);
  EXPECT_NEAR(noticeable_steps(100, 123 * 1.23, 0.23), 2, 1e-9);
  EXPECT_DOUBLE_EQ(noticeable_steps(5, 5, 0.07), 0);
  EXPECT_TRUE(std::isnan(noticeable_steps(-1, 5, 0.07)));
  // Bone of 45 N/m out of 392 N/m possible; bone of 45 N/m next to tissue of 40 N/m.
  EXPECT_NEAR(noticeable_steps(45, 392, kStiffnessWeber), 10.5, 0.1);
  EXPECT_LT(noticeable_steps(45, 40, kStiffnessWeber), 1);
}

}  // namespace
}  // namespace tandem::netsim
