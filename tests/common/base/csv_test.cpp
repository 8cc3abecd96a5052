#include "common/base/csv.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"

namespace tandem {
namespace {

TEST(CsvTable, ReadsNamesUnitsAndNumbers) {
  const auto t = CsvTable::parse("t_s[s],px_m[m],f[N]\n0, 1.5 ,-2e-3\r\n0.001,+2,\n");
  ASSERT_TRUE(t.has_value());
  ASSERT_EQ(t->rows(), 2u);
  EXPECT_EQ(t->columns()[1].name, "px_m");
  EXPECT_EQ(t->columns()[2].unit, "N");
  EXPECT_EQ(t->find("f"), 2u);
  EXPECT_FALSE(t->find("g").has_value());
  EXPECT_EQ(*t->number(0, 1), 1.5);
  EXPECT_EQ(*t->number(0, 2), -2e-3);
  EXPECT_EQ(*t->number(1, 1), 2.0);
  EXPECT_EQ(t->line(1), 3u);
}

TEST(CsvTable, DistinguishesMissingFromInvalid) {
  const auto t = CsvTable::parse("a[1],b[1]\n,1\nnan,inf\n1x,2\n");
  ASSERT_TRUE(t.has_value());
  EXPECT_FALSE(t->optional_number(0, 0)->has_value());
  EXPECT_EQ(t->number(0, 0).error().text("f.csv"), "f.csv:2: column 1: a: missing");
  EXPECT_EQ(t->number(1, 0).error().text("f.csv"), "f.csv:3: column 1: a: 'nan' is not a finite number");
  EXPECT_EQ(t->number(1, 1).error().text("f.csv"), "f.csv:3: column 2: b: 'inf' is not a finite number");
  EXPECT_EQ(t->number(2, 0).error().text("f.csv"), "f.csv:4: column 1: a: '1x' is not a finite number");
}

TEST(CsvTable, AllowsTextInUnreadColumns) {
  const auto t = CsvTable::parse("t[s],who[1]\n1,Ann\n");
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->cell(0, 1), "Ann");
}

struct Bad {
  const char* text;
  std::size_t line, column;
  const char* part;
};

TEST(CsvTable, ReportsThePlaceOfAnError) {
  const Bad cases[] = {
      {"", 0, 0, "empty"},
      {"\n\n", 0, 0, "empty"},
      {"a,b[m]\n", 1, 1, "name[unit]"},
      {"a[s],b[]\n", 1, 2, "name[unit]"},
      {"[s]\n", 1, 1, "name"},
      {"a[s],a[s]\n", 1, 2, "twice"},
      {"a[s],b[m]\n1,2\n1\n", 3, 0, "1 cells, the header has 2"},
      {"a[s],b[m]\n1,2,3\n", 2, 0, "3 cells"},
      {"a[s]\n1\n\n2\n", 3, 0, "empty line"},
      {"a[s]\n\"1\"\n", 2, 0, "quoted"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.text);
    const auto t = CsvTable::parse(c.text);
    ASSERT_FALSE(t.has_value());
    EXPECT_EQ(t.error().line, c.line);
    EXPECT_EQ(t.error().column, c.column);
    EXPECT_NE(t.error().message.find(c.part), std::string::npos) << t.error().message;
  }
}

TEST(CsvTable, AcceptsByteOrderMarkAndNoFinalNewline) {
  const auto t = CsvTable::parse(
      "\xef\xbb\xbf"
      "a[s]\n1");
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->columns()[0].name, "a");
  EXPECT_EQ(*t->number(0, 0), 1.0);
}

TEST(CsvTable, SurvivesAMoveOfTheTable) {
  auto t = CsvTable::parse("a[s]\n7\n");
  const CsvTable moved = std::move(*t);
  EXPECT_EQ(*moved.number(0, 0), 7.0);
}

TEST(CsvTable, ReturnsATableOrAnErrorForAnyBytes) {
  const std::string good = "t[s],x[m]\n0,1\n1,2\n";
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r(seed);
    std::string text = good.substr(0, r.below(good.size() + 1));
    for (auto& c : text) {
      if (r.below(8) == 0) c = static_cast<char>(r.below(256));
    }
    const auto t = CsvTable::parse(text);
    if (!t) continue;
    for (std::size_t row = 0; row < t->rows(); ++row) {
      for (std::size_t c = 0; c < t->columns().size(); ++c) (void)t->optional_number(row, c);
    }
  }
}

}  // namespace
}  // namespace tandem
