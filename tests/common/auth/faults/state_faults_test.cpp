// Every call that touches a file of a state directory fails, is cut short, or is the last one of its process. The tests
// do this to one call after the other. The program then restarts, and every answer that it gave before must still be
// true.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <set>

#include "common/auth/io/append_file.h"
#include "common/auth/io/client_keystore.h"
#include "common/auth/io/server_keystore.h"
#include "tests/common/auth/faults/state_check.h"
#include "tests/common/auth/faults/state_files.h"
#include "tests/common/auth/io/temporary_folder.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;
using Kind = FileFault::Kind;

constexpr std::size_t kShown = 5;  // errors that are printed; the others are counted

/// Uses memory for thousands of small folders, where /dev/shm exists.
class InMemory final : public testing::Environment {
 public:
  void SetUp() override {
    if (access("/dev/shm", W_OK | X_OK) == 0) setenv("TMPDIR", "/dev/shm", 0);
  }
};
const testing::Environment* const in_memory = testing::AddGlobalTestEnvironment(new InMemory);

/// A story in memory that is shared by this process and its children.
class SharedStory {
 public:
  SharedStory() : memory_(mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    page_ = new (memory_) Page;
  }
  ~SharedStory() { munmap(memory_, sizeof(Page)); }
  struct Page {
    Story story;
    std::size_t calls = 0;
    bool hit = false;
  };
  Page& fresh() { return *(page_ = new (memory_) Page); }

 private:
  void* memory_;
  Page* page_;
};

