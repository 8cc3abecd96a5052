// Files of recordings: limits, parts, full and failing disks. Counts stay true in all of them.
#include "server/recording/io/recording_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <chrono>
#include <cstring>
#include <functional>
#include <thread>

#include "common/base/rng.h"
#include "common/io/clock.h"
#include "common/mcap/mcap_reader.h"
#include "proto/recording/recording_format.h"
#include "server/recording/io/recording_repair.h"
#include "tests/common/base/counts.h"
#include "tests/io/programs.h"
#include "tests/io/recorded_ticks.h"
#include "tests/support/file_faults.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using tandem::test::FileFault;
using tandem::test::Folder;
using test::account_problem;
using test::head_bytes;
using test::info_of;
using test::lesson_of;
using test::read;
using test::record_at;
using test::Recording;
using test::scene_named;

TEST(RecordingFiles, HoldEveryTick) {
  const Folder folder;
  Recording recording(folder);
  recording.run(8);
  EXPECT_EQ(recording.close(), std::vector<std::string>{folder.file("a.mcap")});
  const Lesson lesson = read(folder, "a.mcap");
  EXPECT_TRUE(lesson.complete);
  EXPECT_EQ(lesson.rows(), 2000u);
  EXPECT_EQ(account_problem(lesson), "");
  EXPECT_EQ(recording.files().recorded(), 2000u);
  EXPECT_EQ(recording.files().lost(), 0u);
  EXPECT_EQ(lesson.seats[0].x[1999], record_at(lesson.scene, 2000).seats[0].x) << "bit for bit";
}

TEST(RecordingFiles, GoOnInAnotherFileAtTheirLimits) {
  const Folder folder;
  folder.write("a-2.mcap", "of another recording");
  Recording recording(folder, {.file_s = 1});
  recording.run(10);
  const auto completed = recording.close();
  EXPECT_EQ(completed,
            (std::vector<std::string>{folder.file("a.mcap"), folder.file("a-3.mcap"), folder.file("a-4.mcap")}));
  std::uint32_t next = 1;
  for (const char* name : {"a.mcap", "a-3.mcap", "a-4.mcap"}) {
    const Lesson lesson = read(folder, name);
    ASSERT_GT(lesson.rows(), 0u);
    EXPECT_EQ(lesson.tick.front(), next) << "no tick is missing between two files";
    EXPECT_EQ(account_problem(lesson), "");
    next = lesson.tick.back() + 1;
  }
  EXPECT_EQ(next, 2501u);
  EXPECT_EQ(folder.read("a-2.mcap"), "of another recording");
}

// The replay of several files refuses one that begins before the end of the file before.
TEST(RecordingFiles, HaveNoTickOfAFileBefore) {
  const Folder folder;
  Recording recording(folder, {.file_s = 1});
  recording.run(4);
  // The first file is full, so that the next tick that is recorded begins another one.
  for (std::uint32_t tick = 901; tick <= 1000; ++tick) recording.files().add(record_at(scene_named("contact"), tick));
  EXPECT_EQ(recording.files().recorded(), 1000u);
  recording.run(4);
  EXPECT_EQ(recording.close().size(), 2u);
  EXPECT_EQ(read(folder, "a.mcap").tick.back(), 1000u);
  EXPECT_EQ(read(folder, "a-2.mcap").tick.front(), 1001u);
}

/// Value of a key of the metadata record `session`.
std::string fact(const Lesson& lesson, const char* key) {
  const auto found = lesson.metadata.find(key);
  return found == lesson.metadata.end() ? "" : found->second;
}

