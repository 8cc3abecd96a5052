// Exports of lessons whose rows come in pieces: the same as of the whole lesson, wherever the pieces end.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "common/base/rng.h"
#include "proto/recording/lesson_columns.h"
#include "proto/text/scene_bytes.h"
#include "server/export/app/csv_export.h"
#include "server/export/app/lerobot_export.h"
#include "server/export/io/hdf5_export.h"
#include "server/export/io/hdf5_import.h"
#include "server/export/lesson_records.h"
#include "server/export/lesson_signals.h"
#include "tests/common/base/counts.h"
#include "tests/io/programs.h"
#include "tests/support/lesson_run.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;

constexpr auto kProceed = [](double) { return true; };

/// A lesson in pieces of random lengths.
class RandomPieces final : public LessonSource {
 public:
  RandomPieces(const Lesson& lesson, std::uint64_t seed, std::size_t rows_max)
      : lesson_(&lesson), random_{seed}, rows_max_(rows_max), head_(lesson) {
    rec::erase_rows(head_, lesson.rows());
  }
  [[nodiscard]] const Lesson& head() const override { return head_; }
  [[nodiscard]] LessonExtent extent() const override { return extent_of(*lesson_); }
  [[nodiscard]] std::expected<const Lesson*, std::string> next() override {
    if (at_ == fail_at_) return std::unexpected("a.mcap: was changed");
    if (at_ == lesson_->rows()) return nullptr;
    const std::size_t count = std::min(1 + random_.below(rows_max_), lesson_->rows() - at_);
    piece_ = head_;
    rec::copy_rows(*lesson_, std::exchange(at_, at_ + count), count, piece_);
    if (fail_at_ && at_ > *fail_at_) at_ = *fail_at_;
    return &piece_;
  }
  /// Rows can no longer be read from here on.
  void fail_at(std::size_t row) { fail_at_ = row; }

 private:
  const Lesson* lesson_;
  RandomStream random_;
  std::size_t rows_max_, at_ = 0;
  std::optional<std::size_t> fail_at_;
  Lesson head_, piece_;
};

/// A lesson of some seconds with random gaps, one of them longer than a frame of a data set.
Lesson with_gaps(const std::string& scene, std::uint64_t seed) {
  Lesson lesson = test::lesson_of(scene, 1.5, seed).lesson;
  lesson.scene_text = scene_file_text(lesson.scene);
  RandomStream random{seed};
  for (const std::uint32_t gap : {1u, 7u, 75u}) {
    const std::size_t begin = 1 + random.below(lesson.rows() - 1);
    for (std::size_t k = begin; k < lesson.rows(); ++k) lesson.tick[k] += gap;
  }
  return lesson;
}

std::size_t piece_rows(std::uint64_t seed) { return seed % 3 == 0 ? 1 + seed : 37 * seed; }

TEST(ExportPieces, GiveTheBytesOfCsvOfTheWholeLesson) {
  for (std::uint64_t seed = 1; seed <= test::seeds(8); ++seed) {
    SCOPED_TRACE(seed);
    const Lesson lesson = with_gaps(seed % 2 == 0 ? "contact" : "one_axis", seed);
    const test::Folder folder;
    WholeLesson whole(lesson);
    RandomPieces pieces(lesson, seed, piece_rows(seed));
    ASSERT_EQ(export_csv(whole, folder.file("whole.csv"), kProceed), "");
    ASSERT_EQ(export_csv(pieces, folder.file("pieces.csv"), kProceed), "");
    EXPECT_TRUE(folder.read("whole.csv") == folder.read("pieces.csv"));
  }
}

