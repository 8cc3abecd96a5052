// Marks and sheets of a session: their readers, that a closed sheet is final, bounds, and the file of notes.
#include "server/app/control/session_notes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/base/rng.h"
#include "server/app/control/note_log.h"

namespace tandem::server {
namespace {

SessionNote mark(const std::string& author, const std::string& text) {
  return {.session = "lesson",
          .workstation = "desk",
          .person = author,
          .author = "person/" + author,
          .role = AccessRole::kEvaluator,
          .time_s = 2.5,
          .kind = rpc::NoteKind::kMark,
          .json = "{\"text\":\"" + text + "\"}"};
}
SessionNote sheet(const std::string& author, bool closed, const std::string& of = "trainee",
                  const std::string& form = "GOALS") {
  SessionNote note = mark(author, "");
  note.kind = rpc::NoteKind::kSheet;
  note.json = R"({"sheet":")" + form + R"(","of":")" + of + R"(","scores":{"efficiency":4},"closed":)" +
              (closed ? "true}" : "false}");
  return note;
}
/// Adds a note if it is not rejected.
bool write(SessionNotes& notes, const SessionNote& note) {
  AuthoredNote made = authored(note);
  if (!notes.problem(made).empty()) return false;
  notes.add(std::move(made));
  return true;
}
rpc::NoteList seen(const SessionNotes& notes, const std::string& person, std::uint32_t after = 0) {
  return notes.list("person/" + person, after);
}

TEST(SessionNotes, HideOthersUntilTheOwnSheetIsClosed) {
  SessionNotes notes;
  ASSERT_TRUE(write(notes, sheet("ann", true)));
  EXPECT_EQ(seen(notes, "ann").notes.size(), 1u);
  EXPECT_TRUE(seen(notes, "bob").notes.empty());
  ASSERT_TRUE(write(notes, sheet("bob", false)));
  ASSERT_EQ(seen(notes, "bob").notes.size(), 1u) << "the own draft only";
  EXPECT_TRUE(seen(notes, "bob").notes[0].yours);
  EXPECT_EQ(seen(notes, "ann").notes.size(), 1u) << "a draft is hidden from others";
  ASSERT_TRUE(write(notes, sheet("bob", true, "trainer")));
  ASSERT_TRUE(write(notes, sheet("bob", true, "trainee", "OSATS")));
  EXPECT_EQ(seen(notes, "bob").notes.size(), 3u)
      << "a closed sheet about another seat or of another form shows nothing";
  ASSERT_TRUE(write(notes, sheet("bob", true)));
  EXPECT_EQ(seen(notes, "bob").notes.size(), 4u);
  const rpc::NoteList both = seen(notes, "ann");
  ASSERT_EQ(both.notes.size(), 2u);
  EXPECT_EQ(both.notes[1].person, "bob");
  EXPECT_FALSE(both.notes[1].yours);
}

TEST(SessionNotes, AClosedSheetIsFinalForItsAuthorOnly) {
  SessionNotes notes;
  ASSERT_TRUE(write(notes, sheet("ann", false)));
  ASSERT_TRUE(write(notes, sheet("ann", true)));
  EXPECT_EQ(notes.problem(authored(sheet("ann", false))), "your sheet GOALS about trainee is closed, which is final");
  EXPECT_TRUE(write(notes, sheet("bob", false)));
  SessionNote same_name = sheet("ann", false);
  same_name.author = "join/0011223344556677";
  EXPECT_TRUE(write(notes, same_name)) << "the same name without a proof is not the same person";
}

TEST(SessionNotes, ListNewerNotesAndTheNewestVersionOfASheet) {
  SessionNotes notes;
  EXPECT_EQ(notes.newest(), 0u);
  for (const char* text : {"a", "b", "c"}) ASSERT_TRUE(write(notes, mark("ann", text)));
  ASSERT_TRUE(write(notes, sheet("ann", false)));
  ASSERT_TRUE(write(notes, sheet("ann", false)));
  EXPECT_EQ(notes.newest(), 5u);
  const rpc::NoteList newer = seen(notes, "ann", 2);
  ASSERT_EQ(newer.notes.size(), 2u);
  EXPECT_EQ(newer.notes[0].number, 3u);
  EXPECT_EQ(newer.notes[0].time_s, 2.5);
  EXPECT_EQ(newer.notes[1].number, 5u);
  EXPECT_FALSE(newer.more);
  EXPECT_TRUE(seen(notes, "ann", 5).notes.empty());
}

TEST(SessionNotes, KeepBoundedNumbersOfMarksAndSheets) {
  SessionNotes notes;
  for (std::size_t n = 0; n < SessionNotes::kMarksMax + 3; ++n) ASSERT_TRUE(write(notes, mark("ann", "m")));
  std::size_t listed = 0, requests = 0;
  std::uint32_t after = 0;
  rpc::NoteList part;
  do {
    part = seen(notes, "bob", after);
    if (after == 0) {
      EXPECT_EQ(part.notes.front().number, 4u) << "the three oldest are forgotten";
    }
    listed += part.notes.size();
    after = part.notes.back().number;
    ++requests;
  } while (part.more);
  EXPECT_EQ(listed, SessionNotes::kMarksMax);
  EXPECT_EQ(requests, (SessionNotes::kMarksMax + rpc::kNotesMax - 1) / rpc::kNotesMax);
  for (std::size_t n = 0; n < SessionNotes::kSheetsMax; ++n)
    ASSERT_TRUE(write(notes, sheet("p" + std::to_string(n), false)));
  EXPECT_NE(notes.problem(authored(sheet("ann", false))).find("200 sheets already"), std::string::npos);
  EXPECT_TRUE(write(notes, sheet("p7", false))) << "an existing draft may change";
}

TEST(SessionNotes, FillOneReplyByTheirSize) {
  SessionNotes notes;
  SessionNote large = mark("ann", std::string(rpc::kNoteMax - 11, 'x'));
  ASSERT_EQ(large.json.size(), rpc::kNoteMax);
  for (int n = 0; n < 7; ++n) ASSERT_TRUE(write(notes, large));
  const rpc::NoteList first = seen(notes, "ann");
  EXPECT_EQ(first.notes.size(), 6u) << "6 * 8192 = 49152 bytes";
  EXPECT_TRUE(first.more);
  EXPECT_EQ(seen(notes, "ann", 6).notes.size(), 1u);
}

// For any order of sheets, an author reads a sheet of another one only if both are closed, of one form and about one
// seat.
TEST(SessionNotes, ShowNoForeignOpenScoreInAnyOrder) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    RandomStream random(seed);
    SessionNotes notes;
    const auto one_of = [&random](const char* a, const char* b) { return random.below(2) == 0 ? a : b; };
    for (int n = 0; n < 60; ++n) {
      const std::string by = std::to_string(random.below(4));
      const char *const of = one_of("a", "b"), *const form = one_of("GOALS", "GEARS");
      write(notes, sheet(by, random.below(4) == 0, of, form));
      for (int person = 0; person < 4; ++person) {
        const rpc::NoteList list = seen(notes, std::to_string(person));
        for (const rpc::StoredNote& row : list.notes) {
          const bool own_closed = std::ranges::any_of(list.notes, [&](const rpc::StoredNote& other) {
            return other.yours && other.json == row.json && other.json.ends_with("true}");
          });
          EXPECT_TRUE(row.yours || own_closed) << "seed " << seed << ": " << row.json;
        }
      }
    }
  }
}

