#include "netsim/score/score_output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "netsim/score/path_picture.h"
#include "netsim/score/score_page.h"
#include "netsim/score/score_tables.h"
#include "tests/netsim/score/lesson_maker.h"

namespace tandem::netsim::score {
namespace {

const std::string kHostile = "<script>alert(\"x\")</script>&,\n";

/// A lesson with two seats, contact, a change of authority, notes and sheets; all names are hostile.
LessonMaker rich() {
  LessonMaker maker({"trainer", "trainee"});
  maker.ticks(3000)
      .hand(0, [](double t) { return LessonTriple{0.1 * std::sin(t), 0.05 * t, 0.02 * std::cos(3 * t)}; })
      .hand(1, [](double t) { return LessonTriple{0.1 * std::sin(t - 0.02), 0.05 * t, 0.02 * std::cos(3 * t)}; })
      .force(0, [](double t) { return LessonTriple{std::sin(t), 0, 0}; })
      .force(1, [](double t) { return LessonTriple{3 * std::sin(t), 0, 0.1}; })
      .authority(0, [](double t) { return t < 1.5 ? 0.0 : 1.0; })
      .authority(1, [](double t) { return t < 1.5 ? 1.0 : 0.0; })
      .tool([](double t) { return LessonTriple{0.1 * std::sin(t), 0.05 * t, 0}; },
            [](double t) { return LessonTriple{t > 1 && t < 2 ? 1.0 : 0.0, 0, 0}; });
  Lesson& lesson = maker.lesson;
  lesson.session = kHostile;
  lesson.start_unix_ns = 1'700'000'000'000'000'000;
  lesson.seats[1].person = kHostile;
  lesson.marks.push_back({0.5, kHostile, kHostile});
  lesson.events.push_back({700, 0, "stop", kHostile, kHostile});
  lesson.sheets.push_back({"GOALS", "trainee", kHostile, {{"autonomy", 4}}, true});
  return maker;
}

ScoreResult result_of(const LessonMaker& maker, std::size_t sessions = 1) {
  ScoreResult result;
  for (std::size_t i = 0; i < sessions; ++i) {
    result.lessons.push_back(maker.scores());
    result.lessons.back().file = "monday" + std::to_string(i) + ",.csv";
  }
  result.seat = "trainee";
  result.sheets = sheet_totals(result.lessons, result.notes);
  return result;
}

TEST(ScoreOutput, IsValidJsonWithoutNumbersForUnknownValues) {
  const auto json = nlohmann::json::parse(scores_json(result_of(rich())));
  const auto& part = json["lessons"][0]["seats"][1]["parts"][0];
  EXPECT_EQ(part["part"], "whole");
  EXPECT_EQ(part["metrics"].size(), kMetricCount);
  EXPECT_TRUE(part["metrics"]["rtt_p50"]["value"].is_null());
  EXPECT_EQ(part["metrics"]["rtt_p50"]["trust"], "absent");
  EXPECT_EQ(part["metrics"]["force_peak"]["unit"], "N");
  EXPECT_NEAR(part["metrics"]["force_peak"]["value"].get<double>(), std::hypot(3, 0.1), 1e-3);
  EXPECT_EQ(json["lessons"][0]["interventions"][0]["seat"], "trainer");
  EXPECT_EQ(json["sheets"]["totals"][0]["rated"], 1);
  EXPECT_EQ(json["lessons"][0]["options"]["position_cutoff_hz"], 10);
}

TEST(ScoreOutput, WritesWithheldValuesNowhere) {
  LessonMaker maker = rich();
  maker.lesson.seats[1].fresh.assign(3000, 0);
  maker.lesson.seats[1].fresh[0] = 1;
  const ScoreResult result = result_of(maker);
  const auto json = nlohmann::json::parse(scores_json(result));
  const auto& metric = json["lessons"][0]["seats"][1]["parts"][0]["metrics"]["path_length"];
  EXPECT_TRUE(metric["value"].is_null());
  EXPECT_EQ(metric["trust"], "withheld");
  EXPECT_NE(metric["reason"].get<std::string>().find("of the samples are missing"), std::string::npos);
  EXPECT_NE(scores_csv(result).find(",trainee,trainee,whole,path_length,m,,withheld,"), std::string::npos);
  EXPECT_NE(scores_text(result, "trainee").find("withheld"), std::string::npos);
  EXPECT_NE(score_page(maker.lesson, result, "test").find("values withheld"), std::string::npos);
}

TEST(ScoreOutput, HasNineCellsInEveryLineOfCsv) {
  std::istringstream csv(scores_csv(result_of(rich())));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line); ++lines) ASSERT_EQ(std::ranges::count(line, ','), 8) << line;
  EXPECT_EQ(lines, 1 + 2 * 3 * kMetricCount) << "two seats, three parts";
}

