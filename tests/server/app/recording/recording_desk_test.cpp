// Contributions of other threads to a recording, and pseudonyms.
#include "server/app/recording/recording_desk.h"

#include <gtest/gtest.h>

namespace tandem::server {
namespace {

SessionNote note(rpc::NoteKind kind, const std::string& json, const std::string& workstation = "desk-2",
                 const std::string& person = "") {
  return {.session = "lab",
          .workstation = workstation,
          .person = person,
          .role = AccessRole::kEvaluator,
          .tick = 1234,
          .time_s = 1.25,
          .kind = kind,
          .json = json};
}
SessionNote mark(const std::string& json, const std::string& workstation = "desk-2", const std::string& person = "") {
  return note(rpc::NoteKind::kMark, json, workstation, person);
}
SessionNote sheet(const std::string& json) { return note(rpc::NoteKind::kSheet, json); }

struct Desk {
  explicit Desk(bool pseudonyms) : desk(3, pseudonyms) { number = desk.begin(rpc::StatusRecording{.by_server = true}); }
  RecordingDesk::Items take() { return desk.take(number); }
  RecordingDesk desk;
  std::uint32_t number = 0;
};

TEST(RecordingDesk, PassesEventsMarksAndSheetsToTheRecording) {
  Desk d(false);
  d.desk.add_event({7, 7'000'000, "join", "trainer", "trainer tick 7"});
  d.desk.add_note(mark(R"({"t": 2.5, "text": "good grip", "person": "ann"})"));
  d.desk.add_note(mark(R"({"t": null, "text": "no name"})"));
  d.desk.add_note(mark(R"({"text": "named", "person": "typed"})", "desk-2", "otto"));
  d.desk.add_note(sheet(
      R"({"sheet": "GOALS", "of": "trainee", "person": "eva", "scores": {"depth": 4, "x": "no"}, "closed": true})"));
  const RecordingDesk::Items items = d.take();
  ASSERT_EQ(items.events.size(), 1u);
  EXPECT_EQ(items.events[0].what, "join");
  ASSERT_EQ(items.marks.size(), 3u);
  EXPECT_EQ(items.marks[0].t_s, 2.5);
  EXPECT_EQ(items.marks[0].by, "ann");
  EXPECT_EQ(items.marks[0].text, "good grip");
  EXPECT_EQ(items.marks[1].t_s, 1.25) << "without a time of its own, that of the session";
  EXPECT_EQ(items.marks[1].by, "desk-2");
  EXPECT_EQ(items.marks[2].by, "otto") << "the name in the ticket comes first";
  ASSERT_EQ(items.sheets.size(), 1u);
  EXPECT_EQ(items.sheets[0].of, "trainee");
  EXPECT_EQ(items.sheets[0].by, "eva");
  EXPECT_EQ(items.sheets[0].scores, (std::map<std::string, int>{{"depth", 4}}));
  EXPECT_TRUE(items.sheets[0].closed);
  EXPECT_TRUE(d.take().marks.empty());
}

TEST(RecordingDesk, ReplacesAllNamesByPseudonyms) {
  Desk d(true);
  d.desk.set_person(1, "ann");
  d.desk.set_person(0, "bob");
  d.desk.set_person(2, "ann");
  d.desk.set_person(3, "beyond the seats");
  EXPECT_EQ(d.desk.persons(), (std::vector<std::string>{"P2", "P1", "P1"}));
  EXPECT_EQ(d.desk.workstations(), (std::vector<bool>{false, false, false}));
  d.desk.set_person(2, "", "local");
  EXPECT_EQ(d.desk.persons()[2], "P3");
  d.desk.set_person(1, "ann", "local");
  EXPECT_EQ(d.desk.workstations(), (std::vector<bool>{false, false, true}));
  d.desk.add_note(mark(R"({"text": "x", "person": "ann"})"));
  d.desk.add_note(mark(R"({"text": "x", "person": "eva"})", "bob"));
  d.desk.add_note(mark(R"({"text": "x"})", "bob"));
  const RecordingDesk::Items items = d.take();
  ASSERT_EQ(items.marks.size(), 3u);
  EXPECT_EQ(items.marks[0].by, "P1");
  EXPECT_EQ(items.marks[1].by, "P4");
  EXPECT_EQ(items.marks[2].by, "P2");
}

TEST(RecordingDesk, NamesThePersonOfAnOrderInItsEvents) {
  for (const bool pseudonyms : {false, true}) {
    RecordingDesk desk(1, pseudonyms);
    const std::uint32_t number = desk.begin(rpc::StatusRecording{.by_server = true});
    desk.set_person(0, "ann");
    const std::uint32_t eva = desk.add_order("eva"), ann = desk.add_order("ann");
    EXPECT_NE(eva, 0u);
    EXPECT_NE(eva, ann);
    desk.add_event({1, 1, "stop", "", ""}, ann);
    desk.add_event({2, 2, "resume", "", ""}, eva);
    desk.add_event({3, 3, "authority", "", "timeline"});
    const auto events = desk.take(number).events;
    ASSERT_EQ(events.size(), 3u);
    EXPECT_EQ(events[0].person, pseudonyms ? "P1" : "ann") << "the name that the seat has";
    EXPECT_EQ(events[1].person, pseudonyms ? "P2" : "eva");
    EXPECT_EQ(events[2].person, "");
    for (std::size_t i = 0; i < RecordingDesk::kOrdersMax; ++i) static_cast<void>(desk.add_order("bob"));
    desk.add_event({4, 4, "stop", "", ""}, eva);
    EXPECT_EQ(desk.take(number).events[0].person, "")
        << "an order so long ago has no name, rather than that of another";
  }
}

TEST(RecordingDesk, TakesNothingWithoutARecordingAndCountsWhatDoesNotFit) {
  RecordingDesk desk(1, false);
  desk.add_event({1, 1, "stop", "", ""});
  desk.add_note(mark(R"({"text": "early"})"));
  const std::uint32_t number = desk.begin(rpc::StatusRecording{.by_server = true});
  EXPECT_TRUE(desk.take(number).events.empty());
  for (std::size_t i = 0; i < RecordingDesk::kItemsMax + 5; ++i) desk.add_event({1, 1, "stop", "", ""});
  const RecordingDesk::Items items = desk.take(number);
  EXPECT_EQ(items.events.size(), RecordingDesk::kItemsMax);
  EXPECT_EQ(items.lost, 5u);
  desk.add_event({1, 1, "stop", "", ""});
  EXPECT_EQ(desk.take(number).events.size(), 1u);
}

TEST(RecordingDesk, AcceptsAnyJson) {
  Desk d(true);
  for (const char* json : {"", "{", "[]", "1", "{}", R"({"t": 1e999, "text": 5, "person": ["ann"]})",
                           R"({"scores": {"a": 1e300, "b": null}, "closed": 3})"}) {
    d.desk.add_note(mark(json));
    d.desk.add_note(sheet(json));
  }
  const RecordingDesk::Items items = d.take();
  EXPECT_EQ(items.marks.size(), items.sheets.size());
  for (const LessonMark& m : items.marks) EXPECT_EQ(m.text, "");
}

TEST(RecordingDesk, ShowsTheStateToParticipants) {
  RecordingDesk desk(1, false);
  EXPECT_FALSE(desk.status());
  const std::uint32_t number = desk.begin(rpc::StatusRecording{.by_server = true});
  EXPECT_TRUE(desk.status());
  desk.set_status(number, rpc::StatusRecording{.by_server = true, .dropped = 3, .trouble = "the disk is full"});
  EXPECT_EQ(desk.status()->dropped, 3u);
  desk.set_status(number, std::nullopt);
  EXPECT_FALSE(desk.status());
}

// The thread of a recording that was ended may look at the desk after the next one has begun.
TEST(RecordingDesk, KeepsTheNewestRecordingFromAnEarlierOne) {
  RecordingDesk desk(1, false);
  const std::uint32_t first = desk.begin(rpc::StatusRecording{.by_server = true});
  const std::uint32_t second = desk.begin(rpc::StatusRecording{.by_server = true});
  desk.add_note(mark(R"({"text": "of the second"})"));
  EXPECT_TRUE(desk.take(first).marks.empty());
  desk.set_status(first, std::nullopt);
  EXPECT_TRUE(desk.status());
  EXPECT_EQ(desk.take(second).marks.size(), 1u);
}

}  // namespace
}  // namespace tandem::server
