// Bounds of the messages that create, end and assess sessions, in both directions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "proto/rpc/rpc_codec.h"
#include "proto/rpc/rpc_texts.h"

namespace tandem::rpc {
namespace {

bool encodes(const Body& body) { return encode({1, body}).has_value(); }

CreateSession creation() { return {.name = "exam", .scene = "contact", .holders = {{"trainee", "desk-2"}}}; }

TEST(SessionMessages, HaveNamesOfTheirLength) {
  EXPECT_TRUE(encodes(creation()));
  for (const std::string& bad :
       {std::string(), std::string(kNameMax + 1, 'x'), std::string("../x"), std::string("a b")}) {
    CreateSession named = creation(), scene = creation(), seat = creation(), workstation = creation();
    named.name = scene.scene = seat.holders[0].seat = workstation.holders[0].workstation = bad;
    for (const CreateSession& message : {named, scene, workstation}) EXPECT_FALSE(encodes(message)) << bad;
    EXPECT_EQ(encodes(seat), bad.empty()) << "without a seat the ticket is one of a console";
    CreateSession person = creation();
    person.holders[0].person = bad;
    EXPECT_EQ(encodes(person), bad.empty()) << "a ticket need not name its person";
  }
}

TEST(SessionMessages, HaveASceneByNameOrByText) {
  CreateSession both = creation();
  both.scene_text = "version: 1";
  EXPECT_FALSE(encodes(both));
  CreateSession text = creation();
  text.scene.clear();
  EXPECT_FALSE(encodes(text)) << "neither";
  text.scene_text = std::string(kSceneTextMax, 'x');
  EXPECT_TRUE(encodes(text));
  text.scene_text += 'x';
  EXPECT_FALSE(encodes(text));
  text.scene_text = std::string(kFrameMax, 'x');
  EXPECT_FALSE(encodes(text)) << "longer than a frame";
}

TEST(SessionMessages, LimitLifeAndHolders) {
  CreateSession message = creation();
  message.life_s = kLifeMaxS;
  EXPECT_TRUE(encodes(message));
  message.life_s = kLifeMaxS + 1;
  EXPECT_FALSE(encodes(message));
  message = creation();
  message.holders.push_back({"trainee", "desk-3"});
  EXPECT_FALSE(encodes(message)) << "a seat named twice";
  message.holders.clear();
  for (std::size_t i = 0; i <= kHoldersMax; ++i) message.holders.push_back({"s" + std::to_string(i), "desk"});
  EXPECT_FALSE(encodes(message));
  message.holders.pop_back();
  EXPECT_TRUE(encodes(message));
}

TEST(SessionMessages, GiveConsoleTicketsARoleAndSeatTicketsThatOfTheSeat) {
  CreateSession message = creation();
  message.holders = {{"", "desk", "eva", AccessRole::kEvaluator}, {"", "desk", "max", AccessRole::kRecorder}};
  EXPECT_TRUE(encodes(message)) << "several persons without a seat may share a workstation";
  message.holders[1].role = static_cast<AccessRole>(kAccessRoles);
  EXPECT_FALSE(encodes(message));
  message.holders = {{"trainee", "desk", "ted", AccessRole::kEvaluator}};
  EXPECT_FALSE(encodes(message)) << "the scene decides about the role of a seat";
}

TEST(SessionMessages, ListScenesInOrderOnce) {
  SceneList list{.scenes = {"a", "b"}};
  EXPECT_TRUE(encodes(list));
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"b", "a"}, {"a", "a"}, {""}, {"../a"}, {std::string(kNameMax + 1, 'x')}})
    EXPECT_FALSE(encodes(SceneList{.scenes = bad}));
  list.seats = {{0, "trainer", AccessRole::kInstructor}, {1, "trainer", AccessRole::kInstructor}};
  EXPECT_TRUE(encodes(list));
  for (const SceneSeat& bad :
       {SceneSeat{2, "x", AccessRole::kTrainee}, SceneSeat{0, "x", AccessRole::kTrainee},
        SceneSeat{1, "", AccessRole::kTrainee}, SceneSeat{1, "x", static_cast<AccessRole>(kAccessRoles)}}) {
    SceneList wrong = list;
    wrong.seats.push_back(bad);
    EXPECT_FALSE(encodes(wrong)) << bad.scene << " " << bad.name;
  }
  for (const std::vector<double>& bad : {std::vector<double>{1}, {1, 2, 3}, {1, -1}, {1, NAN}, {1, 2e9}}) {
    SceneList wrong = list;
    wrong.durations_s = bad;
    EXPECT_FALSE(encodes(wrong)) << bad.size();
  }
  list.durations_s = {0, kTimeMax};
  EXPECT_TRUE(encodes(list)) << "one duration per scene; 0: no scheduled end";
  list.seats.assign(kSceneSeatsMax, {1, std::string(kNameMax, 'x'), AccessRole::kTrainee});
  EXPECT_TRUE(encodes(list));
  list.seats.push_back(list.seats.front());
  EXPECT_FALSE(encodes(list));
  list = {};
  for (std::size_t i = 0; i < kScenesMax; ++i) list.scenes.push_back("s" + std::to_string(1000 + i));
  EXPECT_TRUE(encodes(list));
  list.scenes.emplace_back("t");
  EXPECT_FALSE(encodes(list));
}

