// Data sets of LeRobot: frames, windows, gaps, interventions, statistics and metadata, before they become files.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "server/export/lerobot_card.h"
#include "server/export/lerobot_layout.h"
#include "server/export/lerobot_meta.h"
#include "tests/support/lesson_run.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

using Json = nlohmann::json;

/// Rows at the given ticks; the tip of the first hand is at x = tick, its force z = -tick.
Lesson lesson_at(const std::vector<std::uint32_t>& ticks) {
  Lesson lesson = test::empty_lesson(test::shipped("free_motion"));
  for (const std::uint32_t tick : ticks) {
    TickRecord record;
    record.tick = tick;
    record.running = true;
    record.seats[0].x = {static_cast<double>(tick), 0, 0};
    record.seats[0].f_out = {0, 0, -static_cast<double>(tick)};
    record.seats[0].alpha = 0.25;
    record.seats[1].alpha = 0.75;
    record.tools[0].x_tool = {0, static_cast<double>(tick), 0};
    test::append_record(lesson, record);
  }
  return lesson;
}

std::vector<std::uint32_t> ticks(std::uint32_t from, std::uint32_t to) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t tick = from; tick < to; ++tick) out.push_back(tick);
  return out;
}

std::size_t number_of(const LerobotLayout& layout, const std::string& name) {
  for (std::size_t k = 0; k < layout.features().size(); ++k)
    if (layout.features()[k].name == name) return k;
  throw std::runtime_error("no feature " + name);
}

std::vector<double> values(const LerobotLayout& layout, const Lesson& lesson, std::int64_t frame,
                           const std::string& name) {
  const std::size_t k = number_of(layout, name);
  std::vector<double> out(layout.features()[k].size());
  layout.fill(lesson, {3, frame, 100 + frame, lesson.tick.front()}, k, out);
  return out;
}

/// Place of a named number in a feature.
std::size_t column(const LerobotLayout& layout, const std::string& feature, const std::string& name) {
  const auto& columns = layout.features()[number_of(layout, feature)].columns;
  const auto at = std::ranges::find(columns, name);
  EXPECT_NE(at, columns.end()) << name;
  return static_cast<std::size_t>(at - columns.begin());
}

TEST(LerobotLayout, TakesTheNewestRowOfEachWindow) {
  const Lesson lesson = lesson_at(ticks(40, 40 + 65));
  const auto layout = LerobotLayout::make(lesson.scene, 50).value();
  EXPECT_EQ(layout.window(), 20u);
  EXPECT_EQ(layout.frames(extent_of(lesson)), 3u) << "the last five ticks are no whole frame";
  const std::string seat = lesson.scene.seats[0].name, tool = lesson.scene.tools[0].name;
  const std::size_t x = column(layout, "observation.state", seat + ".measured_cp.x[m]");
  EXPECT_EQ(values(layout, lesson, 0, "observation.state")[x], 59);
  EXPECT_EQ(values(layout, lesson, 2, "observation.state")[x], 99);
  EXPECT_EQ(
      values(layout, lesson, 1, "observation.force")[column(layout, "observation.force", seat + ".measured_cf.z[N]")],
      -79);
  EXPECT_EQ(values(layout, lesson, 1, "action")[column(layout, "action", tool + ".setpoint_cp.y[m]")], 79);
  EXPECT_EQ(values(layout, lesson, 1, "observation.alpha"), (std::vector{0.25, 0.75}));
  EXPECT_EQ(values(layout, lesson, 2, "timestamp"), (std::vector{0.04}));
  EXPECT_EQ(values(layout, lesson, 2, "frame_index"), (std::vector{2.0}));
  EXPECT_EQ(values(layout, lesson, 2, "episode_index"), (std::vector{3.0}));
  EXPECT_EQ(values(layout, lesson, 2, "index"), (std::vector{102.0}));
}

