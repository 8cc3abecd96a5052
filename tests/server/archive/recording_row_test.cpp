// Summaries of recordings, and which recordings are beyond the limits of a school.
#include "server/archive/recording_row.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/archive/recording_text.h"
#include "tests/support/lesson_run.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

constexpr std::int64_t kDay = 86'400'000'000'000;
constexpr std::int64_t kNow = 20'000 * kDay;

RecordingRow row(const std::string& file, std::int64_t age_days, std::uint64_t bytes) {
  RecordingRow out;
  out.file = file;
  out.bytes = bytes;
  out.modified_ns = kNow;
  out.summary.start_unix_ns = kNow - age_days * kDay;
  return out;
}

using Chosen = std::vector<std::size_t>;

TEST(Retention, ChoosesWhatIsOlderThanTheLimit) {
  const std::vector<RecordingRow> rows{row("b", 3, 10), row("a", 40, 10), row("c", 31, 10), row("d", 30, 10)};
  EXPECT_EQ(beyond_limits(rows, {.days = 30}, kNow), (Chosen{1, 2})) << "oldest first; exactly 30 days stay";
  EXPECT_EQ(beyond_limits(rows, {.days = 100}, kNow), Chosen{});
  EXPECT_EQ(beyond_limits(rows, {}, kNow), Chosen{}) << "without limits nothing is chosen";
}

TEST(Retention, ChoosesTheOldestUntilTheRestIsSmallEnough) {
  const std::vector<RecordingRow> rows{row("b", 3, 10), row("a", 40, 10), row("c", 31, 10), row("d", 30, 10)};
  EXPECT_EQ(beyond_limits(rows, {.bytes = 40}, kNow), Chosen{}) << "exactly the limit stays";
  EXPECT_EQ(beyond_limits(rows, {.bytes = 39}, kNow), (Chosen{1}));
  EXPECT_EQ(beyond_limits(rows, {.bytes = 20}, kNow), (Chosen{1, 2}));
  EXPECT_EQ(beyond_limits(rows, {.bytes = 1}, kNow), (Chosen{1, 2, 3, 0}));
  EXPECT_EQ(beyond_limits(rows, {.days = 30.5, .bytes = 39}, kNow), (Chosen{1, 2})) << "either limit chooses";
}

TEST(Retention, LeavesFilesThatCannotBeRead) {
  std::vector<RecordingRow> rows{row("damaged", 900, 1000), row("a", 40, 10)};
  rows[0].problem = "it is no MCAP file";
  EXPECT_EQ(beyond_limits(rows, {.days = 30, .bytes = 10}, kNow), (Chosen{1}));
  EXPECT_EQ(beyond_limits(rows, {.bytes = 10}, kNow), Chosen{}) << "their bytes do not count";
}

TEST(Retention, UsesTheLastChangeWhereTheBeginIsUnknown) {
  std::vector<RecordingRow> rows{row("a", 40, 10)};
  rows[0].summary.start_unix_ns = 0;
  EXPECT_EQ(beyond_limits(rows, {.days = 30}, kNow), Chosen{});
  rows[0].modified_ns = kNow - 31 * kDay;
  EXPECT_EQ(beyond_limits(rows, {.days = 30}, kNow), (Chosen{0}));
}

TEST(Summary, HasEveryPersonOfSeatsAndNotesOnce) {
  Lesson lesson = test::empty_lesson(test::shipped("free_motion"));
  for (const std::uint32_t tick : {100u, 101u, 103u}) {
    TickRecord record;
    record.tick = tick;
    test::append_record(lesson, record);
  }
  lesson.seats[0].person = "Ada";
  lesson.marks = {{1, "Ada", "x"}, {2, "Bob", "y"}, {3, "Bob", "z"}};
  lesson.sheets = {{"OSATS", "trainee", "Eve", {}, true}};
  const RecordingSummary summary = summary_of(lesson);
  const std::vector<RecordedPerson> expected{
      {"Ada", lesson.scene.seats[0].name}, {"Ada", "notes"}, {"Bob", "notes"}, {"Eve", "notes"}};
  EXPECT_EQ(summary.persons, expected);
  EXPECT_EQ(summary.rows, 3u);
  EXPECT_EQ(summary.missing_ticks, 1u);
  EXPECT_DOUBLE_EQ(summary.duration_s, 0.003);
  std::vector<RecordingRow> rows{row("a", 1, 1), row("b", 1, 1)};
  rows[1].summary = summary;
  EXPECT_EQ(recordings_with(rows, "Eve"), (Chosen{1}));
  EXPECT_EQ(recordings_with(rows, "eve"), Chosen{}) << "another name";
}

