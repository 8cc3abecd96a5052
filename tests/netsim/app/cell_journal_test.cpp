// The file of finished cells: kept results, other programs and cells, damage, disk faults and kills at every call.
#include "netsim/app/cell_journal.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/file_faults.h"

namespace tandem::netsim {
namespace {

using test::FileFault;
using Kind = FileFault::Kind;

class CellJournalFile : public ::testing::Test {
 protected:
  CellJournalFile() {
    std::string name = (std::filesystem::temp_directory_path() / "tandem-cells-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~CellJournalFile() override {
    test::no_faults();
    std::filesystem::remove_all(folder_);
  }
  [[nodiscard]] std::string name() const { return folder_ + "/results"; }
  [[nodiscard]] std::string text() const {
    std::ostringstream out;
    out << std::ifstream(name(), std::ios::binary).rdbuf();
    return out.str();
  }
  void write(const std::string& content) const { std::ofstream(name(), std::ios::binary) << content; }
  /// Returns the finished cells after opening again, or the error.
  [[nodiscard]] std::string opened(const CellJournal::Identity& identity = kIdentity) const {
    const auto journal = CellJournal::open(name(), identity);
    if (!journal) return journal.error();
    std::string all;
    for (const auto& [number, result] : journal->finished()) all += std::to_string(number) + "=" + result + " ";
    return all;
  }

  inline static const CellJournal::Identity kIdentity{"0123456789abcdef", "fedcba9876543210", 9};
  std::string folder_;
};

TEST_F(CellJournalFile, ReturnsWhatWasAppended) {
  {
    auto journal = CellJournal::open(name(), kIdentity);
    ASSERT_TRUE(journal) << journal.error();
    EXPECT_TRUE(journal->finished().empty());
    EXPECT_EQ(journal->append(7, "[seven]"), "");
    EXPECT_EQ(journal->append(2, "[two]"), "");
  }
  EXPECT_EQ(opened(), "2=[two] 7=[seven] ");
}

TEST_F(CellJournalFile, RejectsResultsOfAnotherProgramAndOfOtherCells) {
  EXPECT_EQ(opened(), "");
  const std::string before = text();
  EXPECT_NE(opened({"another program.", kIdentity.cells, 9}).find("results of another version of the program"),
            std::string::npos);
  EXPECT_NE(opened({kIdentity.program, "other cells.....", 9}).find("has results of other cells"), std::string::npos);
  EXPECT_NE(opened({kIdentity.program, kIdentity.cells, 8}).find("remove this one to compute all cells again"),
            std::string::npos);
  EXPECT_EQ(text(), before) << "a rejected file stays unchanged";
}

TEST_F(CellJournalFile, RejectsFilesOfOtherKinds) {
  for (const char* content : {"delay[ms],jitter[ms]\n0,0\n", "some words", "\n"}) {
    write(content);
    EXPECT_NE(opened().find("is no file of results of a sweep"), std::string::npos) << content << opened();
    EXPECT_EQ(text(), content);
  }
  const auto folder = CellJournal::open(folder_, kIdentity);
  ASSERT_FALSE(folder);
  EXPECT_NE(folder.error().find("cannot be opened"), std::string::npos) << folder.error();
  EXPECT_FALSE(CellJournal::open("/no/such/folder/results", kIdentity));
}

TEST_F(CellJournalFile, RemovesALineWithoutItsEndAtEveryLength) {
  {
    auto journal = CellJournal::open(name(), kIdentity);
    ASSERT_TRUE(journal);
    ASSERT_EQ(journal->append(1, "[one]"), "");
    ASSERT_EQ(journal->append(2, "[two]"), "");
  }
  const std::string whole = text();
  const std::size_t head = whole.find('\n') + 1, first = whole.find('\n', head) + 1;
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    write(whole.substr(0, length));
    EXPECT_EQ(opened(), length < first ? "" : length < whole.size() ? "1=[one] " : "1=[one] 2=[two] ") << length;
    auto journal = CellJournal::open(name(), kIdentity);
    ASSERT_TRUE(journal) << journal.error();
    EXPECT_EQ(journal->append(3, "[three]"), "");
  }
}

TEST_F(CellJournalFile, NamesADamagedLine) {
  {
    auto journal = CellJournal::open(name(), kIdentity);
    ASSERT_TRUE(journal);
    ASSERT_EQ(journal->append(1, "[one]"), "");
    ASSERT_EQ(journal->append(2, "[two]"), "");
  }
  const std::string whole = text();
  const std::size_t head = whole.find('\n') + 1;
  for (std::size_t at = head; at + 1 < whole.size(); ++at) {
    if (whole[at] == '\n') continue;
    std::string wrong = whole;
    wrong[at] = wrong[at] == '9' ? '8' : '9';
    write(wrong);
    const std::string says = opened();
    // The number of a cell is not in the checksum: 9 is a valid one.
    const bool number = at == head || whole[at - 1] == '\n';
    if (number) continue;
    EXPECT_NE(says.find("the line is damaged"), std::string::npos) << at << " " << says;
  }
  write(whole + "10 00000000 [ten]\n");
  EXPECT_NE(opened().find(":4: the line is damaged"), std::string::npos) << opened();
}

TEST_F(CellJournalFile, UndoesAWriteThatDidNotFitOnTheDisk) {
  auto journal = CellJournal::open(name(), kIdentity);
  ASSERT_TRUE(journal);
  ASSERT_EQ(journal->append(1, "[one]"), "");
  const std::string before = text();
  for (const Kind kind : {Kind::kNoSpace, Kind::kHalf}) {
    test::inject(folder_, {kind, 0, false});
    const std::string problem = journal->append(2, "[two]");
    test::no_faults();
    EXPECT_NE(problem.find("the disk is full"), std::string::npos) << problem;
    EXPECT_EQ(text(), before);
  }
  EXPECT_EQ(journal->append(2, "[two]"), "") << "there is space again";
  journal = std::unexpected(std::string());  // releases the lock
  EXPECT_EQ(opened(), "1=[one] 2=[two] ");
}

TEST_F(CellJournalFile, LosesNoFinishedCellWhenKilledAtAnyCall) {
  for (const Kind kind : {Kind::kKill, Kind::kKillHalfway})
    for (std::size_t call = 0; call < 12; ++call) {
      std::filesystem::remove(name());
      const pid_t child = fork();
      ASSERT_GE(child, 0);
      if (child == 0) {
        test::inject(folder_, {kind, call, false});
        auto journal = CellJournal::open(name(), kIdentity);
        if (!journal || !journal->append(1, "[one]").empty()) _exit(1);
        std::ofstream(folder_ + "-one") << 1;  // confirmed; outside of the folder with faults
        _exit(journal->append(2, "[two]").empty() ? 0 : 1);
      }
      int status = 0;
      ASSERT_EQ(waitpid(child, &status, 0), child);
      const bool one = std::filesystem::remove(folder_ + "-one"), two = WIFEXITED(status) && WEXITSTATUS(status) == 0;
      const std::string says = opened();
      SCOPED_TRACE(says);
      EXPECT_TRUE(says.empty() || says == "1=[one] " || says == "1=[one] 2=[two] ");
      EXPECT_TRUE(!one || !says.empty());
      EXPECT_TRUE(!two || says == "1=[one] 2=[two] ");
    }
}

}  // namespace
}  // namespace tandem::netsim