TEST(SessionNotes, KnowAuthorsByNameElseByRoleOrJoin) {
  rpc::Welcome named;
  named.role = AccessRole::kEvaluator;
  named.person = "ann";
  EXPECT_EQ(SessionNotes::author_of(named, true), "person/ann");
  EXPECT_EQ(SessionNotes::author_of(named, false), "person/ann");
  rpc::Welcome first = named;
  first.person.clear();
  rpc::Welcome second = first;
  second.resume_secret.bytes[0] = std::byte{1};
  EXPECT_EQ(SessionNotes::author_of(first, false), "role/evaluator") << "one user has all consoles";
  EXPECT_NE(SessionNotes::author_of(first, true), SessionNotes::author_of(second, true))
      << "two persons at one workstation";
  EXPECT_EQ(SessionNotes::author_of(first, true).find("join/"), 0u);
}

TEST(NoteLog, GivesBackItsNotesAfterARestart) {
  const std::filesystem::path folder = testing::TempDir() + "note_log_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const NoteLog log(folder.string());
  EXPECT_TRUE(log.load("lesson", {}).empty()) << "no file";
  ASSERT_EQ(log.append(mark("ann", "slips"), 100), "");
  ASSERT_EQ(log.append(sheet("bob", true), 101), "");
  const std::filesystem::path file = folder / "lesson-00000000.notes.jsonl";
  std::ofstream(file, std::ios::app)
      << "\n[1]\n{\"role\":\"operator\"}\n"
      << R"({"time_s":-1,"workstation":"w","role":"operator","kind":"mark","note":{}})" << "\n"
      << R"({"time_s":1,"workstation":"a b","role":"operator","kind":"mark","note":{}})" << "\n"
      << R"({"time_s":1,"workstation":"w","role":"operator","kind":"mark","note":{"text":"cut)";
  const auto notes = log.load("lesson", {});
  ASSERT_EQ(notes.size(), 2u) << "lines that are no note are skipped";
  EXPECT_EQ(notes[0].author, "person/ann");
  EXPECT_EQ(notes[0].note.person, "ann");
  EXPECT_EQ(notes[0].note.json, "{\"text\":\"slips\"}");
  EXPECT_EQ(notes[0].note.time_s, 2.5);
  EXPECT_TRUE(notes[1].closed);
  EXPECT_EQ(notes[1].form, "GOALS");
  ASSERT_EQ(log.append(mark("eve", "after a crash"), 102), "");
  const auto later = log.load("lesson", {});
  ASSERT_EQ(later.size(), 3u) << "the half line before it takes no note along";
  EXPECT_EQ(later[2].author, "person/eve");
  EXPECT_TRUE(NoteLog("").load("lesson", {}).empty());
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace tandem::server
