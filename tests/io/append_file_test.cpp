// Files that grow on a thread of their own: full, failing and slow disks, and what remains of them.
#include "common/io/append_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tests/io/programs.h"
#include "tests/support/file_faults.h"

namespace tandem::io {
namespace {

using namespace std::chrono_literals;
using test::FileFault;

constexpr auto kLimit = 30s;  // against hanging; durations are never judged

bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kLimit; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

std::string block(std::size_t i, std::size_t size = 1000) { return std::string(size, static_cast<char>('a' + i % 26)); }

std::unique_ptr<AppendFile> open_file(const std::string& path, AppendFileOptions options = {}) {
  auto file = AppendFile::create(path, options);
  EXPECT_TRUE(file) << file.error();
  return std::move(*file);
}

TEST(AppendFile, GivesTheNameOnlyToACompleteFile) {
  const test::Folder folder;
  const auto file = open_file(folder.file("a"));
  std::string all;
  for (std::size_t i = 0; i < 50; ++i) {
    all += block(i);
    file->append(block(i));
  }
  EXPECT_TRUE(std::filesystem::exists(file->part()));
  EXPECT_FALSE(std::filesystem::exists(folder.file("a")));
  EXPECT_EQ(file->close(kLimit), "");
  EXPECT_EQ(folder.read("a"), all);
  EXPECT_FALSE(std::filesystem::exists(file->part()));
  struct stat status{};
  ASSERT_EQ(::stat(folder.file("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07137U, 0u) << "for owner and group only";
}

TEST(AppendFile, NeverReplacesAFile) {
  const test::Folder folder;
  folder.write("a", "old");
  EXPECT_FALSE(AppendFile::create(folder.file("a")));
  folder.write("b.part", "old");
  const auto left = AppendFile::create(folder.file("b"));
  ASSERT_FALSE(left);
  EXPECT_NE(left.error().find("tandem-server repair"), std::string::npos) << left.error();
  const auto file = open_file(folder.file("c"));
  file->append("new");
  folder.write("c", "came meanwhile");
  EXPECT_NE(file->close(kLimit).find("c.part"), std::string::npos);
  EXPECT_EQ(folder.read("c"), "came meanwhile");
  EXPECT_EQ(folder.read("c.part"), "new");
}

TEST(AppendFile, HoldsALockWhileItGrows) {
  const test::Folder folder;
  const auto file = open_file(folder.file("a"));
  const Fd other{::open(file->part().c_str(), O_RDONLY)};
  EXPECT_NE(::flock(other.get(), LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(file->close(kLimit), "");
}

// A full disk: nothing is lost that was appended, and the file goes on where it stopped.
TEST(AppendFile, ContinuesWithoutAGapWhenADiskHasSpaceAgain) {
  for (const auto kind : {FileFault::Kind::kNoSpace, FileFault::Kind::kInputOutput, FileFault::Kind::kHalf}) {
    SCOPED_TRACE(static_cast<int>(kind));
    const test::Folder folder;
    const auto file = open_file(folder.file("a"), {.reserve = 0});
    std::string all = block(0);
    file->append(block(0));
    ASSERT_TRUE(comes_true([&] { return file->state().backlog == 0; }));
    test::inject(folder.file(""), {.kind = kind, .lasting = true});
    for (std::size_t i = 1; i < 20; ++i) {
      all += block(i);
      file->append(block(i));
    }
    EXPECT_TRUE(comes_true([&] { return !file->accepts() && file->state().failures > 1; }));
    EXPECT_NE(file->state().error, 0);
    test::no_faults();
    EXPECT_TRUE(comes_true([&] { return file->accepts() && file->state().backlog == 0; }));
    file->append("end");
    EXPECT_EQ(file->close(kLimit), "");
    EXPECT_EQ(folder.read("a"), all + "end");
  }
}

TEST(AppendFile, SaysWhyAFileOnAFullDiskIsNotComplete) {
  const test::Folder folder;
  const auto file = open_file(folder.file("a"), {.reserve = 0});
  file->append(block(0));
  ASSERT_TRUE(comes_true([&] { return file->state().backlog == 0; }));
  test::inject(folder.file(""), {.kind = FileFault::Kind::kNoSpace, .lasting = true});
  file->append(block(1));
  const std::string problem = file->close(200ms);
  const std::string kept = folder.read("a.part");  // now: without the fault, the file's thread writes the rest
  test::no_faults();
  EXPECT_NE(problem.find("the disk is full"), std::string::npos) << problem;
  EXPECT_NE(problem.find("tandem-server repair"), std::string::npos) << problem;
  EXPECT_EQ(kept, block(0));
}

TEST(AppendFile, LeavesNoFileWithoutAByte) {
  const test::Folder folder;
  auto file = open_file(folder.file("a"), {.reserve = 0});
  test::inject(folder.file(""), {.kind = FileFault::Kind::kNoSpace, .lasting = true});
  file->append(block(0));
  const std::string problem = file->close(200ms);
  EXPECT_NE(problem.find("a was not written, not even in part: the disk is full"), std::string::npos) << problem;
  file.reset();
  test::no_faults();
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.part")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("a")));
}

TEST(AppendFile, TakesNothingMoreWhenItsBacklogIsFull) {
  const test::Folder folder;
  const auto file = open_file(folder.file("a"), {.backlog_max = 2500, .reserve = 0});
  test::inject(folder.file(""), {.kind = FileFault::Kind::kNoSpace, .lasting = true});
  EXPECT_TRUE(file->accepts());
  for (std::size_t i = 0; i < 3; ++i) file->append(block(i));
  EXPECT_FALSE(file->accepts());
  test::no_faults();
  EXPECT_TRUE(comes_true([&] { return file->accepts(); }));
  EXPECT_EQ(file->close(kLimit), "");
}

// A limit of the size of files is an error of the write; it must not end the process.
TEST(AppendFile, SurvivesALimitOfTheSizeOfFiles) {
  const test::Folder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    auto file = AppendFile::create(folder.file("a"), {.reserve = 0});
    if (!file) ::_exit(3);
    for (std::size_t i = 0; i < 8; ++i) (*file)->append(block(i));
    const std::string problem = (*file)->close(500ms);
    ::_exit(problem.find("larger than allowed") == std::string::npos ? 4 : 5);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 5);
  EXPECT_EQ(std::filesystem::file_size(folder.file("a.part")), 4096u);
}

}  // namespace
}  // namespace tandem::io
