// Agreement against published worked examples, and sheets of lessons.
#include "netsim/score/agreement.h"

#include <gtest/gtest.h>

#include "netsim/score/rating_sheets.h"

namespace tandem::netsim::score {
namespace {

TEST(IntraclassCorrelation, EqualsShroutAndFleiss1979) {
  const auto icc =
      intraclass_correlation({{9, 2, 5, 8}, {6, 1, 3, 2}, {8, 4, 6, 8}, {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}});
  ASSERT_TRUE(icc) << icc.error();
  EXPECT_NEAR(icc->single.value, 0.29, 0.005);
  EXPECT_NEAR(icc->mean.value, 0.62, 0.005);
  EXPECT_NEAR(icc->single.low, 0.02, 0.005);
  EXPECT_NEAR(icc->single.high, 0.76, 0.005);
  EXPECT_NEAR(icc->mean.low, 0.07, 0.005);
  EXPECT_NEAR(icc->mean.high, 0.93, 0.005);
  EXPECT_EQ(icc->targets, 6u);
  EXPECT_EQ(icc->evaluators, 4u);
}

TEST(IntraclassCorrelation, IsOneForEqualRatingsAndLowerForAConstantDifference) {
  const auto equal = intraclass_correlation({{1, 1}, {2, 2}, {5, 5}});
  ASSERT_TRUE(equal);
  EXPECT_NEAR(equal->single.value, 1, 1e-12);
  EXPECT_NEAR(equal->single.low, 1, 1e-12);
  const auto shifted = intraclass_correlation({{1, 3}, {2, 4}, {5, 7}});
  ASSERT_TRUE(shifted);
  EXPECT_LT(shifted->single.value, 0.75) << "absolute agreement counts the difference of the evaluators";
}

TEST(IntraclassCorrelation, NamesMissingData) {
  EXPECT_FALSE(intraclass_correlation({}));
  EXPECT_FALSE(intraclass_correlation({{1, 2}}));
  EXPECT_FALSE(intraclass_correlation({{1}, {2}}));
  EXPECT_FALSE(intraclass_correlation({{1, 2}, {3}}));
  EXPECT_FALSE(intraclass_correlation({{1, 2}, {3, NAN}}));
  EXPECT_FALSE(intraclass_correlation({{2, 2}, {2, 2}}));
}

TEST(Kappa, OfCohenEqualsThePublishedTable) {
  // Cohen 1968, "Weighted kappa", Psychological Bulletin 70(4), table 1: unweighted kappa 0.492 at an agreement of
  // 0.70.
  const auto kappa = cohen_kappa({{0.44, 0.07, 0.09}, {0.05, 0.20, 0.05}, {0.01, 0.03, 0.06}});
  ASSERT_TRUE(kappa) << kappa.error();
  EXPECT_NEAR(kappa->kappa, 0.492, 0.0005);
  EXPECT_NEAR(kappa->agreement, 0.70, 1e-12);
}

TEST(Kappa, OfCohenIsOneForEqualAndZeroForIndependentJudgements) {
  EXPECT_NEAR(cohen_kappa({{5, 0}, {0, 7}})->kappa, 1, 1e-12);
  EXPECT_NEAR(cohen_kappa({{4, 6}, {8, 12}})->kappa, 0, 1e-12);
  EXPECT_FALSE(cohen_kappa({{9, 0}, {0, 0}})) << "one category only";
  EXPECT_FALSE(cohen_kappa({{1, 2}}));
  EXPECT_FALSE(cohen_kappa({{1, -2}, {0, 1}}));
  EXPECT_FALSE(cohen_kappa({{0, 0}, {0, 0}}));
}

TEST(Kappa, OfFleissEquals1971) {
  // Fleiss 1971, table 1: 30 patients, 6 psychiatrists, 5 diagnoses; kappa 0.430.
  const auto kappa = fleiss_kappa(
      {{0, 0, 0, 6, 0}, {0, 3, 0, 0, 3}, {0, 1, 4, 0, 1}, {0, 0, 0, 0, 6}, {0, 3, 0, 3, 0}, {2, 0, 4, 0, 0},
       {0, 0, 4, 0, 2}, {2, 0, 3, 1, 0}, {2, 0, 0, 4, 0}, {0, 0, 0, 0, 6}, {1, 0, 0, 5, 0}, {1, 1, 0, 4, 0},
       {0, 3, 3, 0, 0}, {1, 0, 0, 5, 0}, {0, 2, 0, 3, 1}, {0, 0, 5, 0, 1}, {3, 0, 0, 1, 2}, {5, 1, 0, 0, 0},
       {0, 2, 0, 4, 0}, {1, 0, 2, 0, 3}, {0, 0, 0, 0, 6}, {0, 1, 0, 5, 0}, {0, 2, 0, 1, 3}, {2, 0, 0, 4, 0},
       {1, 0, 0, 4, 1}, {0, 5, 0, 1, 0}, {4, 0, 0, 0, 2}, {0, 2, 0, 4, 0}, {1, 0, 5, 0, 0}, {0, 0, 0, 0, 6}});
  ASSERT_TRUE(kappa) << kappa.error();
  EXPECT_NEAR(kappa->kappa, 0.430, 0.0005);
  EXPECT_NEAR(kappa->agreement, 0.556, 0.0005);
  EXPECT_FALSE(fleiss_kappa({{2, 0}, {1, 0}})) << "a judgement is missing";
  EXPECT_FALSE(fleiss_kappa({{2, 0}, {2, 0}})) << "one category only";
  EXPECT_FALSE(fleiss_kappa({{1, 0}, {0, 1}})) << "one evaluator";
}

LessonSheet gears(const std::string& by, int depth, int rest) {
  LessonSheet sheet{"GEARS", "trainee", by, {}, true};
  for (const char* item : {"bimanual_dexterity", "efficiency", "force_sensitivity", "robotic_control", "autonomy"})
    sheet.scores[item] = rest;
  sheet.scores["depth_perception"] = depth;
  return sheet;
}

LessonScores with_sheets(const std::string& file, std::vector<LessonSheet> sheets) {
  LessonScores lesson;
  lesson.file = file;
  lesson.sheets = std::move(sheets);
  return lesson;
}

TEST(RatingSheets, TotalTheLastSheetOfEachEvaluator) {
  LessonSheet partial = gears("Bo", 3, 3);
  partial.scores.erase("efficiency");
  const std::vector<LessonScores> lessons{
      with_sheets("a", {gears("Al", 1, 1), gears("Al", 5, 4), partial, {"UNHEARD", "trainee", "Al", {}, true}})};
  std::vector<std::string> notes;
  const auto totals = sheet_totals(lessons, notes);
  ASSERT_EQ(totals.size(), 2u);
  EXPECT_EQ(totals[0].by, "Al");
  EXPECT_EQ(totals[0].total, 25);
  EXPECT_TRUE(totals[0].complete());
  EXPECT_EQ(totals[0].most, 30);
  EXPECT_EQ(totals[0].least, 6);
  EXPECT_EQ(totals[1].rated, 5u);
  EXPECT_FALSE(totals[1].complete());
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("UNHEARD"), std::string::npos);
}

TEST(RatingSheets, LeaveOutPointsBeyondTheScale) {
  std::vector<std::string> notes;
  const std::vector<LessonScores> lessons{with_sheets("a", {gears("Al", 900, 4)})};
  const auto totals = sheet_totals(lessons, notes);
  EXPECT_EQ(totals.at(0).total, 20);
  EXPECT_FALSE(totals.at(0).complete());
}

TEST(RatingSheets, CorrelateTotalsOfTheTargetsThatAllRated) {
  const std::vector<LessonScores> lessons{with_sheets("a", {gears("Al", 1, 1), gears("Bo", 2, 1)}),
                                          with_sheets("b", {gears("Al", 3, 3), gears("Bo", 3, 3)}),
                                          with_sheets("c", {gears("Al", 5, 5), gears("Bo", 5, 4)}),
                                          with_sheets("d", {gears("Al", 5, 5)})};
  const auto agreements = scale_agreements(lessons);
  ASSERT_EQ(agreements.size(), 1u);
  EXPECT_EQ(agreements[0].targets, 3u);
  ASSERT_TRUE(agreements[0].totals) << agreements[0].missing;
  const auto direct = intraclass_correlation({{6, 7}, {18, 18}, {30, 25}});
  EXPECT_EQ(agreements[0].totals->single.value, direct->single.value);
}

TEST(RatingSheets, GiveKappaForChecklists) {
  const auto list = [](const std::string& by, int first, int rest) {
    LessonSheet sheet{"CHECKLIST", "trainee", by, {}, true};
    for (const char* item : {"task_explained", "contact_gentle", "target_reached", "no_force_limit", "hand_over_clear"})
      sheet.scores[item] = rest;
    sheet.scores["device_checked"] = first;
    return sheet;
  };
  // Items: 1 of 6 differs. Al: 6 done; Bo: 5 done in a; in b both judge 0 for the first and 1 for the rest.
  std::vector<LessonScores> lessons{with_sheets("a", {list("Al", 1, 1), list("Bo", 0, 1)}),
                                    with_sheets("b", {list("Al", 0, 1), list("Bo", 0, 1)})};
  auto agreements = scale_agreements(lessons);
  ASSERT_EQ(agreements.size(), 1u);
  EXPECT_EQ(agreements[0].targets, 12u);
  ASSERT_TRUE(agreements[0].kappa) << agreements[0].missing;
  EXPECT_NEAR(agreements[0].kappa->kappa, cohen_kappa({{1, 0}, {1, 10}})->kappa, 1e-12);
  lessons[0].sheets.push_back(list("Cy", 1, 1));
  lessons[1].sheets.push_back(list("Cy", 0, 1));
  agreements = scale_agreements(lessons);
  ASSERT_TRUE(agreements[0].kappa) << agreements[0].missing;
  EXPECT_EQ(agreements[0].kappa->evaluators, 3u);
}

}  // namespace
}  // namespace tandem::netsim::score