TEST(RecordingFiles, SayWhichPartOfWhichRecordingTheyAre) {
  const Folder folder;
  Recording recording(folder, {.file_s = 1});
  recording.run(10);
  ASSERT_EQ(recording.close().size(), 3u);
  const std::string names[] = {"a.mcap", "a-2.mcap", "a-3.mcap"};
  for (std::size_t k = 0; k < 3; ++k) {
    const Lesson lesson = read(folder, names[k]);
    EXPECT_EQ(fact(lesson, rec::kRecordingKey), "a");
    EXPECT_EQ(fact(lesson, rec::kPartKey), std::to_string(k + 1));
    EXPECT_EQ(fact(lesson, rec::kPreviousKey), k == 0 ? "" : names[k - 1]);
    const std::string bytes = folder.read(names[k]);
    const auto reader = mcap::Reader::open(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(reader && reader->metadata(rec::kPartRecord) != nullptr);
    EXPECT_EQ(reader->metadata(rec::kPartRecord)->at(rec::kLastKey), k == 2 ? "true" : "false");
  }
}

TEST(RecordingFiles, BeginNoFileWhileTheSessionWaits) {
  const Folder folder;
  Recording recording(folder, {.file_s = 1});
  constexpr std::size_t kTick = 1 + 8 + 4 + 4;  // of the journal, without a client [bytes]
  std::vector<std::byte> piece(8 + kTick);      // with its position
  piece[8] = std::byte{11};                     // InputRecord::kTick
  piece[9] = std::byte{100};
  std::uint64_t position = 0;
  const auto wait = [&](int quarters) {
    for (int q = 0; q < quarters; ++q) {
      for (int k = 0; k < 250; ++k, position += kTick) {
        std::memcpy(piece.data(), &position, sizeof position);
        recording.files().add_inputs(piece);
      }
      recording.run_nothing();
    }
  };
  wait(4 * 60);
  const std::uint64_t before = recording.files().bytes();
  wait(4 * 600);
  const auto waited = static_cast<double>(recording.files().bytes() - before);
  std::printf("[  figures ] a session that waits takes %.2f MB per day\n", waited * 144 / 1e6);
  EXPECT_LT(waited, 20'000) << "ten minutes of waiting";
  recording.run(6);
  wait(400);
  recording.run(2);
  EXPECT_EQ(recording.close(),
            (std::vector<std::string>{folder.file("a.mcap"), folder.file("a-2.mcap"), folder.file("a-3.mcap")}));
  EXPECT_EQ(read(folder, "a.mcap").rows(), 1000u);
  EXPECT_EQ(read(folder, "a-2.mcap").rows(), 500u) << "and the wait";
  EXPECT_EQ(read(folder, "a-3.mcap").rows(), 500u);
}

TEST(RecordingFiles, LeaveNoFileOfASessionThatNeverRan) {
  const Folder folder;
  {
    Recording never(folder);
    never.run_nothing();
    EXPECT_TRUE(never.close().empty());
    EXPECT_EQ(never.files().take_removed(), std::vector<std::string>{folder.file("a.mcap")});
    EXPECT_TRUE(never.files().take_problems().empty());
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.mcap")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.mcap.part")));
  }
  Recording noted(folder);
  noted.files().writer().add_mark({.t_s = 0, .by = "Ada", .text = "before the lesson"});
  EXPECT_EQ(noted.close().size(), 1u) << "a mark is content";
  EXPECT_EQ(read(folder, "a.mcap").marks.size(), 1u);
}

TEST(RecordingFiles, GoOnInTheSameFileWhileTheNextOneCannotBeMade) {
  const Folder folder;
  Recording recording(folder, {.file_s = 1});
  recording.run(4);
  recording.settle([&] { return std::filesystem::file_size(folder.file("a.mcap.part")) >= recording.files().bytes(); });
  tandem::test::inject(folder.file("a-2.mcap.part"), {.kind = FileFault::Kind::kNoSpace, .lasting = true});
  recording.run(4);
  const auto problems = recording.files().take_problems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find("no further file can be made, so this one goes on"), std::string::npos) << problems[0];
  tandem::test::no_faults();
  recording.run(4 * 12);  // the next attempt comes after 10 s
  EXPECT_GT(recording.close().size(), 1u);
  const Lesson first = read(folder, "a.mcap"), second = read(folder, "a-2.mcap");
  EXPECT_GE(first.rows(), 2000u);
  EXPECT_EQ(second.tick.front(), first.tick.back() + 1) << "no tick is lost";
  EXPECT_EQ(account_problem(first) + account_problem(second), "");
}

