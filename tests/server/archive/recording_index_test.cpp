// The index as a database: scans, foreign files, kills at any moment, deletions with their audit lines.
#include "server/archive/app/recording_index.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <filesystem>

#include "server/archive/app/recording_deletion.h"
#include "server/archive/app/recording_scan.h"
#include "tests/io/programs.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;

/// Reads the content of a test file as the name of its person; files that begin with `bad` are damaged.
std::expected<RecordingSummary, std::string> read_test_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  if (text.str().starts_with("bad")) return std::unexpected("it is no MCAP file");
  RecordingSummary summary;
  summary.session = "s";
  summary.rows = 5;
  summary.persons = {{text.str(), "trainee"}, {"Eve", "notes"}};
  return summary;
}

constexpr auto kGoOn = [](std::size_t, std::size_t) { return true; };

std::string folder_of(const test::Folder& folder) { return folder.file("."); }

RecordingIndex open(const test::Folder& folder) {
  auto index = RecordingIndex::open(folder_of(folder));
  if (!index) throw std::runtime_error(index.error());
  return std::move(*index);
}

ScanReport scan(const test::Folder& folder, RecordingIndex& index) {
  return scan_recordings(folder_of(folder), index, read_test_file, kGoOn).value();
}

TEST(RecordingIndex, KeepsRowsBetweenProcesses) {
  const test::Folder folder;
  RecordingRow row{"a.mcap", 12, 34, "", {}};
  row.summary = {"session",
                 "scene",
                 -5,
                 1.25,
                 1ULL << 40,
                 3,
                 false,
                 {{"Ada", "trainee"}, {"Ada", "notes"}},
                 {.file = "",
                  .session_id = "5",
                  .epoch = "7",
                  .recording = "lab",
                  .number = 3,
                  .last = false,
                  .previous_file = "lab-2.mcap"}};
  EXPECT_EQ(open(folder).put(row), "");
  EXPECT_EQ(open(folder).put({"B.mcap", 1, 2, "it is damaged", {}}), "");
  auto index = open(folder);
  auto rows = index.rows().value();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].file, "B.mcap");
  EXPECT_EQ(rows[0].problem, "it is damaged");
  EXPECT_EQ(rows[1], row);
  row.summary.persons = {{"Bob", "trainee"}};
  EXPECT_EQ(index.put(row), "");
  EXPECT_EQ(index.rows().value()[1], row) << "persons of the old row are gone";
  EXPECT_EQ(index.remove("a.mcap"), "");
  EXPECT_EQ(index.rows().value().size(), 1u);
  struct stat facts{};
  ASSERT_EQ(stat(folder.file(RecordingIndex::kFile).c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 07, 0u) << "names of persons are not for other users";
}

TEST(RecordingIndex, OfAnOlderVersionIsMadeAgain) {
  const test::Folder folder;
  EXPECT_EQ(open(folder).put({"a.mcap", 1, 2, "it is damaged", {}}), "");
  test::Process older({"/usr/bin/python3", "-c",
                       "import sqlite3, sys; d = sqlite3.connect(sys.argv[1]); "
                       "d.execute('ALTER TABLE recording DROP COLUMN previous_file'); "
                       "d.execute('PRAGMA user_version = 1'); d.commit()",
                       folder.file(RecordingIndex::kFile)});
  if (older.wait() != 0) GTEST_SKIP() << "python3 has no module sqlite3";
  auto index = open(folder);
  EXPECT_TRUE(index.rows().value().empty()) << "the next scan reads the files";
  EXPECT_EQ(index.put({"a.mcap", 1, 2, "it is damaged", {}}), "");
  EXPECT_EQ(open(folder).rows().value().size(), 1u);
}

TEST(RecordingIndex, RefusesForeignAndDamagedFilesWithARemedy) {
  const test::Folder folder;
  folder.write(RecordingIndex::kFile,
               "this is no database at all, but a text of more than a hundred bytes, which "
               "SQLite must not take for one of its own files");
  auto index = RecordingIndex::open(folder_of(folder));
  ASSERT_FALSE(index);
  EXPECT_NE(index.error().find("move it away and repeat"), std::string::npos) << index.error();
  const test::Folder other;
  test::Process sqlite({"/usr/bin/python3", "-c",
                        "import sqlite3, sys; d = sqlite3.connect(sys.argv[1]); d.execute('CREATE TABLE t (x)'); "
                        "d.commit()",
                        other.file(RecordingIndex::kFile)});
  if (sqlite.wait() != 0) GTEST_SKIP() << "python3 has no module sqlite3";
  index = RecordingIndex::open(folder_of(other));
  ASSERT_FALSE(index);
  EXPECT_NE(index.error().find("database of another program"), std::string::npos) << index.error();
  EXPECT_NE(RecordingIndex::open(folder.file("no")).error().find("No such file"), std::string::npos);
}

