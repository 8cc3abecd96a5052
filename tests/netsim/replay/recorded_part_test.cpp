// Recordings of several files replay as one: in order, whole, foreign, damaged.
#include "server/archive/recorded_part.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/raw_bytes.h"
#include "common/base/rng.h"
#include "netsim/replay/recording_replay.h"
#include "proto/recording/lesson_reader.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/replay/recorded_file.h"

namespace tandem::netsim {
namespace {

using test::PartsRecorder;

SimulationConfig lossy(const std::string& scene, std::uint64_t seed) {
  SimulationConfig setup;
  setup.scene = *parse_scene(find_shipped_scene(scene)->text, scene + ".textproto");
  setup.seed = seed;
  setup.network.up.floor = setup.network.down.floor = std::chrono::milliseconds(20);
  setup.network.up.loss.probability = 0.05;
  return setup;
}

/// Replays files in this order.
std::expected<RecordingReplay, std::string> replay(const std::vector<std::string>& files) {
  RecordingReplayer replayer;
  for (const std::string& file : files)
    if (const auto added = replayer.add(bytes_of(file)); !added) return std::unexpected(added.error());
  return replayer.finish();
}

std::string words(const RecordingReplay& result) {
  return result.error +
         (result.difference ? result.difference->channel + " at tick " + std::to_string(result.difference->session_tick)
                            : "");
}

std::uint64_t rows_of(const std::vector<std::string>& files) {
  std::uint64_t rows = 0;
  for (const std::string& file : files) rows += read_lesson(bytes_of(file))->rows();
  return rows;
}

/// Reads files in this order into one lesson.
std::expected<Lesson, std::string> joined(const std::vector<std::string>& files) {
  LessonReader reader;
  for (const std::string& file : files)
    if (const auto added = reader.add(bytes_of(file)); !added) return std::unexpected(added.error());
  return reader.take();
}

TEST(RecordedParts, AreOneLessonAsIfTheyWereOneFile) {
  const std::vector<std::string> parts = PartsRecorder{.part_s = 0.7}.record(lossy("contact", 3), 3),
                                 whole = PartsRecorder{.part_s = 100}.record(lossy("contact", 3), 3);
  ASSERT_GE(parts.size(), 4u);
  ASSERT_EQ(whole.size(), 1u);
  const auto lesson = joined(parts), one = joined(whole);
  ASSERT_TRUE(lesson) << lesson.error();
  ASSERT_TRUE(one) << one.error();
  EXPECT_TRUE(lesson->complete);
  EXPECT_EQ(lesson->tick, one->tick);
  EXPECT_EQ(lesson->time_ns, one->time_ns);
  for (std::size_t i = 0; i < one->seats.size(); ++i) {
    EXPECT_EQ(lesson->seats[i].fresh, one->seats[i].fresh) << i;
    EXPECT_EQ(lesson->seats[i].sample_tick, one->seats[i].sample_tick) << i;
  }
  EXPECT_EQ(lesson->tools[0].x.size(), one->rows());
  std::uint64_t recorded = 0;
  for (const std::string& part : parts) recorded += joined({part})->counts.at("/tool").recorded;
  EXPECT_EQ(recorded, one->rows());
  EXPECT_EQ(lesson->counts.at("/tool").recorded, recorded) << "the account is that of all files";

  const std::string foreign = PartsRecorder{.part_s = 100}.record(lossy("free_motion", 3), 0.2)[0];
  const auto mixed = joined({parts[0], foreign});
  ASSERT_FALSE(mixed);
  EXPECT_NE(mixed.error().find("of another session"), std::string::npos) << mixed.error();
  EXPECT_FALSE(joined({parts[1], parts[0]})->complete) << "in another order, ticks go back";
}

TEST(RecordedParts, ReplayBitForBitAsOneSessionForAllLengthsAndDelays) {
  constexpr const char* kScenes[] = {"contact", "two_by_two", "free_motion", "seed_contact"};
  const std::size_t seeds = tandem::test::draws(6, 40, 200);
  std::uint64_t parts = 0, rows = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random{seed};
    const PartsRecorder recorder{.part_s = 0.3 + 1e-3 * static_cast<double>(random.below(1500)),
                                 .behind = random.below(600)};
    const auto files = recorder.record(lossy(kScenes[seed % 4], seed), 5);
    ASSERT_GT(files.size(), 1u);
    const auto result = replay(files);
    ASSERT_TRUE(result) << result.error();
    EXPECT_TRUE(result->equal()) << words(*result);
    EXPECT_TRUE(result->complete);
    EXPECT_EQ(result->counts.ticks, 5000u);
    EXPECT_EQ(result->rows, rows_of(files));
    parts += files.size();
    rows += result->rows;
  }
  std::printf("[  figures ] %zu sessions in %llu parts, %llu rows: all equal\n", seeds,
              static_cast<unsigned long long>(parts), static_cast<unsigned long long>(rows));
}

TEST(RecordedParts, ShowADifferenceInTheRowsOfEveryPart) {
  for (const std::uint32_t tick : {5U, 500U, 501U, 510U, 1200U}) {
    SCOPED_TRACE(tick);
    const PartsRecorder recorder{.part_s = 0.5, .change = [&](server::TickRecord& record) {
                                   if (record.running && record.tick == tick) record.tools[0].x[1] += 1e-6;
                                 }};
    const auto result = replay(recorder.record(lossy("contact", 1), 2));
    ASSERT_TRUE(result) << result.error();
    ASSERT_TRUE(result->difference) << result->error;
    EXPECT_EQ(result->difference->session_tick, tick);
    EXPECT_EQ(result->difference->channel, "/tool/measured_cp");
  }
}

// The next double is far below the rounding of a server's recording, so that only the digest of the chunk shows it.
TEST(RecordedParts, ShowADifferenceBelowTheRoundingOfTools) {
  for (const std::uint32_t tick : {300U, 1003U}) {
    SCOPED_TRACE(tick);
    for (const bool rounded : {true, false}) {
      const PartsRecorder recorder{.part_s = 0.5, .round_tools = rounded, .change = [&](server::TickRecord& record) {
                                     double& x = record.tools[0].x[1];
                                     if (record.running && record.tick == tick) x = std::nextafter(x, 1);
                                   }};
      const auto result = replay(recorder.record(lossy("contact", 1), 2));
      ASSERT_TRUE(result) << result.error();
      ASSERT_TRUE(result->difference) << result->error;
      EXPECT_EQ(result->difference->channel, rounded ? "/tools/digest" : "/tool/measured_cp");
      EXPECT_GE(result->difference->session_tick, tick);
      EXPECT_LT(result->difference->session_tick, tick + (rounded ? 500 : 1)) << "the chunk's last tick";
    }
  }
}

TEST(RecordedParts, AreRefusedInAnotherOrderOrWithAForeignOne) {
  const auto files = PartsRecorder{}.record(lossy("contact", 1), 5);
  ASSERT_GE(files.size(), 4u);
  const auto skipped = replay({files[0], files[2], files[3]});
  ASSERT_TRUE(skipped) << skipped.error();
  EXPECT_NE(skipped->error.find("of the inputs are missing"), std::string::npos) << skipped->error;
  const auto swapped = replay({files[0], files[2], files[1]});
  ASSERT_FALSE(swapped);
  EXPECT_NE(swapped.error().find("but the part before ends at tick"), std::string::npos) << swapped.error();
  const auto again = replay({files[0], files[0]});
  EXPECT_FALSE(again);
  const auto foreign = PartsRecorder{}.record(lossy("contact", 2), 5);
  const auto mixed = replay({files[0], foreign[1], files[2]});
  ASSERT_TRUE(mixed) << mixed.error();
  EXPECT_FALSE(mixed->equal()) << "the inputs of another session";
  const auto other = PartsRecorder{}.record(lossy("free_motion", 1), 5);
  const auto scenes = replay({files[0], other[1]});
  ASSERT_FALSE(scenes);
  EXPECT_NE(scenes.error().find("another scene"), std::string::npos) << scenes.error();
  const auto late = replay({files[1], files[2]});
  ASSERT_TRUE(late) << late.error();
  EXPECT_FALSE(late->equal()) << "the session's begin is missing";
}

TEST(RecordedParts, OfACutLastFileReplayAsFarAsTheyAreWhole) {
  auto files = PartsRecorder{}.record(lossy("contact", 1), 5);
  const std::uint64_t all = replay(files)->counts.ticks;
  files.back().resize(files.back().size() / 2);
  const auto cut = replay(files);
  ASSERT_TRUE(cut) << cut.error();
  EXPECT_TRUE(cut->equal()) << words(*cut);
  EXPECT_FALSE(cut->complete);
  EXPECT_LT(cut->counts.ticks, all);
}

// Any flipped bit of any part: an error, a difference, a file without an undamaged end, or nothing that matters.
TEST(RecordedParts, WithDamageAreNeverFoundWholeByMistake) {
  const auto files = PartsRecorder{}.record(lossy("contact", 3), 4);
  const std::uint64_t rows = rows_of(files);
  const std::size_t seeds = tandem::test::draws(40, 300, 2000);
  std::size_t refused = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random{seed};
    auto damaged = files;
    std::string& file = damaged[random.below(damaged.size())];
    for (std::size_t k = 0; k < 3; ++k) file[random.below(file.size())] ^= static_cast<char>(1U << random.below(8));
    static_cast<void>(server::read_part(bytes_of(file), "a.mcap"));
    const auto result = replay(damaged);
    if (result && result->equal() && result->complete)
      EXPECT_EQ(result->rows, rows);
    else
      ++refused;
  }
  EXPECT_GT(refused, seeds / 2) << "most bytes are in chunks";
}

