// Marks and sheets of evaluators on the page: their forms, frames and the copies of the server's notes.
#include "server/console/evaluation_notes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "server/console/browser_frame.h"

namespace tandem::console {
namespace {

using Json = nlohmann::json;

EvaluationSheet goals(std::int64_t points, bool closed, const std::string& of = "trainee") {
  return {"GOALS", of, {{"efficiency", points}}, closed};
}
TEST(EvaluationSheets, HaveTheItemsOfThePublishedScales) {
  EXPECT_EQ(sheet_form("OSATS")->items.size(), 7u);  // Martin et al. 1997: 7 items, 35 points at most
  EXPECT_EQ(sheet_form("GEARS")->items.size(), 6u);  // Goh et al. 2012, with autonomy
  EXPECT_EQ(sheet_form("GOALS")->items.size(), 5u);  // Vassiliou et al. 2005: 25 points at most
  for (const char* name : {"OSATS", "GEARS", "GOALS"}) {
    EXPECT_EQ(sheet_form(name)->least, 1);
    EXPECT_EQ(sheet_form(name)->most, 5);
  }
  EXPECT_EQ(sheet_form("osats"), nullptr);
  EXPECT_TRUE(check(goals(5, true)));
  EXPECT_NE(check(goals(6, true)).error().find("[1, 5]"), std::string::npos);
  EXPECT_NE(check(goals(0, true)).error().find("\"efficiency\""), std::string::npos);
  EXPECT_FALSE(check({"CHECKLIST", "trainee", {{"device_checked", 2}}, false}));
  EXPECT_NE(check({"GOALS", "trainee", {{"use_of_assistants", 3}}, false}).error().find("no item"), std::string::npos);
  EXPECT_FALSE(check({"SPARC", "trainee", {}, false}));
}

rpc::StoredNote stored(std::uint32_t number, rpc::NoteKind kind, std::string json, std::string person = "ann") {
  return {.number = number, .kind = kind, .person = std::move(person), .workstation = "desk", .json = std::move(json)};
}
rpc::StoredNote sheet_of(std::uint32_t number, bool yours, bool closed, const std::string& person = "ann") {
  rpc::StoredNote note = stored(number, rpc::NoteKind::kSheet, sheet_json(person, goals(4, closed)), person);
  note.yours = yours;
  return note;
}
Json seen(const EvaluationNotes& notes) { return Json::parse(notes.message()); }

TEST(EvaluationNotes, ShowMarksAndSheetsInTheOrderOfTheServer) {
  EvaluationNotes notes;
  EXPECT_FALSE(notes.put(stored(2, rpc::NoteKind::kMark, mark_json("x", std::nullopt, "second"), "bob")));
  EXPECT_FALSE(notes.put(stored(1, rpc::NoteKind::kMark, mark_json("x", 1.5, "first"))));
  EXPECT_FALSE(notes.put(stored(1, rpc::NoteKind::kMark, mark_json("x", 1.5, "again"))));
  const Json marks = seen(notes)["marks"];
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0], (Json{{"t", 1.5}, {"text", "first"}, {"person", "ann"}, {"proved", true}}));
  EXPECT_EQ(marks[1], (Json{{"t", nullptr}, {"text", "second"}, {"person", "bob"}, {"proved", true}}));
}

TEST(EvaluationNotes, ShowAChosenNameAsUnproved) {
  EvaluationNotes notes;
  notes.put(stored(1, rpc::NoteKind::kMark, mark_json("ann", 0, "a"), ""));
  notes.put(stored(2, rpc::NoteKind::kMark, R"({"grip":4})", ""));
  notes.put(stored(3, rpc::NoteKind::kMark, mark_json("ann", 7, ""), ""));
  const Json marks = seen(notes)["marks"];
  EXPECT_EQ(marks[0]["person"], "ann");
  EXPECT_EQ(marks[0]["proved"], false);
  EXPECT_EQ(marks[1]["person"], "desk") << "of another program: the workstation";
  EXPECT_EQ(marks[1]["text"], R"({"grip":4})");
  EXPECT_EQ(marks[2]["text"], "") << "a mark without words";
}

TEST(EvaluationNotes, ReplaceAnOwnDraftAndAskAgainOnceItIsClosed) {
  EvaluationNotes notes;
  EXPECT_FALSE(notes.put(sheet_of(1, true, false)));
  EXPECT_TRUE(notes.put(sheet_of(4, true, true))) << "sheets of others may be readable now";
  EXPECT_FALSE(notes.put(sheet_of(4, true, true))) << "once";
  EXPECT_FALSE(notes.put(sheet_of(2, false, true, "bob")));
  const Json sheets = seen(notes)["sheets"];
  ASSERT_EQ(sheets.size(), 2u);
  EXPECT_EQ(sheets[0]["person"], "bob");
  EXPECT_EQ(sheets[0]["yours"], false);
  EXPECT_EQ(sheets[1]["yours"], true);
  EXPECT_EQ(sheets[1]["closed"], true);
}

