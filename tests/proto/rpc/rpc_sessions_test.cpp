// Bounds of the messages that create, end and assess sessions, in both directions.
#include <gtest/gtest.h>

#include "proto/rpc/rpc_codec.h"

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
    for (const CreateSession& message : {named, scene, seat, workstation}) EXPECT_FALSE(encodes(message)) << bad;
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
  for (std::size_t i = 0; i <= kSeatsMax; ++i) message.holders.push_back({"s" + std::to_string(i), "desk"});
  EXPECT_FALSE(encodes(message));
  message.holders.pop_back();
  EXPECT_TRUE(encodes(message));
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
