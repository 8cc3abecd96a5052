// Cut, damaged and foreign files.
#include <gtest/gtest.h>

#include "common/mcap/mcap_reader.h"
#include "common/mcap/mcap_repair.h"
#include "common/mcap/mcap_writer.h"
#include "tests/common/base/counts.h"
#include "tests/server/recording/recording_sample.h"

namespace tandem::server {
namespace {

using namespace server::test;

std::string sample_recording(const SceneSpec& scene, std::uint32_t ticks) {
  std::vector<TickRecord> records;
  for (std::uint32_t tick = 0; tick < ticks; ++tick) records.push_back(smooth_record(scene, tick));
  return recording_of(scene, records);
}

TEST(RecordingCut, AnyCutOfTheLastChunkGivesAllChunksBeforeAndTheirCounts) {
  const SceneSpec scene = shipped_scene("contact");
  std::vector<TickRecord> records;  // ten per chunk
  for (std::uint32_t tick = 0; tick < 2000; tick += 50) records.push_back(smooth_record(scene, tick));
  const std::string file = recording_of(scene, records);
  const auto parts = mcap::Reader::open(bytes_of(file))->parts();
  ASSERT_EQ(parts.size(), 4u);
  const std::size_t chunk_end = mcap::record_at(bytes_of(file), parts.back())->end();
  for (std::size_t size = parts.back(); size < file.size(); size += size < chunk_end ? 1 : 101) {
    SCOPED_TRACE(size);
    const auto lesson = read_lesson(bytes_of(std::string_view{file}.substr(0, size)));
    ASSERT_TRUE(lesson) << lesson.error();
    const std::size_t rows = size < chunk_end ? 30 : 40;
    ASSERT_EQ(lesson->rows(), rows);
    ASSERT_FALSE(lesson->complete);
    ASSERT_EQ(lesson->counts.at("/tool").recorded, rows);
  }
}

TEST(RecordingCut, RepairKeepsRowsAndCountsAndSaysThatTheEndIsMissing) {
  const SceneSpec scene = shipped_scene("contact");
  const std::string file = sample_recording(scene, 2000);
  const auto parts = mcap::Reader::open(bytes_of(file))->parts();
  const auto repaired = mcap::repair(bytes_of(std::string_view{file}.substr(0, parts.back() + 50)));
  ASSERT_TRUE(repaired);
  ASSERT_TRUE(mcap::Reader::open(bytes_of(repaired->file))->complete());
  const auto lesson = read_lesson(bytes_of(repaired->file));
  ASSERT_TRUE(lesson) << lesson.error();
  EXPECT_EQ(lesson->rows(), 1500u);
  EXPECT_FALSE(lesson->complete);
  EXPECT_EQ(lesson->counts.at("/tool").recorded, 1500u);
}

TEST(RecordingCut, ADamagedChunkIsAGap) {
  const SceneSpec scene = shipped_scene("contact");
  std::string file = sample_recording(scene, 2000);
  file[mcap::Reader::open(bytes_of(file))->parts()[1] + 100] ^= 4;
  const auto lesson = read_lesson(bytes_of(file));
  ASSERT_TRUE(lesson);
  EXPECT_FALSE(lesson->complete);
  EXPECT_EQ(lesson->rows(), 1500u);
  EXPECT_EQ(lesson->tick[500], 1000u);
}

TEST(RecordingCut, FlippedBitsAreSafe) {
  const SceneSpec scene = shipped_scene("one_axis");
  const std::string file = sample_recording(scene, 300);
  const std::uint64_t count = tandem::test::seeds(300);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    RandomStream random{RandomKey{seed}};
    std::string bytes = file;
    for (std::uint64_t n = 1 + random.below(3); n > 0; --n) {
      const std::uint64_t bit = random.below(bytes.size() * 8);
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    }
    const auto lesson = read_lesson(bytes_of(bytes));
    if (!lesson) continue;
    ASSERT_LE(lesson->rows(), 300u) << "seed " << seed;
  }
}

TEST(RecordingCut, ForeignFilesAreNamed) {
  EXPECT_FALSE(read_lesson(bytes_of("")));
  EXPECT_FALSE(read_lesson(bytes_of("tick[1],t_s[s]\n")));
  mcap::Writer other{"ros2", "rosbag2"};
  other.finish();
  const auto lesson = read_lesson(bytes_of(other.take()));
  ASSERT_FALSE(lesson);
  EXPECT_NE(lesson.error().find("ros2"), std::string::npos);
}

TEST(RecordingCut, AnotherFormatAndABadSceneAreNamed) {
  for (const auto& [format, text, word] :
       {std::tuple{"1", "", "has format \"1\" of recordings; this program reads format 3"},
        std::tuple{"2", "", "has format \"2\" of recordings; this program reads format 3"},
        std::tuple{"4", "", "format"}, std::tuple{"3", "seat { nam: \"x\" }", "scene"}}) {
    mcap::Writer file{"x-tandem", "test"};
    file.add_metadata({"session", {{"format", format}, {"start_unix_ns", "0"}}});
    file.add_metadata({"scene", {{"name", "s"}, {"text", text}}});
    file.finish();
    const auto lesson = read_lesson(bytes_of(file.take()));
    ASSERT_FALSE(lesson);
    EXPECT_NE(lesson.error().find(word), std::string::npos) << lesson.error();
  }
}

}  // namespace
}  // namespace tandem::server