TEST(ScoreOutput, StatesConditionsAndInterventionsInText) {
  const std::string text = scores_text(result_of(rich()), "trainee");
  EXPECT_NE(text.find("low-pass of effective order 4 without phase (Butterworth of order 2, run forward and backward), "
                      "cut-off (-3 dB after both runs) 10 Hz for positions and 20 Hz for forces"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("1.50 to 3.00 s: trainer takes tool tool from trainee (not recorded)"), std::string::npos)
      << text;
  EXPECT_NE(text.find("held:trainee"), std::string::npos);
  EXPECT_EQ(text.find("\ntrainer, instructor"), std::string::npos) << "only the named seat";
}

TEST(ScoreOutput, CutsNoHeadOfAColumnAndNamesNoToolThatIsNotRecorded) {
  LessonMaker maker = rich();
  maker.lesson.scene.phases = {{"demonstration_of_the_instructor", 0, 1.5, false}};
  std::string text = scores_text(result_of(maker), "trainee");
  EXPECT_NE(text.find("  phase:demonstration_of_the_instructor\n"), std::string::npos) << text;
  EXPECT_NE(text.find("trainee, tool tool\n"), std::string::npos) << text;
  maker.lesson.tools[0] = {};
  text = scores_text(result_of(maker), "trainee");
  EXPECT_NE(text.find("trainee, no tool\n"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(scores_json(result_of(maker)));
  EXPECT_TRUE(json["lessons"][0]["seats"][1]["tool"].is_null());
}

TEST(ScorePage, IsWholeAndEscapesEveryText) {
  const LessonMaker maker = rich();
  const std::string page = score_page(maker.lesson, result_of(maker), "1.2");
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos) << "self-contained";
  EXPECT_EQ(page.find("href=\"http"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
  EXPECT_NE(page.find("stop: &lt;script&gt;"), std::string::npos);
  EXPECT_NE(page.find("2023-11-14 22:13 UTC"), std::string::npos);
  for (const char* section : {"id=\"scores\"", "id=\"path\"", "id=\"time\"", "id=\"events\"", "id=\"link\"",
                              "id=\"evaluators\"", "id=\"all\"", "svg class=\"figure isometric\"", "</html>"})
    EXPECT_NE(page.find(section), std::string::npos) << section;
  EXPECT_EQ(page.find("id=\"progress\""), std::string::npos) << "no experts";
}

TEST(ScorePage, ComparesWithExpertsInWords) {
  const LessonMaker maker = rich();
  ScoreResult result = result_of(maker, 3);
  result.experts = 3;
  result.thresholds = thresholds_of(result.lessons, "trainee");
  result.curves = learning_curves(result.lessons, "trainee", result.thresholds);
  const std::string page = score_page(maker.lesson, result, "1.2");
  EXPECT_NE(page.find("as good as the experts, or better"), std::string::npos);
  EXPECT_NE(page.find("id=\"progress\""), std::string::npos);
  EXPECT_NE(page.find("Learning curves"), std::string::npos);
  const Threshold path{3, 0.1, 0.01, 0.115};
  EXPECT_EQ(standing_text(path, Metric::kPathLength, 0.09), "as good as the experts, or better");
  EXPECT_EQ(standing_text(path, Metric::kPathLength, 0.11), "within the experts' range");
  EXPECT_EQ(standing_text(path, Metric::kPathLength, 0.135), "20.0 mm more than the pass mark");
}

TEST(ScorePage, SurvivesALessonWithoutSamples) {
  LessonMaker maker;
  maker.ticks(100).hand(0, [](double) { return kUnknownTriple; });
  const std::string page = score_page(maker.lesson, result_of(maker), "1.2");
  EXPECT_NE(page.find("has no samples of a hand"), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
}

TEST(PathPicture, PutsXToTheLowerRightYToTheUpperRightAndZUp) {
  const auto end_of = [](const LessonTriple& direction) {
    const std::string svg = isometric_picture({{"series0", "p", {{0, 0, 0}, direction}}}, "d");
    double x[2]{}, y[2]{};
    std::size_t at = 0;
    for (int i = 0; i < 2; ++i) {
      at = svg.find("<circle class=\"dot\" cx=\"", at) + 24;
      x[i] = std::atof(svg.c_str() + at);
      at = svg.find("cy=\"", at) + 4;
      y[i] = std::atof(svg.c_str() + at);
    }
    return std::pair{x[1] - x[0], y[1] - y[0]};
  };
  const auto [xx, xy] = end_of({0.1, 0, 0});
  EXPECT_GT(xx, 0);
  EXPECT_GT(xy, 0) << "down";
  const auto [yx, yy] = end_of({0, 0.1, 0});
  EXPECT_GT(yx, 0);
  EXPECT_LT(yy, 0) << "up";
  const auto [zx, zy] = end_of({0, 0, 0.1});
  EXPECT_NEAR(zx, 0, 0.2);
  EXPECT_LT(zy, 0);
}

TEST(PathPicture, HasRoomForTheLabelsOfTheEdges) {
  constexpr double kCharacter = 7;  // [px] width of a character of the labels (11 px), at most
  for (const LessonTriple& size : {LessonTriple{0, 0, 0}, {0.3, 0.3, 0.01}, {0.01, 0.01, 0.4}, {0.01, 0.5, 5}}) {
    const std::string svg = isometric_picture({{"series0", "p", {{0, 0, 0}, size}}}, "d");
    std::size_t labels = 0;
    for (std::size_t at = svg.find("<text class=\"tick"); at != std::string::npos;
         at = svg.find("<text class=\"tick", at + 1)) {
      const std::size_t begin = svg.find('>', at) + 1;
      const double length = kCharacter * static_cast<double>(svg.find('<', begin) - begin);
      const double x = std::atof(svg.c_str() + svg.find("x=\"", at) + 3);
      const bool ends = svg.compare(at, 21, "<text class=\"tick end") == 0;
      EXPECT_GE(ends ? x - length : x, 0) << svg.substr(begin, 20);
      EXPECT_LE(ends ? x : x + length, 640) << svg.substr(begin, 20);
      ++labels;
    }
    EXPECT_EQ(labels, 3U);
  }
}

TEST(PathPicture, SurvivesEmptyAndBrokenPaths) {
  EXPECT_NE(isometric_picture({}, "d").find("</svg>"), std::string::npos);
  EXPECT_EQ(isometric_picture({{"series0", "p", {kUnknownTriple, kUnknownTriple}}}, "d").find("nan"),
            std::string::npos);
}

}  // namespace
}  // namespace tandem::netsim::score
