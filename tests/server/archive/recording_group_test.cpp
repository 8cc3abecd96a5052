// Files of long recordings in the index: which belong together, what is missing, and what they are together.
#include "server/archive/recording_group.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/archive/recording_text.h"

namespace tandem::server {
namespace {

constexpr std::int64_t kBegin = 1'700'000'000'000'000'000;
constexpr std::int64_t kMinute = 60'000'000'000;

/// Part `number` of a recording, each of ten minutes.
RecordingRow part(const std::string& file, unsigned number, std::optional<bool> last, const std::string& name = "lab") {
  RecordingRow row;
  row.file = file;
  row.bytes = 1'000'000;
  row.summary.session = "lesson";
  row.summary.start_unix_ns = kBegin + (number - 1) * 10 * kMinute;
  row.summary.duration_s = 600;
  row.summary.rows = 600'000;
  row.summary.part = {.file = "",
                      .session_id = "5",
                      .epoch = "1",
                      .recording = name,
                      .number = number,
                      .last = last,
                      .previous_file = ""};
  return row;
}

std::vector<RecordingRow> folder() {
  std::vector<RecordingRow> rows{part("lab-2.mcap", 2, false), part("lab-3.mcap", 3, true), part("lab.mcap", 1, false),
                                 part("old/lab-2.mcap", 2, true), part("other.mcap", 1, true, "other")};
  RecordingRow alone;
  alone.file = "alone.mcap";
  rows.push_back(alone);
  alone.file = "damaged.mcap";
  alone.problem = "it is no MCAP file";
  rows.push_back(alone);
  return rows;
}

TEST(RecordingGroups, HaveTheFilesOfOneRecordingInTheirOrder) {
  const auto groups = group_recordings(folder());
  ASSERT_EQ(groups.size(), 5u);
  EXPECT_EQ(groups[0].rows, (std::vector<std::size_t>{2, 0, 1}));
  EXPECT_EQ(groups[0].problem, "");
  EXPECT_EQ(groups[1].rows, (std::vector<std::size_t>{3})) << "another folder";
  EXPECT_EQ(groups[1].problem.find("part 1 of the recording is missing: old/lab-2.mcap is part 2"), 0u)
      << groups[1].problem;
  for (std::size_t k = 2; k < 5; ++k) {
    EXPECT_EQ(groups[k].rows.size(), 1u);
    EXPECT_EQ(groups[k].problem, "");
  }
}

TEST(RecordingGroups, KeepCopiesApart) {
  const std::vector<RecordingRow> rows{part("a.mcap", 1, false), part("b.mcap", 2, true),
                                       part("copy of a.mcap", 1, false), part("copy of b.mcap", 2, true),
                                       part("third a.mcap", 1, false)};
  const auto groups = group_recordings(rows);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].rows, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(groups[1].rows, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(groups[0].problem + groups[1].problem, "");
  EXPECT_NE(groups[2].problem.find("part 2 of the recording is missing"), std::string::npos);
}

TEST(RecordingGroups, AreOneRecordingTogether) {
  auto rows = folder();
  rows[0].summary.missing_ticks = 7;
  rows[1].summary.persons = {{"Ada", "trainee"}};
  rows[2].summary.persons = {{"Bob", "trainee"}, {"Ada", "trainee"}};
  auto group = group_recordings(rows)[0];
  RecordingRow all = joined_row(rows, group);
  EXPECT_EQ(all.file, "lab.mcap");
  EXPECT_EQ(all.bytes, 3'000'000u);
  EXPECT_EQ(all.summary.rows, 1'800'000u);
  EXPECT_EQ(all.summary.missing_ticks, 7u);
  EXPECT_DOUBLE_EQ(all.summary.duration_s, 1800);
  EXPECT_TRUE(all.summary.complete);
  EXPECT_EQ(all.summary.persons, (std::vector<RecordedPerson>{{"Bob", "trainee"}, {"Ada", "trainee"}}));
  for (const std::size_t k : {0u, 1u, 2u}) rows[k].summary.start_unix_ns = 0;  // in virtual time
  EXPECT_DOUBLE_EQ(joined_row(rows, group).summary.duration_s, 1800);
  rows[1].summary.complete = false;
  EXPECT_FALSE(joined_row(rows, group).summary.complete);
  rows[1].summary.complete = true;
  group.rows = {2, 1};
  group.problem = "part 2 is missing";
  EXPECT_FALSE(joined_row(rows, group).summary.complete);
}

TEST(RecordingGroups, StandTogetherInTheTable) {
  const auto rows = folder();
  const std::string text = recordings_text(rows);
  const auto first = text.find("lab.mcap "), second = text.find("lab-2.mcap "), third = text.find("lab-3.mcap ");
  EXPECT_LT(first, second) << text;
  EXPECT_LT(second, third) << text;
  EXPECT_NE(text.find("(part 3)"), std::string::npos) << text;
  EXPECT_NE(text.find("4 recordings, 6 files, 5.0 MB; files that cannot be read: 1"), std::string::npos) << text;
  EXPECT_NE(text.find("\npart 1 of the recording is missing: old/lab-2.mcap is part 2"), std::string::npos) << text;
  EXPECT_EQ(recordings_text({rows[0]}, false).find("is missing"), std::string::npos) << "a choice of files";
  const auto json = nlohmann::json::parse(recordings_json(rows));
  EXPECT_EQ(json[1]["recording"], "lab");
  EXPECT_EQ(json[1]["part"], 3);
  EXPECT_EQ(json[1]["last_part"], true);
  EXPECT_TRUE(json[5]["recording"].is_null());
  const std::string one = recording_text(rows[0], {"lab.mcap", "lab-2.mcap"}, "part 3 is missing");
  EXPECT_NE(one.find("part      2 of a recording of 2 files: lab.mcap lab-2.mcap\nmissing   part 3 is missing\n"),
            std::string::npos)
      << one;
}

TEST(RecordingGroups, AreRetainedWhole) {
  std::vector<RecordingRow> rows = folder();  // six readable files of 1 MB or nothing
  const std::int64_t end = kBegin + 40 * kMinute;
  for (RecordingRow& row : rows) row.modified_ns = end;
  rows[4].summary.start_unix_ns = kBegin + 60 * kMinute;  // other.mcap is newer than lab
  rows[3].summary.start_unix_ns = kBegin + 61 * kMinute;
  rows[5].summary.start_unix_ns = kBegin + 62 * kMinute;
  EXPECT_EQ(files_beyond_limits(rows, {}, {.days = 0, .bytes = 4'900'000}, end), (std::vector<std::size_t>{2, 0, 1}))
      << "one byte too much costs the oldest recording with all of its three files";
  EXPECT_TRUE(files_beyond_limits(rows, {}, {.days = 0, .bytes = 5'000'000}, end).empty());
}

TEST(RecordingGroups, AreAsOldAsTheirBegin) {
  const std::vector<RecordingRow> rows{part("lab.mcap", 1, false), part("lab-2.mcap", 2, true)};
  const std::int64_t begin_too_old = kBegin + 24 * 60 * kMinute + kMinute;  // part 2 began ten minutes later
  EXPECT_EQ(files_beyond_limits(rows, {}, {.days = 1, .bytes = 0}, begin_too_old), (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(files_beyond_limits(rows, {}, {.days = 1, .bytes = 0}, begin_too_old - 2 * kMinute).empty());
}

TEST(RecordingGroups, ThatStillGrowAreKept) {
  std::vector<RecordingRow> rows{part("a/lab.mcap", 1, false), part("a/lab-2.mcap", 2, false),
                                 part("a/other.mcap", 1, true, "other")};
  const std::int64_t late = kBegin + 1000 * 24 * 60 * kMinute;
  const auto chosen = [&](const std::vector<std::string>& unfinished) {
    return files_beyond_limits(rows, unfinished, {.days = 1, .bytes = 0}, late);
  };
  EXPECT_EQ(chosen({"a/lab-3.mcap.part"}), (std::vector<std::size_t>{2}));
  EXPECT_EQ(chosen({"b/lab-3.mcap.part", "a/lab-2.mcap.part"}), (std::vector<std::size_t>{0, 1, 2}))
      << "neither of them is the next file of the recording";
  EXPECT_EQ(chosen({"a/other-2.mcap.part"}), (std::vector<std::size_t>{0, 1, 2})) << "other.mcap was the last part";
  rows.pop_back();
  rows.pop_back();
  EXPECT_TRUE(chosen({"a/lab-2.mcap.part"}).empty());
}

// A recording leaves out the names that other files have.
TEST(RecordingGroups, ThatGrowBehindATakenNameAreKept) {
  std::vector<RecordingRow> rows{part("lab.mcap", 1, false)};
  const auto chosen = [&](const std::vector<std::string>& unfinished) {
    return files_beyond_limits(rows, unfinished, {.days = 1, .bytes = 0}, kBegin + 1000 * 24 * 60 * kMinute);
  };
  EXPECT_TRUE(chosen({"lab-3.mcap.part"}).empty());
  EXPECT_EQ(chosen({"lab-x.mcap.part", "labs-3.mcap.part"}), std::vector<std::size_t>{0}) << "of other recordings";
  rows.push_back(part("lab-3.mcap", 2, false));
  EXPECT_TRUE(chosen({"lab-4.mcap.part"}).empty());
  EXPECT_EQ(chosen({"lab-2.mcap.part"}), (std::vector<std::size_t>{0, 1})) << "it is before the last one";
}

TEST(RecordingGroups, LackNoPartThatIsBeingRecorded) {
  std::vector<RecordingRow> rows{part("a/lab.mcap", 1, false), part("a/lab-2.mcap", 2, false)};
  const auto group = [&](const std::vector<std::string>& unfinished) { return group_recordings(rows, unfinished)[0]; };
  EXPECT_EQ(group({"a/lab-3.mcap.part"}).problem, "");
  EXPECT_TRUE(group({"a/lab-3.mcap.part"}).grows);
  EXPECT_TRUE(group({"a/lab-4.mcap.part"}).grows) << "another file may have had the name a/lab-3.mcap";
  EXPECT_NE(group({}).problem.find("part 3 of the recording is missing"), std::string::npos);
  EXPECT_FALSE(group({"b/lab-3.mcap.part"}).grows);
  const std::string text = recordings_text(rows, true, {"a/lab-3.mcap.part"});
  EXPECT_EQ(text.find("missing"), std::string::npos) << text;
  EXPECT_NE(text.find("a/lab-2.mcap: the next part of this recording is not closed yet"), std::string::npos) << text;
  rows.erase(rows.begin());  // an earlier part is missing all the same
  EXPECT_NE(group({"a/lab-3.mcap.part"}).problem.find("part 1 of the recording is missing"), std::string::npos);
}

TEST(RecordingGroups, AreDeletedFromTheirEnd) {
  const std::vector<RecordingRow> rows = folder();
  EXPECT_EQ(deletion_order(rows, {4, 2, 0, 1}), (std::vector<std::vector<std::size_t>>{{4}, {1, 0, 2}}))
      << "part 3, part 2, part 1";
  EXPECT_EQ(deletion_order(rows, {0, 6}), (std::vector<std::vector<std::size_t>>{{0}, {6}}));
}

}  // namespace
}  // namespace tandem::server
