// Data sets of LeRobot as files. The second reader of the Parquet files is in lerobot_reader_test.cpp.
#include "server/export/app/lerobot_export.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "tests/io/programs.h"
#include "tests/support/lesson_run.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;
using test::Json;

constexpr auto kGoOn = [](double) { return true; };

bool node_is_there() {
  test::Process probe({"/bin/sh", "-c", "command -v node"});
  return probe.wait() == 0;
}

LerobotRequest request_of(LerobotVersion version, const std::vector<Lesson>& lessons) {
  LerobotRequest request;
  request.version = version;
  request.episodes = lessons.size();
  request.lesson = [&lessons](std::size_t episode) -> std::expected<std::unique_ptr<LessonSource>, std::string> {
    return std::make_unique<WholeLesson>(lessons[episode]);
  };
  return request;
}

std::set<std::string> files_below(const std::string& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(folder).string());
  return files;
}

TEST(LerobotExport, HasTheFilesOfItsVersion) {
  if (!node_is_there()) GTEST_SKIP() << "Node.js is not installed (apt install nodejs)";
  const std::vector<Lesson> lessons{test::lesson_of("free_motion", 1, 1).lesson,
                                    test::lesson_of("free_motion", 1.5, 2).lesson};
  const test::Folder folder;
  ASSERT_EQ(export_lerobot(request_of(LerobotVersion::k21, lessons), folder.file("old"), kGoOn), "");
  ASSERT_EQ(export_lerobot(request_of(LerobotVersion::k30, lessons), folder.file("new"), kGoOn), "");
  EXPECT_EQ(files_below(folder.file("old")),
            (std::set<std::string>{"README.md", "meta/info.json", "meta/tasks.jsonl", "meta/episodes.jsonl",
                                   "meta/episodes_stats.jsonl", "data/chunk-000/episode_000000.parquet",
                                   "data/chunk-000/episode_000001.parquet"}));
  EXPECT_EQ(files_below(folder.file("new")),
            (std::set<std::string>{"README.md", "meta/info.json", "meta/stats.json", "meta/tasks.parquet",
                                   "meta/episodes/chunk-000/file-000.parquet", "data/chunk-000/file-000.parquet"}));
  for (const char* set : {"old", "new"}) {
    const Json info = folder.json(std::string(set) + "/meta/info.json");
    EXPECT_EQ(info["total_episodes"], 2);
    EXPECT_EQ(info["total_frames"], 50 + 75) << "1 s and 1.5 s at 50 frames per second";
    for (const std::string& file : files_below(folder.file(set)))
      if (file.ends_with(".parquet")) {
        const std::string bytes = folder.read(std::string(set) + "/" + file);
        EXPECT_TRUE(bytes.starts_with("PAR1") && bytes.ends_with("PAR1")) << file;
      }
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.file("")), {}), 2) << "no temporary folder is left";
}

TEST(LerobotExport, RefusesEpisodesThatDifferAndLessonsOfLessThanAFrame) {
  if (!node_is_there()) GTEST_SKIP() << "Node.js is not installed (apt install nodejs)";
  const std::vector<Lesson> different{test::lesson_of("free_motion", 0.2).lesson,
                                      test::lesson_of("one_axis", 0.2).lesson};
  const test::Folder folder;
  std::string problem = export_lerobot(request_of(LerobotVersion::k30, different), folder.file("set"), kGoOn);
  EXPECT_NE(problem.find("episode 1, session lesson of one_axis: it has other seats"), std::string::npos) << problem;
  const std::vector<Lesson> brief{test::lesson_of("one_axis", 0.2).lesson};
  LerobotRequest request = request_of(LerobotVersion::k30, brief);
  request.fps = 2;
  problem = export_lerobot(request, folder.file("set"), kGoOn);
  EXPECT_NE(problem.find("shorter than one frame"), std::string::npos) << problem;
  request.fps = 30;
  problem = export_lerobot(request, folder.file("set"), kGoOn);
  EXPECT_NE(problem.find("30 frames per second do not divide"), std::string::npos) << problem;
  EXPECT_TRUE(fs::is_empty(folder.file("")));
}

TEST(LerobotExport, LeavesNothingWhenInterruptedOrWithoutNode) {
  const std::vector<Lesson> lessons{test::lesson_of("one_axis", 1).lesson};
  const test::Folder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const std::string problem = export_lerobot(request_of(LerobotVersion::k30, lessons), folder.file("set"), kGoOn);
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(problem.find("apt install nodejs"), std::string::npos) << problem;
  EXPECT_TRUE(fs::is_empty(folder.file("")));
  if (!node_is_there()) GTEST_SKIP() << "Node.js is not installed (apt install nodejs)";
  EXPECT_EQ(export_lerobot(request_of(LerobotVersion::k30, lessons), folder.file("set"), [](double) { return false; }),
            kExportInterrupted);
  EXPECT_TRUE(fs::is_empty(folder.file("")));
}

TEST(LerobotExport, ReportsWhyNodeCouldNotWrite) {
  if (!node_is_there()) GTEST_SKIP() << "Node.js is not installed (apt install nodejs)";
  const std::vector<Lesson> lessons{test::lesson_of("one_axis", 1).lesson};
  const test::Folder folder;
  // A link to /dev/full takes the place of the data file; the folders below exist already.
  const std::string temporary = folder.file("set.part-" + std::to_string(getpid()));
  fs::create_directories(temporary + "/data/chunk-000");
  fs::create_symlink("/dev/full", temporary + "/data/chunk-000/file-000.parquet");
  const std::string problem = export_lerobot(request_of(LerobotVersion::k30, lessons), folder.file("set"), kGoOn);
  EXPECT_NE(problem.find("the disk is full"), std::string::npos) << problem;
  EXPECT_TRUE(fs::is_empty(folder.file("")));
}

}  // namespace
}  // namespace tandem::server