TEST(EvaluationNotes, SkipJsonThatIsNoSheet) {
  EvaluationNotes notes;
  for (const char* json :
       {"{}", R"({"sheet":"GOALS","of":"a","scores":{"efficiency":9},"closed":true})",
        R"({"sheet":"GOALS","of":"a","scores":{"efficiency":"4"},"closed":true})",
        R"({"sheet":"GOALS","of":"a","scores":[],"closed":true})", R"({"sheet":"GOALS","of":"a","scores":{}})"})
    EXPECT_FALSE(notes.put(stored(1, rpc::NoteKind::kSheet, json))) << json;
  EXPECT_TRUE(seen(notes)["sheets"].empty());
}

TEST(EvaluationNotes, KeepBoundedNumbersOfMarksAndSheets) {
  EvaluationNotes notes;
  for (std::uint32_t n = 1; n <= EvaluationNotes::kMarksMax + 3; ++n)
    notes.put(stored(n, rpc::NoteKind::kMark, mark_json("x", 0.5 * n, "m")));
  const Json marks = seen(notes)["marks"];
  EXPECT_EQ(marks.size(), EvaluationNotes::kMarksMax);
  EXPECT_EQ(marks[0]["t"], 2.0) << "the oldest are forgotten";
  for (std::uint32_t n = 1; n <= EvaluationNotes::kSheetsMax + 3; ++n)
    notes.put(sheet_of(n, false, true, "p" + std::to_string(n)));
  EXPECT_EQ(seen(notes)["sheets"].size(), EvaluationNotes::kSheetsMax);
}

TEST(NoteFrames, NeedTheRightAndTheRangesOfTheForms) {
  const auto parse = [](const char* text, AccessRole role) { return parse_browser_frame(text, role, rpc::Id{}); };
  const char* const mark = R"({"type":"mark","id":3,"t":12.5,"text":"good grip"})";
  const char* const sheet =
      R"({"type":"sheet","id":4,"sheet":"OSATS","of":"trainee","scores":{"respect_for_tissue":4},"closed":true})";
  for (const AccessRole role : {AccessRole::kInstructor, AccessRole::kEvaluator, AccessRole::kOperator}) {
    const auto marked = parse(mark, role);
    ASSERT_TRUE(marked);
    EXPECT_EQ(std::get<MarkFrame>(*marked).t_s, 12.5);
    const auto filled = parse(sheet, role);
    ASSERT_TRUE(filled);
    EXPECT_EQ(std::get<SheetFrame>(*filled).sheet.scores.at("respect_for_tissue"), 4);
  }
  // A page of a trainee or observer has no seat: it watches, frame by frame.
  for (const AccessRole role : {AccessRole::kTrainee, AccessRole::kObserver})
    for (const char* frame :
         {R"({"type":"order","id":1,"order":"pause","why":""})", R"({"type":"order","id":1,"order":"stop","why":""})",
          R"({"type":"order","id":1,"order":"resume","stop":1})",
          R"({"type":"order","id":1,"order":"authority","tool":0,"version":1,"alpha":[1]})",
          R"({"type":"order","id":1,"order":"remove","seat":"a","why":""})",
          R"({"type":"order","id":1,"order":"drain","grace_s":1})",
          R"({"type":"order","id":1,"order":"end","session":"000102030405060708090a0b0c0d0e0f"})"}) {
      const auto refused = parse(frame, role);
      ASSERT_FALSE(refused) << frame;
      EXPECT_FALSE(refused.error().close);
      EXPECT_NE(refused.error().text.find(" may "), std::string::npos) << refused.error().text;
    }
  for (const char* frame : {R"({"type":"ack","n":1})", R"({"type":"watch","id":1,"session":"ab"})"})
    EXPECT_TRUE(parse(frame, AccessRole::kObserver)) << frame;
  for (const AccessRole role : {AccessRole::kTrainee, AccessRole::kObserver, AccessRole::kRecorder})
    for (const char* frame : {mark, sheet}) {
      const auto refused = parse(frame, role);
      ASSERT_FALSE(refused);
      EXPECT_NE(refused.error().text.find("may not write marks and sheets"), std::string::npos);
    }
  for (const char* bad :
       {R"({"type":"mark","id":3,"t":-1,"text":"x"})", R"({"type":"mark","id":3,"t":1e10,"text":"x"})",
        R"({"type":"mark","id":3,"text":"x"})", R"({"type":"mark","id":3,"t":1,"text":"a\u0007b"})",
        R"({"type":"sheet","id":4,"sheet":"OSATS","of":"t","scores":{"respect_for_tissue":4.5},"closed":true})",
        R"({"type":"sheet","id":4,"sheet":"OSATS","of":"t","scores":{"respect_for_tissue":1e300},"closed":true})",
        R"({"type":"sheet","id":4,"sheet":"OSATS","of":"t","scores":[],"closed":true})",
        R"({"type":"sheet","id":4,"sheet":"OSATS","of":"t","scores":{}})"})
    EXPECT_FALSE(parse(bad, AccessRole::kEvaluator)) << bad;
}

