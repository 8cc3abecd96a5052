// `tandem-netsim sweep --cells` as users start it: the same bytes twice, interrupted, killed and continued, one cell
// alone, and everything that is rejected.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <thread>

#include "tests/io/programs.h"

namespace tandem {
namespace {

using test::Folder;
using test::Process;

constexpr const char* kCells =
    "version: 1 scene: \"contact\" seeds: 2\n"
    "grid { name: \"laws\" law: [REPLICA, PD] task: [FREE, WALL] delay_ms: [0, 100] }\n"
    "grid { name: \"hands\" law: PD coupling: [CLC, PD_PEER] task: STEP loss_percent: 20 }\n";
/// Cells that take a long time together, whose first ones are finished soon.
constexpr const char* kManyCells =
    "version: 1 scene: \"contact\" seeds: 1\n"
    "grid { name: \"a\" law: [REPLICA, PD, TDPA] task: [FREE, STEP, WALL, TISSUE] delay_ms: [0, 20, 50, 100, 200] }\n";

Process sweep(test::Words arguments) {
  arguments.insert(arguments.begin(), {TANDEM_NETSIM, "sweep"});
  return Process(std::move(arguments));
}

/// Waits for the end, also longer than one limit of Process.
int ended(Process& process) {
  std::optional<int> code;
  for (int attempt = 0; attempt < 20 && !(code = process.wait()); ++attempt) {
  }
  return code.value_or(-1000);
}

/// Waits until a file of finished cells has so many lines.
void wait_for_lines(const Folder& folder, const std::string& name, std::ptrdiff_t lines) {
  for (int i = 0; i < 6000; ++i) {
    const std::string text = folder.read(name);
    if (std::count(text.begin(), text.end(), '\n') >= lines) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  FAIL() << name << " has not " << lines << " lines";
}

/// Runs all cells to the files NAME.csv and NAME.html. @return the exit code
int run_to(const Folder& folder, const std::string& cells, const std::string& name, test::Words more = {}) {
  test::Words words{"--cells", cells, "--csv", folder.file(name + ".csv"), "--html", folder.file(name + ".html"),
                    "--quiet"};
  words.insert(words.end(), more.begin(), more.end());
  Process process = sweep(words);
  const int code = ended(process);
  EXPECT_EQ(code, 0) << process.err();
  return code;
}

TEST(SweepCells, GivesTheSameBytesTwiceAndForAnyNumberOfJobs) {
  const Folder folder;
  const std::string cells = folder.write("c.textproto", kCells);
  ASSERT_EQ(run_to(folder, cells, "a", {"--jobs", "1"}), 0);
  ASSERT_EQ(run_to(folder, cells, "b", {"--jobs", "3", "--figure", folder.file("f.svg")}), 0);
  EXPECT_EQ(folder.read("a.csv"), folder.read("b.csv"));
  EXPECT_EQ(folder.read("a.html"), folder.read("b.html"));
  EXPECT_NE(folder.read("f.svg").find("<svg"), std::string::npos);
}

TEST(SweepCells, RepeatsACellAloneByTheCommandOfItsRow) {
  const Folder folder;
  const std::string cells = folder.write("c.textproto", kCells);
  ASSERT_EQ(run_to(folder, cells, "a"), 0);
  std::istringstream rows(folder.read("a.csv"));
  std::string head, row;
  std::getline(rows, head);
  for (int cell = 1; std::getline(rows, row); ++cell) {
    if (cell % 3 != 0) continue;
    const std::string command = row.substr(row.rfind(',') + 1);
    ASSERT_EQ(command, "tandem-netsim sweep --cells " + cells + " --cell " + std::to_string(cell));
    std::istringstream text(command);
    std::string program;
    text >> program;
    test::Words words{TANDEM_NETSIM};
    for (std::string word; text >> word;) words.push_back(word);
    words.insert(words.end(), {"--csv", "-", "--quiet"});
    Process alone(words);
    ASSERT_EQ(ended(alone), 0) << alone.err();
    EXPECT_EQ(alone.out(), head + "\n" + row + "\n");
  }
}

TEST(SweepCells, ContinuesAfterAnInterruptWithTheBytesOfAnUninterruptedRun) {
  const Folder folder;
  const std::string cells = folder.write("c.textproto", kManyCells);
  Process first =
      sweep({"--cells", cells, "--resume", folder.file("done"), "--jobs", "1", "--csv", folder.file("part.csv")});
  wait_for_lines(folder, "done", 3);
  first.signal(SIGINT);
  EXPECT_EQ(ended(first), 1);
  for (const char* part : {"tandem-netsim sweep: interrupted after ", " of 60 cells by Ctrl-C",
                           "The results so far are reported and do not count as a pass", "the same command continues"})
    EXPECT_NE(first.err().find(part), std::string::npos) << part << " not in\n" << first.err();
  const std::string part = folder.read("part.csv"), done = folder.read("done");
  EXPECT_EQ(std::count(part.begin(), part.end(), '\n'), std::count(done.begin(), done.end(), '\n'))
      << "one row for each finished cell";

  Process second = sweep({"--cells", cells, "--resume", folder.file("done"), "--jobs", "1"});
  wait_for_lines(folder, "done", std::count(done.begin(), done.end(), '\n') + 2);
  second.signal(SIGKILL);
  EXPECT_EQ(ended(second), -SIGKILL);
  EXPECT_TRUE(folder.read("done").starts_with(done)) << "no finished cell is lost or computed again";

  ASSERT_EQ(run_to(folder, cells, "resumed", {"--resume", folder.file("done")}), 0);
  ASSERT_EQ(run_to(folder, cells, "whole"), 0);
  EXPECT_EQ(folder.read("resumed.csv"), folder.read("whole.csv"));
  EXPECT_EQ(folder.read("resumed.html"), folder.read("whole.html"));
  const std::string finished = folder.read("done");
  EXPECT_EQ(std::count(finished.begin(), finished.end(), '\n'), 61);

  ASSERT_EQ(run_to(folder, cells, "again", {"--resume", folder.file("done")}), 0) << "nothing is left to run";
  EXPECT_EQ(folder.read("again.html"), folder.read("whole.html"));
  EXPECT_EQ(folder.read("done"), finished);
}

TEST(SweepCells, RejectsResultsOfOtherCells) {
  const Folder folder;
  const std::string cells = folder.write("c.textproto", kCells);
  ASSERT_EQ(run_to(folder, cells, "a", {"--resume", folder.file("done")}), 0);
  const std::string before = folder.read("done");
  std::string other = kCells;
  other.replace(other.find("loss_percent: 20"), 16, "loss_percent: 21");
  Process process = sweep({"--cells", folder.write("c.textproto", other), "--resume", folder.file("done")});
  EXPECT_EQ(ended(process), 2);
  EXPECT_NE(process.err().find("has results of other cells, which are not comparable"), std::string::npos)
      << process.err();
  EXPECT_EQ(folder.read("done"), before);
}

TEST(SweepCells, EndsWithAMessageWhenTheDiskIsFull) {
  const Folder folder;
  const std::string cells = folder.write("c.textproto", kCells);
  Process report = sweep({"--cells", cells, "--csv", "/dev/full", "--quiet"});
  EXPECT_EQ(ended(report), 1);
  EXPECT_NE(report.err().find("the disk is full"), std::string::npos) << report.err();
  // Two blocks of 512 bytes: the first line and two or three cells.
  Process kept({"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 2; exec \"$0\" sweep --cells \"$1\" --resume \"$2\" --jobs 1",
                TANDEM_NETSIM, cells, folder.file("done")});
  EXPECT_EQ(ended(kept), 1);
  EXPECT_NE(kept.err().find("the file would be larger than allowed here"), std::string::npos) << kept.err();
  ASSERT_EQ(run_to(folder, cells, "resumed", {"--resume", folder.file("done")}), 0);
  ASSERT_EQ(run_to(folder, cells, "whole"), 0);
  EXPECT_EQ(folder.read("resumed.csv"), folder.read("whole.csv"));
}

TEST(SweepCells, ListsTheShippedFiles) {
  Process list = sweep({"--list"});
  EXPECT_EQ(ended(list), 0);
  EXPECT_TRUE(list.out().starts_with("comparison")) << list.out();
  EXPECT_NE(list.out().find(" 2000 cells "), std::string::npos) << list.out();
  EXPECT_NE(list.out().find("\nlaws"), std::string::npos) << list.out();
}

TEST(SweepCells, ReportsErrorsAndStartsNothing) {
  const Folder folder;
  const std::string cells = folder.write("c.textproto", kCells);
  const std::string pair =
      folder.write("pair.textproto",
                   "version: 1 scene: \"contact\" seeds: 1 grid { name: \"a\" law: WAVE coupling: CLC task: FREE }");
  const std::string three = folder.write(
      "three.textproto",
      "version: 1 scene: \"contact\" seeds: 1\ngrid { name: \"a\" law: PD coupling: CLC hands: 3 task: FREE }");
  for (const auto& [arguments, part] : std::vector<std::pair<test::Words, std::string>>{
           {{}, "name a scene, or a file of cells by --cells"},
           {{"--cells", "comparisn"}, "did you mean comparison?"},
           {{"--cells", folder.file("none.textproto")}, "none.textproto"},
           {{"--cells", pair}, "wave + clc with 2 hands: channel.coupling couples hands by positions"},
           {{"--cells", three}, "three.textproto:2:"},
           {{"--cells", three}, "has equations for two hands; the scene has 3 MASTER seats"},
           {{"--cells", folder.write("bad.textproto", "version: 1 scen: \"x\"")}, "did you mean scene?"},
           {{"--cells", folder.write("no.textproto",
                                     "version: 1 scene: \"contac\" seeds: 1 grid { name: \"a\" law: PD "
                                     "task: FREE }")},
            "did you mean contact?"},
           {{"--cells", cells, "--cell", "11"}, "--cell: 11 is out of range: "},
           {{"--cells", cells, "--delay", "0,20"}, "--delay: is for a map of one scene"},
           {{"one_axis", "--cells", cells}, "scene: is for a map of one scene"},
           {{"--cells", cells, "--json", "-"}, "--json: is for a map of one scene"},
           {{"--cells", cells, "--cell", "1", "--html", "-"}, "--html: is for all cells"},
           {{"one_axis", "--delay", "0", "--html", "-"}, "--html: is for a file of cells"},
           {{"--cells", cells, "--csv", folder.file("x"), "--html", folder.file("x")}, "is the same file as --csv"},
           {{"--cells", cells, "--html", "/no/such/x.html"}, "cannot be written"}}) {
    Process process = sweep(arguments);
    EXPECT_EQ(ended(process), 2) << part;
    EXPECT_NE(process.err().find(part), std::string::npos) << part << " not in: " << process.err();
  }
}

}  // namespace
}  // namespace tandem