TEST(RecordingScan, ReadsNewAndChangedFilesAndForgetsThoseThatAreGone) {
  const test::Folder folder;
  fs::create_directory(folder.file("sub"));
  folder.write("a.mcap", "Ada");
  folder.write("sub/b.mcap", "Bob");
  folder.write("c.mcap", "bad");
  folder.write("d.mcap.part", "x");
  folder.write("e.txt", "Eve");
  fs::create_symlink(folder.file("a.mcap"), folder.file("link.mcap"));
  auto index = open(folder);
  ScanReport report = scan(folder, index);
  EXPECT_EQ(report.added, 3u);
  EXPECT_EQ(report.unfinished, (std::vector<std::string>{"d.mcap.part"}));
  auto rows = index.rows().value();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].file, "a.mcap");
  EXPECT_EQ(rows[0].bytes, 3u);
  EXPECT_EQ(rows[1].problem, "it is no MCAP file") << "a damaged file is named";
  EXPECT_EQ(rows[2].file, "sub/b.mcap");
  EXPECT_EQ(scan(folder, index).added, 0u) << "nothing is read twice, damaged files neither";
  folder.write("c.mcap", "Carl");
  fs::remove(folder.file("a.mcap"));
  report = scan(folder, index);
  EXPECT_EQ(report.added, 1u);
  EXPECT_EQ(report.removed, 1u);
  rows = index.rows().value();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].summary.persons[0].name, "Carl");
}

TEST(RecordingScan, ContinuesAfterAnInterruption) {
  const test::Folder folder;
  for (int k = 0; k < 5; ++k) folder.write(std::to_string(k) + ".mcap", "p");
  auto index = open(folder);
  const auto report = scan_recordings(folder_of(folder), index, read_test_file,
                                      [](std::size_t done, std::size_t total) { return total == 5 && done < 2; });
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->interrupted);
  EXPECT_EQ(index.rows().value().size(), 2u);
  EXPECT_EQ(scan(folder, index).added, 3u);
}

TEST(RecordingIndex, IsConsistentAfterAKillAtAnyMoment) {
  const test::Folder folder;
  static_cast<void>(open(folder));
  std::size_t most = 0;
  for (int round = 0; round < 20; ++round) {
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t writer = fork();
    if (writer == 0) {
      auto index = open(folder);
      for (int k = 0;; ++k) {
        RecordingRow row{std::to_string(k % 50) + ".mcap", static_cast<std::uint64_t>(k), 0, "", {}};
        row.summary.persons = {{"Ada", "a"}, {"Bob", "b"}, {"Eve", "c"}};
        if (!index.put(row).empty()) _exit(1);
        if (k == 10 + round && write(ready[1], "x", 1) != 1) _exit(1);
      }
    }
    close(ready[1]);
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1) << "the writer failed";
    close(ready[0]);
    kill(writer, SIGKILL);
    int status = 0;
    waitpid(writer, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    const auto rows = open(folder).rows();
    ASSERT_TRUE(rows) << rows.error();
    most = std::max(most, rows->size());
    for (const RecordingRow& row : *rows) EXPECT_EQ(row.summary.persons.size(), 3u) << "a row is whole or not there";
  }
  EXPECT_GE(most, 11u);
}

TEST(RecordingDeletion, WritesItsAuditLineFirstAndDeletesNothingWithoutIt) {
  const test::Folder folder;
  folder.write("a.mcap", "Ada");
  auto index = open(folder);
  scan(folder, index);
  const RecordingRow row = index.rows().value()[0];
  const std::string refused = delete_recording(folder_of(folder), index, row, "retention",
                                               [](const char*, const auto&, const auto&) { return "disk full"; });
  EXPECT_NE(refused.find("a.mcap is kept"), std::string::npos) << refused;
  EXPECT_TRUE(fs::exists(folder.file("a.mcap")));
  EXPECT_EQ(index.rows().value().size(), 1u);
  std::string lines;
  const AuditLine audit = [&](const char* event, const std::string& name, const std::string& detail) {
    lines += std::string(event) + " " + name + " " + detail + (fs::exists(folder.file("a.mcap")) ? " before" : "");
    return std::string{};
  };
  EXPECT_EQ(delete_recording(folder_of(folder), index, row, "a person's request", audit), "");
  EXPECT_EQ(lines, "recording_deleted a.mcap a person's request; 3 bytes; session s before");
  EXPECT_FALSE(fs::exists(folder.file("a.mcap")));
  EXPECT_TRUE(index.rows().value().empty());
  std::ostringstream database;
  database << std::ifstream(folder.file(RecordingIndex::kFile)).rdbuf();
  EXPECT_EQ(database.str().find("Ada"), std::string::npos) << "the name is overwritten in the index";
}

TEST(RecordingDeletion, RecordsThatAFileCouldNotBeDeleted) {
  const test::Folder folder;
  fs::create_directories(folder.file("sub.mcap/inside"));
  auto index = open(folder);
  const RecordingRow row{"sub.mcap", 1, 2, "", {}};
  ASSERT_EQ(index.put(row), "");
  std::string lines;
  const std::string problem =
      delete_recording(folder_of(folder), index, row, "on request",
                       [&lines](const char* event, const auto&, const auto&) { return lines += event, std::string{}; });
  EXPECT_NE(problem.find("sub.mcap cannot be deleted"), std::string::npos) << problem;
  EXPECT_EQ(lines, "recording_deletedrecording_kept");
  EXPECT_EQ(index.rows().value().size(), 1u);
}

}  // namespace
}  // namespace tandem::server