/// Expects equal numbers in all signals; NaN equals NaN.
void expect_equal_signals(const Lesson& a, const Lesson& b) {
  ASSERT_EQ(a.rows(), b.rows());
  const auto left = signals_of(a), right = signals_of(b);
  ASSERT_EQ(left.size(), right.size());
  std::size_t different = 0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    std::vector<double> x(left[k].width()), y(left[k].width());
    std::vector<std::int64_t> m(left[k].width()), n(left[k].width());
    for (std::size_t row = 0; row < a.rows(); ++row)
      if (left[k].real) {
        left[k].real(row, x);
        right[k].real(row, y);
        for (std::size_t c = 0; c < x.size(); ++c)
          if (!(x[c] == y[c] || (std::isnan(x[c]) && std::isnan(y[c])))) ++different;
      } else {
        left[k].whole(row, m);
        right[k].whole(row, n);
        if (m != n) ++different;
      }
    EXPECT_EQ(different, 0u) << left[k].group << "/" << left[k].name;
  }
}

TEST(ExportPieces, GiveTheNumbersOfHdf5OfTheWholeLesson) {
  const test::Folder folder;
  for (std::uint64_t seed = 1; seed <= test::seeds(4); ++seed) {
    SCOPED_TRACE(seed);
    const Lesson lesson = with_gaps(seed % 2 == 0 ? "contact" : "two_by_two", seed);
    WholeLesson whole(lesson);
    RandomPieces pieces(lesson, seed, piece_rows(seed));
    const std::string problem = export_hdf5(whole, folder.file("whole.h5"), kProceed);
    if (problem.find("apt install") != std::string::npos) GTEST_SKIP() << problem;
    ASSERT_EQ(problem, "");
    ASSERT_EQ(export_hdf5(pieces, folder.file("pieces.h5"), kProceed), "");
    const auto a = import_hdf5(folder.file("whole.h5")), b = import_hdf5(folder.file("pieces.h5"));
    ASSERT_TRUE(a) << a.error();
    ASSERT_TRUE(b) << b.error();
    expect_equal_signals(*a, *b);
    expect_equal_signals(*b, lesson);
    EXPECT_EQ(gaps_of(*b), gaps_of(lesson));
    fs::remove(folder.file("whole.h5"));
    fs::remove(folder.file("pieces.h5"));
  }
}

TEST(ExportPieces, GiveTheBytesOfADataSetOfTheWholeLesson) {
  test::Process probe({"/bin/sh", "-c", "command -v node"});
  if (probe.wait() != 0) GTEST_SKIP() << "Node.js is not installed (apt install nodejs)";
  for (const LerobotVersion version : {LerobotVersion::k21, LerobotVersion::k30})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(seed);
      const Lesson lesson = with_gaps("free_motion", seed);
      const test::Folder folder;
      LerobotRequest request;
      request.version = version;
      request.episodes = 2;
      for (const bool whole : {true, false}) {
        request.lesson = [&](std::size_t episode) -> std::expected<std::unique_ptr<LessonSource>, std::string> {
          if (whole) return std::make_unique<WholeLesson>(lesson);
          return std::make_unique<RandomPieces>(lesson, seed + episode, piece_rows(seed));
        };
        ASSERT_EQ(export_lerobot(request, folder.file(whole ? "whole" : "pieces"), kProceed), "");
      }
      std::size_t files = 0;
      for (const auto& entry : fs::recursive_directory_iterator(folder.file("whole"))) {
        if (!entry.is_regular_file()) continue;
        const std::string name = entry.path().lexically_relative(folder.file("whole")).string();
        EXPECT_TRUE(folder.read("whole/" + name) == folder.read("pieces/" + name)) << name;
        ++files;
      }
      EXPECT_GE(files, 5u);
    }
}

TEST(ExportPieces, LeaveNothingWhenRowsCanNoLongerBeRead) {
  const Lesson lesson = with_gaps("one_axis", 1);
  const test::Folder folder;
  RandomPieces csv(lesson, 1, 100), hdf5(lesson, 1, 100);
  csv.fail_at(700);
  hdf5.fail_at(700);
  EXPECT_EQ(export_csv(csv, folder.file("a.csv"), kProceed), "a.mcap: was changed");
  const std::string problem = export_hdf5(hdf5, folder.file("a.h5"), kProceed);
  EXPECT_TRUE(problem == "a.mcap: was changed" || problem.find("apt install") != std::string::npos) << problem;
  EXPECT_TRUE(fs::is_empty(folder.file("")));
}

}  // namespace
}  // namespace tandem::server
