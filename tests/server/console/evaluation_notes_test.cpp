// Marks and sheets of evaluators: their forms, who sees what, and that a closed sheet is final.
#include "server/console/evaluation_notes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "common/base/rng.h"
#include "server/console/browser_frame.h"

namespace tandem::console {
namespace {

using Json = nlohmann::json;

const EvaluationNotes::Author kAnn{1, "ann"}, kBob{2, "bob"};

EvaluationSheet goals(std::int64_t points, bool closed, const std::string& of = "trainee") {
  return {"GOALS", of, {{"efficiency", points}}, closed};
}
Json seen(const EvaluationNotes& notes, const EvaluationNotes::Author& by) {
  return Json::parse(notes.json_for(by.id));
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

TEST(EvaluationNotes, HideOthersUntilTheOwnSheetIsClosed) {
  EvaluationNotes notes;
  notes.put(kAnn, goals(4, true));
  EXPECT_EQ(seen(notes, kAnn)["sheets"].size(), 1u);
  EXPECT_TRUE(seen(notes, kBob)["sheets"].empty());
  notes.put(kBob, goals(2, false));
  EXPECT_EQ(seen(notes, kBob)["sheets"].size(), 1u) << "the own draft only";
  EXPECT_EQ(seen(notes, kAnn)["sheets"].size(), 1u) << "a draft is hidden from others";
  notes.put(kBob, goals(3, true, "trainer"));
  EXPECT_EQ(seen(notes, kBob)["sheets"].size(), 2u) << "a closed sheet about another seat shows nothing";
  notes.put(kBob, goals(2, true));
  EXPECT_EQ(seen(notes, kBob)["sheets"].size(), 3u);
  EXPECT_EQ(seen(notes, kAnn)["sheets"].size(), 2u);
  EXPECT_EQ(seen(notes, kAnn)["sheets"][1]["scores"]["efficiency"], 2);
}

TEST(EvaluationNotes, AClosedSheetIsFinal) {
  EvaluationNotes notes;
  ASSERT_TRUE(notes.may_write(kAnn, goals(4, false)));
  notes.put(kAnn, goals(4, false));
  ASSERT_TRUE(notes.may_write(kAnn, goals(5, true)));
  notes.put(kAnn, goals(5, true));
  const auto refused = notes.may_write(kAnn, goals(1, false));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().find("final"), std::string::npos);
  EXPECT_TRUE(notes.may_write({3, "ann"}, goals(1, false))) << "the same name is not the same person";
  EXPECT_EQ(seen(notes, kAnn)["sheets"][0]["scores"]["efficiency"], 5);
}

TEST(EvaluationNotes, KeepBoundedNumbersOfMarksAndSheets) {
  EvaluationNotes notes;
  for (std::size_t n = 0; n < EvaluationNotes::kMarksMax + 3; ++n) notes.add({kAnn, 0.5 * static_cast<double>(n), "m"});
  notes.add({kBob, std::nullopt, "last"});
  const Json marks = seen(notes, kBob)["marks"];
  EXPECT_EQ(marks.size(), EvaluationNotes::kMarksMax);
  EXPECT_EQ(marks[0]["t"], 2.0);
  EXPECT_TRUE(marks.back()["t"].is_null());
  EXPECT_EQ(marks.back()["person"], "bob");
  for (std::size_t n = 0; n < EvaluationNotes::kSheetsMax; ++n) notes.put({n, "x"}, goals(3, false));
  EXPECT_FALSE(notes.may_write({9999, "y"}, goals(3, false)));
  EXPECT_TRUE(notes.may_write({7, "x"}, goals(4, false))) << "an existing draft may change";
}

// For any order of sheets, a person sees a sheet of another one only if both are closed, of one form and about one
// seat.
TEST(EvaluationNotes, ShowNoForeignOpenScoreInAnyOrder) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    RandomStream random(seed);
    EvaluationNotes notes;
    for (int n = 0; n < 60; ++n) {
      const EvaluationNotes::Author by{random.below(4), "p"};
      const EvaluationSheet sheet{random.below(2) == 0 ? "GOALS" : "GEARS",
                                  random.below(2) == 0 ? "a" : "b",
                                  {{"efficiency", static_cast<std::int64_t>(1 + random.below(5))}},
                                  random.below(4) == 0};
      if (notes.may_write(by, sheet)) notes.put(by, sheet);
      for (std::uint64_t person = 0; person < 4; ++person) {
        const Json sheets = Json::parse(notes.json_for(person))["sheets"];
        for (const Json& row : sheets) {
          if (row["closed"] == true) continue;
          const auto own = std::ranges::count_if(
              sheets, [&](const Json& other) { return other["sheet"] == row["sheet"] && other["of"] == row["of"]; });
          EXPECT_EQ(own, 1) << "an open sheet is the person's own, and hides all others of its kind; seed " << seed;
        }
      }
    }
  }
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
      [{"name":"desk-1","role":"INSTRUCTOR","seat":"trainer"},{"name":"desk-2","role":"EVALUATOR","seat":""}]})";
  const auto created = parse(create, AccessRole::kOperator);
  ASSERT_TRUE(created);
  const auto& order = std::get<rpc::CreateSession>(std::get<Order>(*created).body);
  EXPECT_EQ(order.scene, "contact");
  EXPECT_TRUE(order.tickets_only);
  ASSERT_EQ(order.holders.size(), 1u) << "a ticket is for a seat";
  EXPECT_EQ(order.holders[0].workstation, "desk-1");
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