/// Runs `what` in a child process under `fault`. @return its exit code
template <class What>
int under(const std::string& folder, const FileFault& fault, SharedStory::Page& page, What what) {
  const pid_t child = fork();
  if (child == 0) {
    inject(folder, fault);
    what(page.story);
    page.calls = file_calls();
    page.hit = fault_hit();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string name_of(const FileFault& fault) {
  constexpr const char* kNames[] = {"none",          "ENOSPC",        "EIO", "EMFILE", "half a write, then ENOSPC",
                                    "killed before", "killed halfway"};
  return std::string(kNames[static_cast<int>(fault.kind)]) + (fault.lasting ? " from call " : " at call ") +
         std::to_string(fault.at);
}

constexpr FileFault kKinds[] = {{Kind::kNoSpace, 0, false},       {Kind::kNoSpace, 0, true},
                                {Kind::kInputOutput, 0, false},   {Kind::kInputOutput, 0, true},
                                {Kind::kNoDescriptors, 0, false}, {Kind::kNoDescriptors, 0, true},
                                {Kind::kHalf, 0, false},          {Kind::kHalf, 0, true},
                                {Kind::kKill, 0, false},          {Kind::kKillHalfway, 0, false}};

/// Returns the file calls of a story without faults, as counted in the process that makes them.
template <class What>
std::vector<std::string> calls_of(const auth::test::Folder& begin, What what) {
  const auth::test::Folder folder;
  fs::copy(begin.path(), folder.path(), fs::copy_options::recursive);
  inject(folder.path(), {});
  Story story;
  what(folder.path(), story);
  std::vector<std::string> calls;
  for (std::size_t i = 0; i < file_calls(); ++i) calls.push_back(file_call(i));
  no_faults();
  EXPECT_EQ(unknown_files(folder.path()), "");
  return calls;
}

template <class What, class Check>
void at_every_call(const auth::test::Folder& begin, What what, Check check) {
  const std::vector<std::string> calls = calls_of(begin, what);
  ASSERT_GT(calls.size(), 4u);
  SharedStory shared;
  std::size_t runs = 0, hits = 0, wrong = 0;
  for (FileFault fault : kKinds)
    for (fault.at = 0; fault.at < calls.size(); ++fault.at) {
      const auth::test::Folder folder;
      fs::copy(begin.path(), folder.path(), fs::copy_options::recursive);
      SharedStory::Page& page = shared.fresh();
      const int code = under(folder.path(), fault, page, [&](Story& story) { what(folder.path(), story); });
      ++runs;
      hits += page.hit || code == kKilledByFault ? 1 : 0;
      std::string said = code != 0 && code != kKilledByFault ? "it ended with " + std::to_string(code) + "\n" : "";
      said += check(folder.path(), page.story, fault);
      if (!said.empty() && ++wrong <= kShown)
        ADD_FAILURE() << name_of(fault) << " (" << calls[fault.at] << "):\n" << said;
    }
  EXPECT_EQ(wrong, 0u) << "of " << runs << " runs";
  EXPECT_GT(2 * hits, runs) << "faults that hit nothing prove nothing";
  std::printf("%zu calls, %zu runs, %zu faults hit\n", calls.size(), runs, hits);
}

TEST(StateFaults, KeepServerFilesConsistentWithRepliesAtEveryCall) {
  const auth::test::Folder begin;
  prepare(begin.path());
  at_every_call(begin, live_server, wrong_with_server);
}

TEST(StateFaults, KeepTheNewOrPreviousCheckpointWholeAtEveryCall) {
  const auth::test::Folder begin;
  prepare(begin.path());
  at_every_call(begin, live_session, wrong_with_session);
}

TEST(StateFaults, KeepWorkstationKeyAndServersAtEveryCall) {
  const auth::test::Folder begin;
  at_every_call(begin, live_workstation, wrong_with_workstation);
}

/// If the first start ends early, the second one succeeds without manual cleaning.
TEST(StateFaults, RepeatAnUnfinishedFirstStart) {
  const auth::test::Folder begin;
  at_every_call(
      begin,
      [](const std::string& folder, Story& story) { story.serving = first_start(folder) ? Told::kYes : Told::kNo; },
      [](const std::string& folder, const Story& story, const FileFault&) -> std::string {
        const bool was = auth::ServerKeystore::open(folder + "/fresh").has_value();
        if (story.serving == Told::kYes && !was) return "it was set up, and is not";
        if (!was && !first_start(folder)) return auth::ServerKeystore::init(folder + "/fresh", 1).error();
        const auto trust = auth::ServerKeystore::open(folder + "/fresh");
        return (trust ? std::string() : trust.error()) + unknown_files(folder);
      });
}

/// The message has the same words as for every other output file, on server and client.
TEST(StateFaults, ReportAFullDiskAndItsRemedy) {
  const auth::test::Folder begin;
  const std::string path = begin.path() + "/state";
  ASSERT_TRUE(auth::ServerKeystore::init(path, 1));
  auto trust = auth::ServerKeystore::open(path);
  ASSERT_TRUE(trust) << trust.error();
  const auth::StateDirectory& folder = *trust->folder();
  ASSERT_EQ(auth::AppendFile(folder, "lines").append("first\n"), "");
  inject(begin.path(), {Kind::kNoSpace, 0, true});
  const auto made = auth::ServerKeystore::init(begin.path() + "/another", 1);
  const std::string texts[] = {trust->registry().enroll_without_code({"desk", {}, 1}),
                               folder.replace("book", "text"),
                               auth::AppendFile(folder, "lines").append("second\n"),
                               auth::AppendFile(folder, "new").append("line\n"),
                               made ? "" : made.error(),
                               auth::ClientKeystore::open_or_make(begin.path() + "/own", 1).error()};
  no_faults();
  for (const std::string& text : texts)
    EXPECT_NE(text.find(": the disk is full (No space left on device); free some space there"), std::string::npos)
        << text;
  EXPECT_EQ(texts[1].find(folder.path_of("book") + " cannot be written"), 0u) << texts[1] << "not an unknown name";
}

/// kStateFiles contains no file that the stories do not create.
TEST(StateFaults, CoverEveryListedFile) {
  const auth::test::Folder begin;
  prepare(begin.path());
  std::set<const StateFile*> met;
  std::vector<std::string> calls;
  for (const auto part : {live_server, live_session, live_workstation})
    for (std::string& call : calls_of(begin, part)) calls.push_back(std::move(call));
  for (const std::string& call : calls) {
    const std::string name = fs::path(call.substr(call.find(' ') + 1)).filename().string();
    const std::string_view beside = written_beside(name);
    met.insert(state_file(beside.empty() ? name : beside));
  }
  for (const StateFile& file : kStateFiles) EXPECT_TRUE(met.contains(&file)) << file.name;
}

}  // namespace
}  // namespace tandem::test