TEST(Summary, BeginsWithTheFirstRowAndNotWithTheSession) {
  Lesson lesson = test::empty_lesson(test::shipped("free_motion"));
  for (const std::uint32_t tick : {60'000u, 60'001u}) {
    TickRecord record;
    record.tick = tick;
    record.time_ns = std::int64_t{1'000'000} * tick;
    test::append_record(lesson, record);
  }
  lesson.start_unix_ns = 0;
  EXPECT_EQ(summary_of(lesson).start_unix_ns, 0) << "the wall clock is unknown";
  lesson.start_unix_ns = kNow;
  EXPECT_EQ(summary_of(lesson).start_unix_ns, kNow + 60'000'000'000) << "an order began it after a minute";
}

TEST(Summary, CountsTicksThatAFullDiskCost) {
  Lesson lesson = test::empty_lesson(test::shipped("free_motion"));
  for (const std::uint32_t tick : {100u, 101u, 105u}) {
    TickRecord record;
    record.tick = tick;
    test::append_record(lesson, record);
  }
  EXPECT_EQ(summary_of(lesson).missing_ticks, 3u) << "the rows alone";
  // The disk stayed full after the last row: only the account has those ticks.
  lesson.counts["/authority"] = {.recorded = 3, .dropped = 503, .never_received = 0};
  lesson.counts["/seat"] = {.recorded = 3, .dropped = 2, .never_received = 1};
  EXPECT_EQ(summary_of(lesson).missing_ticks, 503u);
  lesson.counts["/authority"].dropped = 1;
  EXPECT_EQ(summary_of(lesson).missing_ticks, 3u) << "never fewer than the rows show";
}

TEST(RecordingText, NamesPersonsAndSkippedFilesSafely) {
  std::vector<RecordingRow> rows{row("good.mcap", 1, 2'500'000), row("bad\x1b[2J.mcap", 1, 7)};
  rows[0].summary.session = "lesson";
  rows[0].summary.persons = {{"Ada\nByron", "trainee"}};
  rows[1].problem = "it is no MCAP file";
  const std::string text = recordings_text(rows);
  EXPECT_NE(text.find("Ada\\x0aByron (trainee)"), std::string::npos) << text;
  EXPECT_NE(text.find("bad\\x1b[2J.mcap: skipped, it is no MCAP file"), std::string::npos) << text;
  EXPECT_NE(text.find("1 recording, 2.5 MB"), std::string::npos) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(text.find("(no tick: the session did not run)"), std::string::npos) << text;
  rows[0].summary.rows = 1;
  EXPECT_EQ(recordings_text(rows).find("no tick"), std::string::npos);
  const auto json = nlohmann::json::parse(recordings_json(rows));
  EXPECT_EQ(json[0]["persons"][0]["name"], "Ada\nByron");
  EXPECT_TRUE(json[0]["problem"].is_null());
  EXPECT_EQ(json[1]["problem"], "it is no MCAP file");
  EXPECT_NE(recording_text(rows[0]).find("persons   Ada"), std::string::npos);
}

TEST(RecordingText, SaysAlikeThatTheBeginIsNotStated) {
  std::vector<RecordingRow> rows{row("virtual.mcap", 1, 100)};
  rows[0].summary.start_unix_ns = 0;
  rows[0].modified_ns = std::int64_t{1'700'000'000'000'000'000};  // 2023-11-14 22:13 UTC
  EXPECT_NE(recordings_text(rows).find("virtual.mcap        not stated"), std::string::npos) << recordings_text(rows);
  EXPECT_NE(recording_text(rows[0]).find("begin     not stated\n"), std::string::npos) << recording_text(rows[0]);
  rows[0].summary.start_unix_ns = rows[0].modified_ns;
  EXPECT_NE(recordings_text(rows).find("virtual.mcap  2023-11-14 22:13"), std::string::npos) << recordings_text(rows);
  EXPECT_NE(recording_text(rows[0]).find("begin     2023-11-14 22:13 UTC\n"), std::string::npos);
}

}  // namespace
}  // namespace tandem::server