TEST(SessionMessages, ListNotesWithinTheirBounds) {
  NoteList list;
  EXPECT_TRUE(encodes(list));
  const auto note = [](std::uint32_t number) {
    return StoredNote{.number = number, .person = "ann", .workstation = "desk", .json = "{}"};
  };
  list.notes = {note(1), note(3)};
  EXPECT_TRUE(encodes(list));
  const auto refused = [&list](auto change) {
    NoteList bad = list;
    change(bad.notes[1]);
    return !encodes(bad);
  };
  EXPECT_TRUE(refused([](StoredNote& n) { n.number = 1; })) << "numbers increase";
  EXPECT_TRUE(refused([](StoredNote& n) { n.kind = static_cast<NoteKind>(3); }));
  EXPECT_TRUE(refused([](StoredNote& n) { n.time_s = -1; }));
  EXPECT_TRUE(refused([](StoredNote& n) { n.time_s = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](StoredNote& n) { n.person = "a b"; }));
  EXPECT_TRUE(refused([](StoredNote& n) { n.workstation.clear(); }));
  EXPECT_TRUE(refused([](StoredNote& n) { n.json.clear(); }));
  EXPECT_TRUE(refused([](StoredNote& n) { n.json = std::string(kNoteMax + 1, 'x'); }));
  list.notes.clear();
  for (std::uint32_t i = 1; i <= kNotesMax; ++i) list.notes.push_back(note(i));
  EXPECT_TRUE(encodes(list));
  list.notes.push_back(note(kNotesMax + 1));
  EXPECT_FALSE(encodes(list));
  list.notes.resize(kNotesBytesMax / kNoteMax);
  for (StoredNote& n : list.notes) n.json = std::string(kNoteMax, 'x');
  EXPECT_TRUE(encodes(list)) << "fits into a frame";
  list.notes.push_back(note(kNotesMax));
  EXPECT_FALSE(encodes(list));
}

TEST(SessionMessages, CarryTicketsOfTheirLength) {
  SessionCreated created{.session = {.id = {}, .name = "exam", .seats = {}},
                         .code = "ABCDE12345",
                         .tickets = {{"a", "b", {std::byte{1}}}}};
  EXPECT_TRUE(encodes(created));
  created.tickets[0].ticket.clear();
  EXPECT_FALSE(encodes(created));
  created.tickets[0].ticket.resize(kTicketMax + 1);
  EXPECT_FALSE(encodes(created));
  created.tickets.clear();
  created.code = "abc";
  EXPECT_FALSE(encodes(created));
}

TEST(SessionMessages, LimitNotes) {
  Note note{.json = "{}"};
  EXPECT_TRUE(encodes(note));
  for (const std::string& bad :
       {std::string(), std::string(kNoteMax + 1, 'x'), std::string("{\n}"), std::string("\xff")}) {
    note.json = bad;
    EXPECT_FALSE(encodes(note)) << bad.size();
  }
  note.json = std::string(kNoteMax, ' ');
  EXPECT_TRUE(encodes(note)) << "the server rejects it, because it is no object";
  for (const int kind : {0, 3, 4, 255}) {
    Note other{.kind = static_cast<NoteKind>(kind), .json = "{}"};
    EXPECT_FALSE(encodes(other)) << kind;
  }
  EXPECT_FALSE(encodes(EndSession{{}, std::string(kTextMax + 1, 'x')}));
}

}  // namespace
}  // namespace tandem::rpc
