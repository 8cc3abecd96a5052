// Tables of human motion. The shared recordings are used when TANDEM_TRACES names their folder; look-alikes always.
#include "netsim/score/motion_lesson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "netsim/score/score_output.h"
#include "netsim/score/score_page.h"

namespace tandem::netsim::score {
namespace {

std::string table(const std::string& header, int rows, double step_s, double jitter, int left_out = 0) {
  std::ostringstream out;
  out << header << "\n";
  for (int k = 0; k < rows; ++k) {
    if (left_out > 0 && k > rows / 2 && k <= rows / 2 + left_out) continue;
    const double t = k * step_s + (k % 7 == 0 ? jitter * step_s : 0);
    if (header.starts_with("rec")) out << (k < rows / 2 ? 0 : 1) << ",";
    out << (header.starts_with("rec") && k >= rows / 2 ? t - rows / 2 * step_s : t);
    const auto commas = std::ranges::count(header, ',') - (header.starts_with("rec") ? 1 : 0);
    for (std::ptrdiff_t c = 0; c < commas; ++c) out << "," << 0.1 * std::sin((1.3 + 0.1 * static_cast<double>(c)) * t);
    out << "\n";
  }
  return out.str();
}

/// Scores a recording, and checks that no output shows a value that is not a number.
std::optional<LessonScores> scored(const std::string& csv, const std::string& name) {
  const auto lesson = read_motion(csv, name);
  if (!lesson) {
    ADD_FAILURE() << lesson.error();
    return {};
  }
  auto scores = score_lesson(*lesson);
  if (!scores) {
    ADD_FAILURE() << scores.error();
    return {};
  }
  scores->file = name;
  ScoreResult result;
  result.lessons.push_back(*scores);
  result.seat = scores->seats.at(0).name;
  for (const std::string& text : {scores_text(result, ""), scores_csv(result), score_page(*lesson, result, "test")})
    for (const char* none : {"nan", "inf "}) EXPECT_EQ(text.find(none), std::string::npos) << name << ": " << none;
  const auto json = nlohmann::json::parse(scores_json(result));
  for (const auto& seat : json["lessons"][0]["seats"])
    for (const auto& part : seat["parts"])
      for (const auto& [key, metric] : part["metrics"].items())
        EXPECT_EQ(metric["value"].is_null(), metric["trust"] == "absent" || metric["trust"] == "withheld") << key;
  return *scores;
}

TEST(MotionLesson, ReadsLookAlikesOfEveryRecording) {
  const auto one = scored(table("t_s[s],px_m[m],py_m[m],pz_m[m],fx_N[N],fy_N[N],fz_N[N]", 5000, 0.001, 0), "one.csv");
  ASSERT_TRUE(one);
  ASSERT_EQ(one->seats.size(), 1u);
  EXPECT_EQ(one->seats[0].name, "hand");
  EXPECT_NEAR(one->rate_hz, 1000, 1e-6);
  EXPECT_TRUE(one->seats[0].parts[0].quality.doubts.empty());
  EXPECT_TRUE(std::isfinite(of(one->seats[0].parts[0].values, Metric::kForcePeak)));
  const auto three =
      scored(table("t_s[s],giver_fx_N[N],giver_fy_N[N],giver_fz_N[N],baton_x_m[m],baton_y_m[m],baton_z_m[m],"
                   "giver_hand_x_m[m],giver_hand_y_m[m],giver_hand_z_m[m]",
                   800, 1 / 120.0, 0),
             "three.csv");
  ASSERT_TRUE(three);
  ASSERT_EQ(three->seats.size(), 2u);
  EXPECT_EQ(three->seats[0].name, "baton");
  EXPECT_TRUE(std::isnan(of(three->seats[0].parts[0].values, Metric::kForcePeak)));
  EXPECT_TRUE(std::isfinite(of(three->seats[1].parts[0].values, Metric::kForcePeak))) << "the giver's force";
}

TEST(MotionLesson, SeparatesRecordingsByAStop) {
  const auto two = scored(table("rec[1],t_s[s],px_m[m],py_m[m],pz_m[m]", 4000, 0.001, 0), "two.csv");
  ASSERT_TRUE(two);
  ASSERT_NE(two->seats[0].part("phase:rec 1"), nullptr);
  EXPECT_NEAR(of(two->seats[0].part("phase:rec 1")->values, Metric::kTime), 2, 0.002);
  EXPECT_TRUE(two->seats[0].parts[0].quality.doubts.empty()) << "the way between two recordings is no gap";
}

TEST(MotionLesson, FlagsGapsAndUnevenSteps) {
  const std::string header = "t_s[s],px_m[m],py_m[m],pz_m[m]";
  const auto gap = scored(table(header, 5000, 0.001, 0, 60), "gap.csv");
  ASSERT_TRUE(gap);
  ASSERT_FALSE(gap->seats[0].parts[0].quality.doubts.empty());
  EXPECT_EQ(gap->seats[0].parts[0].quality.doubts.back().reason,
            "the longest gap between two samples is 61 ms (limit 50 ms)");
  const auto uneven = scored(table(header, 5000, 0.001, 0.7), "uneven.csv");
  ASSERT_TRUE(uneven);
  EXPECT_GT(uneven->seats[0].parts[0].quality.missing_share, 0.1) << "one step of seven is late by 0.7 ms";
}

TEST(MotionLesson, InterpolatesToTicks) {
  const auto lesson = read_motion(
      "t_ms[ms],x[mm],y[mm],z[mm]\n0,0,0,0\n10,10,0,0\n20.4,20.4,0,0\n30,30,0,0\n40,40,,0\n50,50,0,0\n", "steps.csv");
  ASSERT_TRUE(lesson) << lesson.error();
  ASSERT_EQ(lesson->rows(), 6u);
  EXPECT_NEAR(lesson->seats[0].x[2][0], 0.020, 1e-6);
  EXPECT_FALSE(known(lesson->seats[0].x[4])) << "an empty cell is unknown";
}

TEST(MotionLesson, NamesEveryMistake) {
  const struct {
    const char *csv, *error;
  } kMistakes[] = {
      {"", "m.csv"},
      {"a[1]\n1\n", "m.csv:1: no column of time"},
      {"t_s[s],a[1]\n0,1\n", "m.csv:1: no triple of positions in [m] or [mm]"},
      {"t_s[s],x[m],y[m],z[m]\n0,0,0,0\n1,0,0,0\n", "m.csv: 2 rows; at least 5 are needed"},
      {"t_s[s],x[m],y[m],z[m]\n0,0,0,0\n0,0,0,0\n", "m.csv:3: column 1: t_s: 0 s is not after the row before, 0 s"},
      {"t_s[s],x[m],y[m],z[m]\n0,0,0,0\n.01,0,b,0\n.02,0,0,0\n.03,0,0,0\n.04,0,0,0\n", "m.csv:3: column 3"},
      {"t_s[s],x[m],y[m],z[m]\n0,0,0,0\n9,0,0,0\n18,0,0,0\n27,0,0,0\n36,0,0,0\n", "m.csv: the median step is 9 s"},
  };
  for (const auto& mistake : kMistakes) {
    const auto lesson = read_motion(mistake.csv, "m.csv");
    ASSERT_FALSE(lesson) << mistake.csv;
    EXPECT_NE(lesson.error().find(mistake.error), std::string::npos) << lesson.error();
  }
}

TEST(MotionLesson, ScoresEverySharedRecording) {
  const char* folder = std::getenv("TANDEM_TRACES");
  if (folder == nullptr)
    GTEST_SKIP() << "TANDEM_TRACES, the folder of the shared recordings, is not set (./test --traces DIR)";
  std::size_t motions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".csv")) continue;
    std::ifstream in{entry.path()};
    std::ostringstream text;
    text << in.rdbuf();
    if (!name.starts_with("motion_")) {
      const auto lesson = read_motion(text.str(), name);
      ASSERT_FALSE(lesson) << name << " holds no motion";
      continue;
    }
    const auto scores = scored(text.str(), name);
    ASSERT_TRUE(scores) << name;
    ++motions;
    for (const SeatScore& seat : scores->seats) {
      const Quality& q = seat.parts[0].quality;
      std::printf("[  figures ] %s, %s: %.0f Hz, %.2f %% missing, longest gap %.1f ms, %s\n", name.c_str(),
                  seat.name.c_str(), scores->rate_hz, 100 * q.missing_share, 1e3 * q.longest_gap_s,
                  q.doubts.empty() ? "good" : q.doubts.front().reason.c_str());
      EXPECT_GT(of(seat.parts[0].values, Metric::kPathLength), 0);
      EXPECT_EQ(q.doubts.empty(), q.missing_share <= 0.01 && q.longest_gap_s <= 0.0500001);
    }
  }
  EXPECT_GT(motions, 0u) << folder << " holds no motion_*.csv";
}

}  // namespace
}  // namespace tandem::netsim::score