TEST(LerobotLayout, HasEveryTickInItsWindow) {
  const Lesson lesson = lesson_at(ticks(40, 80));
  const auto layout = LerobotLayout::make(lesson.scene, 50).value();
  const std::size_t x = column(layout, "observation.window", lesson.scene.seats[0].name + ".measured_cp.x[m]"),
                    f = column(layout, "observation.window", lesson.scene.seats[0].name + ".measured_cf.z[N]");
  const std::vector<double> window = values(layout, lesson, 1, "observation.window");
  const std::size_t width = window.size() / layout.window();
  for (std::size_t k = 0; k < layout.window(); ++k) {
    EXPECT_EQ(window[k * width + x], 60.0 + static_cast<double>(k));
    EXPECT_EQ(window[k * width + f], -60.0 - static_cast<double>(k));
  }
}

TEST(LerobotLayout, FlagsGapsAndRepeatsNoTickInWindows) {
  std::vector<std::uint32_t> recorded = ticks(0, 25);
  for (const std::uint32_t tick : ticks(60, 80)) recorded.push_back(tick);
  const Lesson lesson = lesson_at(recorded);
  const auto layout = LerobotLayout::make(lesson.scene, 50).value();
  ASSERT_EQ(layout.frames(extent_of(lesson)), 4u);
  const std::size_t x = column(layout, "observation.state", lesson.scene.seats[0].name + ".measured_cp.x[m]");
  const double missing[] = {0, 15, 20, 0}, last[] = {19, 24, 24, 79};
  for (std::int64_t frame = 0; frame < 4; ++frame) {
    SCOPED_TRACE(frame);
    EXPECT_EQ(values(layout, lesson, frame, "observation.missing_ticks")[0], missing[frame]);
    EXPECT_EQ(values(layout, lesson, frame, "observation.gap")[0], missing[frame] > 0 ? 1 : 0);
    EXPECT_EQ(values(layout, lesson, frame, "observation.state")[x], last[frame]) << "the values before the gap";
    const std::vector<double> window = values(layout, lesson, frame, "action.window");
    const std::size_t width = window.size() / layout.window();
    std::size_t unknown = 0;
    for (std::size_t k = 0; k < layout.window(); ++k) unknown += std::isnan(window[k * width + 1]) ? 1 : 0;
    EXPECT_EQ(static_cast<double>(unknown), missing[frame]);
  }
}

TEST(LerobotLayout, FlagsTheMajorityOfInstructorsAsIntervention) {
  Lesson lesson = lesson_at(ticks(0, 40));
  std::size_t instructor = 0;
  while (lesson.scene.seats[instructor].role != Role::kInstructor) ++instructor;
  for (auto& alpha : lesson.tools[0].alpha) alpha = {};
  for (auto& alpha : lesson.tools[0].alpha) alpha[instructor] = 0.5;
  const auto layout = LerobotLayout::make(lesson.scene, 50).value();
  EXPECT_EQ(values(layout, lesson, 0, "observation.intervention")[0], 0) << "half is no majority";
  lesson.tools[0].alpha[33][instructor] = 0.6;
  EXPECT_EQ(values(layout, lesson, 0, "observation.intervention")[0], 0);
  EXPECT_EQ(values(layout, lesson, 1, "observation.intervention")[0], 1) << "one tick is enough";
  lesson.tools[0].alpha[33][instructor] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(values(layout, lesson, 1, "observation.intervention")[0], 0) << "unknown is no intervention";
}

TEST(LerobotLayout, NeedsARateThatDividesThatOfTheScene) {
  const SceneSpec scene = test::shipped("free_motion");
  for (const unsigned fps : {1u, 50u, 500u, 1000u}) EXPECT_TRUE(LerobotLayout::make(scene, fps)) << fps;
  for (const unsigned fps : {0u, 30u, 2000u}) {
    const auto layout = LerobotLayout::make(scene, fps);
    ASSERT_FALSE(layout) << fps;
    EXPECT_NE(layout.error().find("1000 ticks per second"), std::string::npos) << layout.error();
  }
}