using server::read_part;

TEST(RecordedPart, IsReadFromAFileAndRefusesInvalidNumbers) {
  const auto files = PartsRecorder{}.record(lossy("contact", 1), 4);
  ASSERT_GE(files.size(), 3u);
  const auto second = read_part(bytes_of(files[1]), "b.mcap");
  ASSERT_TRUE(second) << second.error();
  EXPECT_EQ(second->number, 2u);
  EXPECT_EQ(second->last, std::optional(false));
  EXPECT_EQ(second->previous_file, "lesson-1.mcap");
  EXPECT_EQ(read_part(bytes_of(files.back()), "c.mcap")->last, std::optional(true));
  EXPECT_EQ(read_part(bytes_of(std::string_view(files[1]).substr(0, files[1].size() / 2)), "cut")->last, std::nullopt);
  for (const std::string number : {"0", "-1", "10000", "99999999999", "2x", "", "nan"}) {
    SCOPED_TRACE(number);
    server::RecordingWriter writer{*parse_scene(find_shipped_scene("contact")->text, "contact"),
                                   {.session = "a",
                                    .scene_text = "",
                                    .metadata = {{rec::kRecordingKey, "lab"}, {rec::kPartKey, number}},
                                    .persons = {}}};
    writer.finish();
    const auto refused = read_part(bytes_of(writer.take()), "d.mcap");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().find("as number of its part (1 to 9999)"), std::string::npos) << refused.error();
  }
  EXPECT_FALSE(read_part(bytes_of("no recording"), "e.mcap"));
}

}  // namespace
}  // namespace tandem::netsim
