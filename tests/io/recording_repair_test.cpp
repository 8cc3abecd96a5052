// Repairs of recordings: cut files, full disks, files in use, foreign files.
#include "server/recording/io/recording_repair.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/io/recorded_ticks.h"
#include "tests/support/file_faults.h"

namespace tandem::server {
namespace {

using tandem::test::FileFault;
using tandem::test::Folder;
using test::account_problem;
using test::head_bytes;
using test::lesson_of;
using test::read;
using test::Recording;

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

// NFSv4 locks only files that are open for writing.
TEST(RecordingRepair, TouchesNoFileThatIsWrittenOnNfs) {
  const Folder folder;
  Recording recording(folder);
  recording.run(4);
  recording.settle([&] { return std::filesystem::file_size(folder.file("a.mcap.part")) > 0; });
  tandem::test::inject(folder.file(""), {.kind = FileFault::Kind::kWritersLocks});
  const RecordingRepair repair = repair_recording(folder.file("a.mcap.part"));
  tandem::test::no_faults();
  EXPECT_EQ(repair.kind, RecordingRepair::Kind::kInUse) << repair.text;
  EXPECT_EQ(recording.close().size(), 1u);
}

TEST(RecordingRepair, TouchesNoFileThatItCannotLock) {
  const Folder folder;
  Recording recording(folder);
  recording.run(4);
  recording.close();
  const std::string whole = folder.read("a.mcap");
  for (const std::string& bytes : {whole, whole.substr(0, whole.size() / 2)}) {
    folder.write("b.mcap.part", bytes);
    tandem::test::inject(folder.file(""), {.kind = FileFault::Kind::kNoLocks});
    const RecordingRepair repair = repair_recording(folder.file("b.mcap.part"));
    tandem::test::no_faults();
    EXPECT_EQ(repair.kind, RecordingRepair::Kind::kFailed);
    EXPECT_NE(repair.text.find("repair the copy"), std::string::npos) << repair.text;
    EXPECT_TRUE(folder.read("b.mcap.part") == bytes);
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.mcap")));
  }
}

TEST(RecordingRepair, FailsWithoutEnoughMemory) {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "a sanitizer ends the program at an allocation that fails";
#endif
  const Folder folder;
  folder.write("big.mcap.part", "begin");
  std::filesystem::resize_file(folder.file("big.mcap.part"), std::uintmax_t{64} << 30U);  // takes no space
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  const rlimit limit{rlim_t{4} << 30U, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
  RecordingRepair repair;
  EXPECT_NO_THROW(repair = repair_recording(folder.file("big.mcap.part")));
  ::setrlimit(RLIMIT_AS, &before);
  EXPECT_EQ(repair.kind, RecordingRepair::Kind::kFailed);
  EXPECT_NE(repair.text.find("not enough memory"), std::string::npos) << repair.text;
  EXPECT_TRUE(std::filesystem::exists(folder.file("big.mcap.part")));
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