TEST(LerobotStats, AreThoseOfTheFiniteNumbers) {
  LerobotStats stats(3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& frame : {std::vector{1.0, nan, 5.0}, {3.0, nan, nan}, {8.0, nan, 7.0}})
    stats.add(frame);
  EXPECT_EQ(stats.frames(), 3u);
  EXPECT_EQ(stats.min(), (std::vector{1.0, 0.0, 5.0}));
  EXPECT_EQ(stats.max(), (std::vector{8.0, 0.0, 7.0}));
  EXPECT_DOUBLE_EQ(stats.mean()[0], 4);
  EXPECT_DOUBLE_EQ(stats.deviation()[0], std::sqrt(26.0 / 3));  // (9 + 1 + 16) / 3
  EXPECT_DOUBLE_EQ(stats.mean()[2], 6);
  EXPECT_DOUBLE_EQ(stats.deviation()[2], 1);
}

LerobotDataset set_of(LerobotVersion version, const LerobotLayout& layout) {
  LerobotDataset set{version, "tie a \"knot\"", {}};
  std::vector<LerobotStats> stats;
  for (const LerobotFeature& feature : layout.features()) stats.emplace_back(feature.size());
  set.episodes.push_back({30, 0, 0, stats});
  set.episodes.push_back({12, 30, 0, stats});
  return set;
}

TEST(LerobotMeta, HasTheKeysOfItsVersion) {
  const auto layout = LerobotLayout::make(test::shipped("free_motion"), 50).value();
  for (const LerobotVersion version : {LerobotVersion::k21, LerobotVersion::k30}) {
    const bool old = version == LerobotVersion::k21;
    const Json info = Json::parse(lerobot_info_json(set_of(version, layout), layout));
    EXPECT_EQ(info["codebase_version"], old ? "v2.1" : "v3.0");
    EXPECT_EQ(info["total_episodes"], 2);
    EXPECT_EQ(info["total_frames"], 42);
    EXPECT_EQ(info["fps"], 50);
    EXPECT_EQ(info["splits"]["train"], "0:2");
    EXPECT_EQ(info.contains("total_chunks"), old);
    EXPECT_EQ(info.contains("data_files_size_in_mb"), !old);
    EXPECT_EQ(info["features"]["observation.gap"]["dtype"], "bool");
    EXPECT_EQ(info["features"]["observation.gap"]["shape"], Json::array({1}));
    EXPECT_EQ(info["features"]["observation.window"]["shape"][0], 20);
    EXPECT_EQ(info["features"]["action"].contains("fps"), !old);
    for (const auto& [name, feature] : info["features"].items()) {
      EXPECT_EQ(name.find('/'), std::string::npos) << "LeRobot allows no slash";
      if (feature["shape"].size() == 1 && feature["names"].is_array()) {
        EXPECT_EQ(feature["names"].size(), feature["shape"][0]) << name;
      }
    }
  }
  const LerobotDataset set = set_of(LerobotVersion::k21, layout);
  EXPECT_EQ(Json::parse(lerobot_tasks_lines(set)), (Json{{"task_index", 0}, {"task", "tie a \"knot\""}}));
  const std::string lines = lerobot_episodes_lines(set);
  EXPECT_EQ(Json::parse(lines.substr(lines.find('\n') + 1)),
            (Json{{"episode_index", 1}, {"tasks", {"tie a \"knot\""}}, {"length", 12}}));
  const std::string stats = lerobot_episodes_stats_lines(set, layout);
  const Json window = Json::parse(stats.substr(0, stats.find('\n')))["stats"]["observation.window"];
  EXPECT_EQ(window["mean"].size(), 20u);
  EXPECT_EQ(window["count"], Json::array({0}));
  EXPECT_NE(lerobot_card(set, layout).find("| `observation.gap` | bool | 1 |"), std::string::npos);
}

TEST(LerobotMeta, NamesDataFilesAsItsVersionDoes) {
  EXPECT_EQ(lerobot_data_path(LerobotVersion::k21, 1234, 0), "data/chunk-001/episode_001234.parquet");
  EXPECT_EQ(lerobot_data_path(LerobotVersion::k30, 1234, 7), "data/chunk-000/file-007.parquet");
  EXPECT_EQ(lerobot_data_path(LerobotVersion::k30, 1234, 2001), "data/chunk-002/file-001.parquet");
}

}  // namespace
}  // namespace tandem::server
