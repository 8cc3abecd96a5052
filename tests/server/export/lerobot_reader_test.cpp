// Data sets of LeRobot, read by a second implementation of Parquet (Rust, through npm) and compared with the lesson.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "server/export/app/lerobot_export.h"
#include "tests/io/programs.h"
#include "tests/support/lesson_run.h"

namespace tandem::server {
namespace {

using test::Json;
using test::Process;

/// Installs the packages of the second reader once. @return why that failed; empty: they are there
const std::string& reader_problem() {
  static const std::string problem = [] {
    setenv("TANDEM_PARQUET_BUILD", TANDEM_PARQUET_BUILD, 1);
    Process check({TANDEM_PARQUET_CHECK, "--packages"});
    std::optional<int> code;
    for (int k = 0; k < 6 && !code; ++k) code = check.wait();
    return code != 0 || check.out().find("skipped") != std::string::npos ? check.out() + check.err() : std::string{};
  }();
  return problem;
}

Json read(const std::string& file) {
  Process node({"/usr/bin/env", "node", TANDEM_READ_PARQUET, file, TANDEM_PARQUET_BUILD});
  EXPECT_EQ(node.wait(), 0) << node.err();
  return Json::parse(node.out());
}

/// A lesson of 0.4 s with a gap of 30 ticks.
Lesson lesson_with_gap(std::uint64_t seed) {
  Lesson lesson = test::lesson_of("free_motion", 0.4, seed).lesson;
  for (std::size_t k = 110; k < lesson.rows(); ++k) lesson.tick[k] += 30;
  return lesson;
}

std::string write_set(LerobotVersion version, const std::vector<Lesson>& lessons, const std::string& folder) {
  LerobotRequest request;
  request.version = version;
  request.task = "follow the circle";
  request.episodes = lessons.size();
  request.lesson = [&lessons](std::size_t episode) -> std::expected<std::unique_ptr<LessonSource>, std::string> {
    return std::make_unique<WholeLesson>(lessons[episode]);
  };
  return export_lerobot(request, folder, [](double) { return true; });
}

/// Compares the rows of one episode with its lesson. @param first  number of its first frame in the data set
void expect_episode(const Json& rows, const Lesson& lesson, std::int64_t episode, std::int64_t first) {
  const auto layout = LerobotLayout::make(lesson.scene, 50).value();
  const auto frames = static_cast<std::int64_t>(layout.frames(extent_of(lesson)));
  std::size_t unknown = 0;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    for (std::size_t k = 0; k < layout.features().size(); ++k) {
      const LerobotFeature& feature = layout.features()[k];
      std::vector<double> expected(feature.size());
      layout.fill(lesson, {episode, frame, first + frame, lesson.tick.front()}, k, expected);
      Json value = rows.at(static_cast<std::size_t>(frame)).at(feature.name);
      if (feature.shape.size() == 2) {
        ASSERT_EQ(value.size(), feature.shape[0]) << feature.name;
        Json flat = Json::array();
        for (const Json& row : value)
          for (const Json& number : row) flat.push_back(number);
        value = std::move(flat);
      }
      if (!value.is_array()) value = Json::array({value});
      ASSERT_EQ(value.size(), expected.size()) << feature.name;
      for (std::size_t n = 0; n < expected.size(); ++n) {
        if (std::isnan(expected[n])) {
          EXPECT_EQ(value[n], "NaN") << feature.name;
          ++unknown;
        } else if (feature.type == LerobotType::kBool) {
          EXPECT_EQ(value[n], expected[n] != 0) << feature.name;
        } else {
          EXPECT_EQ(value[n].get<double>(), feature.type == LerobotType::kFloat32
                                                ? static_cast<double>(static_cast<float>(expected[n]))
                                                : expected[n])
              << feature.name << " of frame " << frame;
        }
      }
    }
  }
  EXPECT_GT(unknown, 0u) << "the gap is in the windows";
}

TEST(LerobotReader, ReadsVersion21AsItWasRecorded) {
  if (!reader_problem().empty()) GTEST_SKIP() << "no second reader of Parquet: " << reader_problem();
  const std::vector<Lesson> lessons{lesson_with_gap(1), lesson_with_gap(2)};
  const test::Folder folder;
  ASSERT_EQ(write_set(LerobotVersion::k21, lessons, folder.file("set")), "");
  std::int64_t first = 0;
  for (std::size_t e = 0; e < lessons.size(); ++e) {
    const Json file = read(folder.file("set/data/chunk-000/episode_00000" + std::to_string(e) + ".parquet"));
    EXPECT_EQ(file["schema"]["observation.state"], "List<Float32>");
    EXPECT_EQ(file["schema"]["observation.window"], "List<List<Float32>>");
    EXPECT_EQ(file["schema"]["observation.gap"], "Bool");
    EXPECT_EQ(file["schema"]["timestamp"], "Float32");
    EXPECT_EQ(file["schema"]["index"], "Int64");
    EXPECT_EQ(file["schema"].size(), folder.json("set/meta/info.json")["features"].size());
    expect_episode(file["rows"], lessons[e], static_cast<std::int64_t>(e), first);
    first += static_cast<std::int64_t>(file["rows"].size());
  }
}

TEST(LerobotReader, ReadsVersion30AsItWasRecorded) {
  if (!reader_problem().empty()) GTEST_SKIP() << "no second reader of Parquet: " << reader_problem();
  const std::vector<Lesson> lessons{lesson_with_gap(1), lesson_with_gap(2)};
  const test::Folder folder;
  ASSERT_EQ(write_set(LerobotVersion::k30, lessons, folder.file("set")), "");
  const Json data = read(folder.file("set/data/chunk-000/file-000.parquet"));
  const Json episodes = read(folder.file("set/meta/episodes/chunk-000/file-000.parquet"));
  ASSERT_EQ(episodes["rows"].size(), 2u);
  std::int64_t first = 0;
  for (std::size_t e = 0; e < lessons.size(); ++e) {
    const Json& episode = episodes["rows"][e];
    const auto length = episode["length"].get<std::int64_t>();
    EXPECT_EQ(episode["episode_index"], e);
    EXPECT_EQ(episode["tasks"], Json::array({"follow the circle"}));
    EXPECT_EQ(episode["dataset_from_index"], first);
    EXPECT_EQ(episode["dataset_to_index"], first + length);
    EXPECT_EQ(episode["data/chunk_index"], 0);
    EXPECT_EQ(episode["data/file_index"], 0);
    EXPECT_EQ(episode["stats/frame_index/max"], Json::array({length - 1}));
    EXPECT_EQ(episode["stats/frame_index/count"], Json::array({length}));
    EXPECT_EQ(episode["stats/observation.window/mean"].size(), 20u);
    Json rows = Json::array();
    for (std::int64_t k = 0; k < length; ++k) rows.push_back(data["rows"][static_cast<std::size_t>(first + k)]);
    expect_episode(rows, lessons[e], static_cast<std::int64_t>(e), first);
    first += length;
  }
  EXPECT_EQ(data["rows"].size(), static_cast<std::size_t>(first));
  const Json tasks = read(folder.file("set/meta/tasks.parquet"));
  EXPECT_EQ(tasks["rows"][0], (Json{{"task_index", 0}, {"__index_level_0__", "follow the circle"}}));
  const Json pandas = Json::parse(tasks["metadata"]["pandas"].get<std::string>());
  EXPECT_EQ(pandas["index_columns"], Json::array({"__index_level_0__"}));
  EXPECT_EQ(folder.json("set/meta/stats.json")["index"]["max"], Json::array({first - 1}));
}

}  // namespace
}  // namespace tandem::server