TEST(DeskFrames, CreateAndEndSessionsForOperatorsOnly) {
  const auto parse = [](const char* text, AccessRole role) { return parse_browser_frame(text, role, rpc::Id{}); };
  const char* const create = R"({"type":"order","id":1,"order":"create","scene":"contact","name":"exam","people":
      [{"name":"desk-1","role":"INSTRUCTOR","seat":"trainer"},
       {"name":"eva","role":"EVALUATOR","seat":"","workstation":"desk-2"}]})";
  const auto created = parse(create, AccessRole::kOperator);
  ASSERT_TRUE(created);
  const auto& order = std::get<rpc::CreateSession>(std::get<Order>(*created).body);
  EXPECT_EQ(order.scene, "contact");
  EXPECT_TRUE(order.tickets_only);
  ASSERT_EQ(order.holders.size(), 2u);
  EXPECT_EQ(order.holders[0], (rpc::SeatHolder{"trainer", "desk-1", "desk-1"})) << "the scene has the role of the seat";
  EXPECT_EQ(order.holders[1], (rpc::SeatHolder{"", "desk-2", "eva", AccessRole::kEvaluator}));
  EXPECT_FALSE(parse(R"({"type":"order","id":1,"order":"create","scene":"c","name":"n",
      "people":[{"name":"eva","role":"JUDGE","seat":""}]})",
                     AccessRole::kOperator));
  const auto refusal = [&parse](const std::string& name, const std::string& people) {
    const std::string text =
        R"({"type":"order","id":1,"order":"create","scene":"c","name":")" + name + R"(","people":[)" + people + "]}";
    const auto parsed = parse(text.c_str(), AccessRole::kOperator);
    return parsed ? std::string{} : parsed.error().text;
  };
  const std::string eva = R"({"name":"eva","role":"TRAINEE","seat":"a"})";
  EXPECT_EQ(refusal("n", eva), "");
  EXPECT_EQ(refusal("my exam", eva), "\"name\" must be 1 to 32 characters of A-Z a-z 0-9 _ -");
  for (const char* person :
       {R"({"name":"e v a","role":"TRAINEE","seat":""})", R"({"name":"","role":"TRAINEE","seat":""})",
        R"({"name":"eva","role":"TRAINEE","seat":"","workstation":"desk.1"})",
        R"({"name":"eva","role":"TRAINEE","seat":"a b"})"})
    EXPECT_NE(refusal("n", person).find("must be 1 to 32 characters of A-Z a-z 0-9 _ -"), std::string::npos) << person;
  EXPECT_EQ(refusal("n", eva + "," + eva), "in \"people\": seat \"a\" has two persons; each seat has one");
  const char* const end = R"({"type":"order","id":1,"order":"end","session":"000102030405060708090a0b0c0d0e0f"})";
  const auto ended = parse(end, AccessRole::kOperator);
  ASSERT_TRUE(ended);
  EXPECT_EQ(std::get<rpc::EndSession>(std::get<Order>(*ended).body).session_id[15], std::byte{15});
  for (const AccessRole role : {AccessRole::kInstructor, AccessRole::kTrainee, AccessRole::kEvaluator,
                                AccessRole::kObserver, AccessRole::kRecorder})
    for (const char* frame : {create, end}) EXPECT_FALSE(parse(frame, role));
  EXPECT_FALSE(parse(R"({"type":"order","id":1,"order":"end","session":"00"})", AccessRole::kOperator));
  EXPECT_FALSE(
      parse(R"({"type":"order","id":1,"order":"create","scene":"c","name":"n","people":[1]})", AccessRole::kOperator));
  EXPECT_FALSE(parse(R"({"type":"order","id":1,"order":"create","scene":"c","name":"n","people":[{"seat":"a"}]})",
                     AccessRole::kOperator));
}

TEST(DeskFrames, StartAndEndRecordingsForInstructorsAndOperatorsOnly) {
  const auto parse = [](const char* text, AccessRole role) { return parse_browser_frame(text, role, rpc::Id{}); };
  const char* const start = R"({"type":"order","id":1,"order":"record","on":true})";
  for (const AccessRole role : {AccessRole::kInstructor, AccessRole::kOperator}) {
    const auto order = parse(start, role);
    ASSERT_TRUE(order);
    EXPECT_TRUE(std::get<rpc::RecordSession>(std::get<Order>(*order).body).on);
  }
  for (const AccessRole role :
       {AccessRole::kTrainee, AccessRole::kEvaluator, AccessRole::kObserver, AccessRole::kRecorder})
    EXPECT_FALSE(parse(start, role));
  for (const char* wrong :
       {R"({"type":"order","id":1,"order":"record"})", R"({"type":"order","id":1,"order":"record","on":1})",
        R"({"type":"order","id":1,"order":"record","on":true,"why":"x"})"})
    EXPECT_FALSE(parse(wrong, AccessRole::kOperator)) << wrong;
}

}  // namespace
}  // namespace tandem::console
