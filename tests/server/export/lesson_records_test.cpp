// Lessons as tick records: consistency, gaps, and the CSV that equals the trace of the same session.
#include "server/export/lesson_records.h"

#include <gtest/gtest.h>

#include <fstream>

#include "server/export/app/csv_export.h"
#include "server/export/lesson_signals.h"
#include "tests/io/programs.h"
#include "tests/support/lesson_run.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

constexpr auto kGoOn = [](double) { return true; };

/// Exports a lesson in memory.
std::string export_csv(const Lesson& lesson, const std::string& file, const ExportProgress& progress) {
  WholeLesson whole(lesson);
  return server::export_csv(whole, file, progress);
}

/// A lesson with rows at the given ticks and recognisable numbers.
Lesson lesson_at(const std::vector<std::uint32_t>& ticks) {
  Lesson lesson = test::empty_lesson(test::shipped("one_axis"));
  for (const std::uint32_t tick : ticks) {
    TickRecord record;
    record.tick = tick;
    record.running = true;
    record.seats[0].x = {tick + 0.25, 0, 0};
    record.seats[0].e_in[0] = 2'500'000'000;
    test::append_record(lesson, record);
  }
  return lesson;
}

TEST(LessonRecords, GiveTheBytesOfTheTraceOfTheSameSession) {
  for (const auto& [scene, seed] : {std::pair{"one_axis", 1u}, {"contact", 2u}, {"free_motion", 3u}}) {
    SCOPED_TRACE(scene);
    const test::LessonRun run = test::lesson_of(scene, 1.5, seed);
    ASSERT_GT(run.lesson.rows(), 1000u);
    const test::Folder folder;
    const std::string file = folder.file("lesson.csv");
    EXPECT_EQ(export_csv(run.lesson, file, kGoOn), "");
    EXPECT_TRUE(folder.read("lesson.csv") == run.trace) << "the files differ";
  }
}

TEST(LessonRecords, LeaveOutTicksInWhichTheClockStoodStill) {
  Lesson lesson = lesson_at({5, 6, 7});
  lesson.running[1] = 0;
  const test::Folder folder;
  EXPECT_EQ(export_csv(lesson, folder.file("a.csv"), kGoOn), "");
  const std::string text = folder.read("a.csv");
  EXPECT_EQ(std::ranges::count(text, '\n'), 3);
  EXPECT_NE(text.find("\n5,"), std::string::npos);
  EXPECT_EQ(text.find("\n6,"), std::string::npos);
}

TEST(LessonRecords, CountMissingTicksAsGaps) {
  EXPECT_TRUE(gaps_of(lesson_at({1, 2, 3})).empty());
  EXPECT_TRUE(gaps_of(lesson_at({7})).empty());
  const std::vector<LessonGap> expected{{3, 2}, {6, 94}};
  EXPECT_EQ(gaps_of(lesson_at({1, 2, 5, 100})), expected);
  const std::vector<LessonGap> widest{{1, 4294967294u}};
  EXPECT_EQ(gaps_of(lesson_at({0, 4294967295u})), widest);
}

TEST(LessonRecords, NameAColumnOfAnotherLength) {
  EXPECT_EQ(lesson_problem(lesson_at({1, 2})), "");
  EXPECT_NE(lesson_problem(lesson_at({})).find("no row"), std::string::npos);
  Lesson lesson = lesson_at({1, 2});
  lesson.seats[0].ghost.pop_back();
  EXPECT_EQ(lesson_problem(lesson), "column ghost of seat trainer has 1 values, the lesson has 2 rows");
  lesson = lesson_at({1, 2});
  lesson.tools[0].e_p_j.push_back(0);
  EXPECT_EQ(lesson_problem(lesson), "column e_p_j of tool tool has 3 values, the lesson has 2 rows");
  EXPECT_NE(lesson_problem(lesson_at({2, 2})).find("ticks must increase"), std::string::npos);
  lesson = lesson_at({1});
  lesson.tools.clear();
  EXPECT_NE(lesson_problem(lesson).find("0 tools"), std::string::npos);
  lesson.scene.seats.clear();
  EXPECT_NE(lesson_problem(lesson).find("no seat or no tool"), std::string::npos);
}

TEST(LessonSignals, AreInSiUnitsWithNamesForEveryNumber) {
  const Lesson lesson = lesson_at({250});
  std::size_t real = 0;
  for (const LessonSignal& signal : signals_of(lesson)) {
    SCOPED_TRACE(signal.group + "/" + signal.name);
    EXPECT_NE(static_cast<bool>(signal.real), static_cast<bool>(signal.whole));
    EXPECT_FALSE(signal.unit.empty() || signal.frame.empty() || signal.description.empty());
    if (!signal.real) continue;
    std::vector<double> values(signal.width());
    signal.real(0, values);
    ++real;
    if (signal.group == "session" && signal.name == "time") {
      EXPECT_EQ(values[0], 0.25);
      EXPECT_EQ(signal.unit, "s");
    } else if (signal.group == "seats/trainer" && signal.name == "measured_cp") {
      EXPECT_EQ(values[0], 250.25);
      EXPECT_EQ(signal.unit, "m");
      EXPECT_EQ(signal.columns, (std::vector<std::string>{"x", "y", "z"}));
    } else if (signal.group == "seats/trainer" && signal.name == "energy_in") {
      EXPECT_DOUBLE_EQ(values[0], 2.5);
      EXPECT_EQ(signal.unit, "J");
      EXPECT_EQ(signal.width(), lesson.scene.dof);
    }
  }
  EXPECT_GT(real, 20u);
}

TEST(PendingPath, LeavesNothingWhenAnExportIsInterrupted) {
  const test::LessonRun run = test::lesson_of("one_axis", 1);
  const test::Folder folder;
  EXPECT_EQ(export_csv(run.lesson, folder.file("a.csv"), [](double) { return false; }), kExportInterrupted);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

TEST(PendingPath, ReplacesAFileAndNoFolderWithFiles) {
  const test::Folder folder;
  const std::string file = folder.write("a.csv", "old");
  EXPECT_EQ(export_csv(lesson_at({1}), file, kGoOn), "");
  EXPECT_NE(folder.read("a.csv"), "old");
  EXPECT_EQ(PendingPath::problem(file, false, true), "");
  EXPECT_NE(PendingPath::problem(file, true, true).find("is no folder"), std::string::npos);
  EXPECT_NE(PendingPath::problem(folder.file(""), true, true).find("has files in it"), std::string::npos);
  EXPECT_NE(PendingPath::problem(folder.file(""), false, true).find("is a folder"), std::string::npos);
  EXPECT_NE(PendingPath::problem(folder.file("no/a.csv"), false, true).find("there is no folder"), std::string::npos);
  std::filesystem::create_directory(folder.file("empty"));
  EXPECT_EQ(PendingPath::problem(folder.file("empty/"), true, true), "");
}

TEST(PendingPath, ReportsAFullDisk) {
  // A link to /dev/full takes the place of the temporary file: the export writes through it.
  const test::Folder folder;
  const std::string file = folder.file("a.csv");
  std::filesystem::create_symlink("/dev/full", file + ".part-" + std::to_string(getpid()));
  const std::string problem = export_csv(test::lesson_of("one_axis", 1).lesson, file, kGoOn);
  EXPECT_NE(problem.find("the disk is full"), std::string::npos) << problem;
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

}  // namespace
}  // namespace tandem::server
