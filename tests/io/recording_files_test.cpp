// Files of recordings: limits, full and failing disks, cuts and repairs. Counts stay true in all of them.
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
#include "tests/io/recording_samples.h"
#include "tests/support/file_faults.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using tandem::test::FileFault;
using tandem::test::Folder;
using test::account_problem;
using test::info_of;
using test::lesson_of;
using test::record_at;

constexpr auto kLimit = 30s;  // against hanging

bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kLimit; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

/// A recording of virtual time: 250 ticks, then a step, as the thread of a server does.
class Recording {
 public:
  explicit Recording(const Folder& folder, const RecordingLimits& limits = {}, const std::string& scene = "contact")
      : scene_(test::scene_named(scene)),
        files_(std::move(*RecordingFiles::open(folder.file("a.mcap"), scene_, info_of(scene_), limits, now_))) {
    files_->begin(1'700'000'000'000'000'000);
  }
  /// Adds ticks of `s` quarters of a second.
  void run(int quarters) {
    for (int q = 0; q < quarters; ++q) {
      for (int k = 0; k < 250; ++k) files_->add(record_at(scene_, ++tick_));
      now_ += 250ms;
      files_->step(now_);
    }
  }
  /// A quarter of a second in which the session does not run.
  void run_nothing() {
    now_ += 250ms;
    files_->step(now_);
  }
  /// Steps without ticks until the disk has followed.
  void settle(const std::function<bool()>& so) {
    EXPECT_TRUE(comes_true([&] {
      files_->step(now_);
      return so();
    }));
  }
  std::vector<std::string> close() {
    files_->begin_close();
    EXPECT_TRUE(comes_true([&] { return files_->closed(); }));
    return files_->take_completed();
  }
  RecordingFiles& files() { return *files_; }
  [[nodiscard]] std::uint32_t tick() const { return tick_; }
  void skip(std::uint32_t ticks) { tick_ += ticks; }

 private:
  Time now_{};
  SceneSpec scene_;
  std::unique_ptr<RecordingFiles> files_;
  std::uint32_t tick_ = 0;
};

/// Size of a file without ticks [bytes].
std::size_t head_bytes() {
  const SceneSpec scene = test::scene_named("contact");
  RecordingWriter empty{scene, info_of(scene)};
  empty.finish();
  return empty.take().size();
}

Lesson read(const Folder& folder, const std::string& name) {
  auto lesson = lesson_of(folder.read(name));
  EXPECT_TRUE(lesson) << name << ": " << lesson.error();
  return lesson ? std::move(*lesson) : Lesson{};
}

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

// ---- Repair ----

TEST(RecordingRepair, KeepsEveryWholeChunkOfACutFile) {
  const Folder folder;
  Recording recording(folder);
  recording.run(8);
  recording.close();
  const std::string whole = folder.read("a.mcap");
  const std::size_t head = head_bytes();  // with definitions and scene, no tick
  RandomStream random(17);
  std::size_t rows = 0;
  const std::size_t cuts = tandem::test::draws(60, 400, 2000);
  for (std::size_t k = 0; k < cuts; ++k) {
    SCOPED_TRACE(k);
    const std::size_t size = random.below(whole.size() + 1);
    folder.write("b.mcap.part", whole.substr(0, size));
    const RecordingRepair repair = repair_recording(folder.file("b.mcap.part"));
    if (repair.kind == RecordingRepair::Kind::kFailed) {
      EXPECT_LT(size, head) << repair.text << ": only a file without its begin cannot be repaired";
      EXPECT_EQ(folder.read("b.mcap.part").size(), size) << "the original stays";
      continue;
    }
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.mcap.part")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.mcap.repair")));
    const auto lesson = lesson_of(folder.read("b.mcap"));
    if (lesson) {
      EXPECT_EQ(account_problem(*lesson), "") << size;
      rows = std::max(rows, lesson->rows());
    } else {
      EXPECT_LT(size, head) << lesson.error();
    }
    const RecordingRepair again = repair_recording(folder.file("b.mcap"));
    EXPECT_EQ(again.kind, RecordingRepair::Kind::kComplete) << again.text;
    std::filesystem::remove(folder.file("b.mcap"));
  }
  EXPECT_GT(rows, 1000u);
}

TEST(RecordingRepair, LeavesTheOriginalUntilTheRepairedFileIsComplete) {
  const Folder folder;
  Recording recording(folder);
  recording.run(4);
  recording.close();
  const std::string cut = folder.read("a.mcap").substr(0, std::filesystem::file_size(folder.file("a.mcap")) * 3 / 4);
  tandem::test::inject(folder.file(""), {});
  folder.write("count.mcap.part", cut);
  EXPECT_EQ(repair_recording(folder.file("count.mcap.part")).kind, RecordingRepair::Kind::kRepaired);
  const std::size_t calls = tandem::test::file_calls();
  tandem::test::no_faults();
  ASSERT_GT(calls, 4u);
  for (std::size_t at = 0; at < calls; ++at) {
    SCOPED_TRACE(at);
    folder.write("b.mcap.part", cut);
    tandem::test::inject(folder.file(""), {.kind = FileFault::Kind::kNoSpace, .at = at, .lasting = true});
    const RecordingRepair repair = repair_recording(folder.file("b.mcap.part"));
    tandem::test::no_faults();
    const bool done = repair.kind == RecordingRepair::Kind::kRepaired;
    if (!done) {
      EXPECT_EQ(folder.read("b.mcap.part"), cut);
    }
    EXPECT_EQ(std::filesystem::exists(folder.file("b.mcap")), done) << repair.text;
    std::filesystem::remove(folder.file("b.mcap"));
    std::filesystem::remove(folder.file("b.mcap.part"));
    std::filesystem::remove(folder.file("b.mcap.repair"));
  }
}

TEST(RecordingRepair, TouchesNoFileThatIsWritten) {
  const Folder folder;
  Recording recording(folder);
  recording.run(4);
  recording.settle([&] { return std::filesystem::file_size(folder.file("a.mcap.part")) > 0; });
  const RecordingRepair repair = repair_recording(folder.file("a.mcap.part"));
  EXPECT_EQ(repair.kind, RecordingRepair::Kind::kInUse) << repair.text;
  EXPECT_EQ(recording_leftovers(folder.file("")).size(), 1u);
  EXPECT_EQ(recording.close().size(), 1u);
}

TEST(RecordingRepair, NamesForeignFilesAndReplacesNone) {
  const Folder folder;
  folder.write("f.mcap.part", "no recording");
  const RecordingRepair foreign = repair_recording(folder.file("f.mcap.part"));
  EXPECT_EQ(foreign.kind, RecordingRepair::Kind::kFailed);
  EXPECT_NE(foreign.text.find("f.mcap.part"), std::string::npos);
  EXPECT_EQ(repair_recording(folder.file("absent.mcap")).kind, RecordingRepair::Kind::kFailed);
  EXPECT_EQ(repair_recording(folder.file("")).kind, RecordingRepair::Kind::kFailed);
  Recording recording(folder);
  recording.run(4);
  recording.close();
  const std::string whole = folder.read("a.mcap");
  folder.write("c.mcap", "there already");
  folder.write("c.mcap.part", whole.substr(0, whole.size() / 2));
  const RecordingRepair repair = repair_recording(folder.file("c.mcap.part"));
  EXPECT_EQ(repair.kind, RecordingRepair::Kind::kRepaired);
  EXPECT_EQ(repair.path, folder.file("c-2.mcap"));
  EXPECT_EQ(folder.read("c.mcap"), "there already");
}

}  // namespace
}  // namespace tandem::server