TEST(RecordingFiles, EndAtTheLimitOfAllFiles) {
  const Folder folder;
  Recording recording(folder, {.total_bytes = 100'000});
  for (int k = 0; k < 100 && !recording.files().ended(); ++k) recording.run(1);
  EXPECT_TRUE(recording.files().ended());
  const auto problems = recording.files().take_problems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find("limit"), std::string::npos);
  EXPECT_EQ(recording.close().size(), 1u);
  EXPECT_LT(std::filesystem::file_size(folder.file("a.mcap")), 400'000u);
  EXPECT_EQ(account_problem(read(folder, "a.mcap")), "");
}

/// The account of a channel with a message in every tick.
LessonCount tool_count(const Lesson& lesson) { return lesson.counts.at("/" + lesson.scene.tools[0].name); }

TEST(RecordingFiles, LeaveOutAndCountTicksBeyondTheRate) {
  const Folder folder;
  Recording recording(folder, {.bytes_per_s = 10'000});
  recording.run(80);
  EXPECT_NE(recording.files().trouble().find("per minute"), std::string::npos) << recording.files().trouble();
  recording.close();
  const Lesson lesson = read(folder, "a.mcap");
  EXPECT_EQ(account_problem(lesson), "");
  const LessonCount count = tool_count(lesson);
  EXPECT_EQ(count.recorded + count.dropped + count.never_received, 20'000u);
  EXPECT_EQ(count.recorded, recording.files().recorded());
  EXPECT_EQ(count.dropped, recording.files().lost());
  EXPECT_GT(count.dropped, 1000u);
  EXPECT_LT(std::filesystem::file_size(folder.file("a.mcap")), 10'000u * (20 + 10) * 2);
}

// 3.6 MB of inputs from before a recording, whose rate allows 2 MB at its begin: no tick is left out for them.
TEST(RecordingFiles, AddEarlierInputsBesideTheRate) {
  const Folder folder;
  Recording recording(folder, {.bytes_per_s = 200'000});
  RandomStream random{RandomKey{9}};
  std::string block(300'000, '\0');
  for (char& c : block) c = static_cast<char>(random.bits());
  for (int k = 0; k < 12; ++k) {
    recording.run(2);
    recording.settle([&] { return recording.files().accepts(); });
    recording.files().add_input_block(block, block.size());
  }
  recording.run(4);
  EXPECT_EQ(recording.files().trouble(), "");
  EXPECT_GT(recording.files().bytes(), 3'000'000u);
  recording.close();
  EXPECT_EQ(recording.files().lost(), 0u);
  EXPECT_EQ(account_problem(read(folder, "a.mcap")), "");
}

TEST(RecordingFiles, CountWhatTheSessionDidNotRecord) {
  const Folder folder;
  Recording recording(folder);
  recording.run(1);
  recording.skip(70);  // the server was overloaded
  recording.files().count_dropped(30);
  recording.run(1);
  recording.close();
  const LessonCount count = tool_count(read(folder, "a.mcap"));
  EXPECT_EQ(count.recorded, 500u);
  EXPECT_EQ(count.dropped, 30u);
  EXPECT_EQ(count.never_received, 40u);
  EXPECT_EQ(recording.files().lost(), 70u);
}

/// A disk that fails while a session runs: nothing waits, and the file says what is missing.
void expect_true_counts_on_a_failing_disk(FileFault::Kind kind) {
  const Folder folder;
  Recording recording(folder, {}, "eight_seats");
  recording.run(4);
  recording.settle([&] { return recording.files().trouble().empty(); });
  tandem::test::inject(folder.file(""), {.kind = kind, .lasting = true});
  recording.run(1);
  recording.settle([&] { return !recording.files().trouble().empty(); });
  recording.run(4);
  const std::uint64_t lost = recording.files().lost();
  EXPECT_GE(lost, 1000u) << "ticks while the disk fails";
  EXPECT_NE(recording.files().trouble().find("disk"), std::string::npos) << recording.files().trouble();
  tandem::test::no_faults();
  recording.settle([&] { return recording.files().trouble().empty(); });
  recording.run(4);
  EXPECT_EQ(recording.files().lost(), lost) << "it goes on";
  recording.close();
  const Lesson lesson = read(folder, "a.mcap");
  EXPECT_TRUE(lesson.complete);
  EXPECT_EQ(account_problem(lesson), "");
  EXPECT_EQ(lesson.counts.at("/authority").dropped, lost);
  ASSERT_EQ(lesson.events.size(), 1u);
  EXPECT_EQ(lesson.events[0].what, "recording-gap");
  EXPECT_NE(lesson.events[0].text.find("disk"), std::string::npos) << lesson.events[0].text;
  EXPECT_EQ(lesson.rows() + lost, recording.tick());
}

TEST(RecordingFiles, SayWhatAFullDiskCost) { expect_true_counts_on_a_failing_disk(FileFault::Kind::kNoSpace); }
TEST(RecordingFiles, SayWhatAFailingDiskCost) { expect_true_counts_on_a_failing_disk(FileFault::Kind::kInputOutput); }
TEST(RecordingFiles, SayWhatAHalfWrittenBlockCost) { expect_true_counts_on_a_failing_disk(FileFault::Kind::kHalf); }

TEST(RecordingFiles, ReportAnEndThatTheDiskDidNotConfirm) {
  const Folder folder;
  Recording recording(folder);
  recording.run(4);
  tandem::test::inject(folder.file(""), {.kind = FileFault::Kind::kNoSync, .lasting = true});
  EXPECT_TRUE(recording.close().empty()) << "the file is not called complete";
  tandem::test::no_faults();
  const auto problems = recording.files().take_problems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].find(folder.file("a.mcap") + ": the disk did not confirm the end"), 0u) << problems[0];
  EXPECT_EQ(read(folder, "a.mcap").rows(), 1000u);
}

TEST(RecordingFiles, StayReadableWhenTheDiskIsFullToTheEnd) {
  const Folder folder;
  Recording recording(folder);
  recording.run(4);
  recording.settle([&] { return std::filesystem::file_size(folder.file("a.mcap.part")) >= recording.files().bytes(); });
  tandem::test::inject(folder.file(""), {.kind = FileFault::Kind::kNoSpace, .lasting = true});
  recording.run(4);
  recording.files().begin_close();
  recording.files().abandon();
  tandem::test::no_faults();
  const auto problems = recording.files().take_problems();
  ASSERT_FALSE(problems.empty());
  EXPECT_NE(problems.back().find("tandem-server repair"), std::string::npos) << problems.back();
  const RecordingRepair repair = repair_recording(folder.file("a.mcap.part"));
  EXPECT_EQ(repair.kind, RecordingRepair::Kind::kRepaired) << repair.text;
  const Lesson lesson = read(folder, "a.mcap");
  EXPECT_GE(lesson.rows(), 500u) << "only the chunk that was open is missing";
  EXPECT_EQ(account_problem(lesson), "");
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.mcap.part")));
}

}  // namespace
}  // namespace tandem::server
