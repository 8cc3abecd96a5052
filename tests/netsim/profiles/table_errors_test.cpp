#include "netsim/profiles/table_errors.h"

#include <gtest/gtest.h>

namespace tandem::netsim {
namespace {

TEST(TableErrors, NamesFileLineColumnAndValueOfACell) {
  const auto table = CsvTable::parse("a[1],b[s]\n1,2\n3,four\n");
  ASSERT_TRUE(table);
  TableErrors errors{"x.csv"};
  errors.add(*table, 1, 1, "must be a number");
  ASSERT_FALSE(errors.empty());
  const InputErrors all = errors.take().error();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0], (InputError{"x.csv", 3, 2, "b", "four", "must be a number"}));
  EXPECT_TRUE(errors.empty()) << "take leaves none";
}

TEST(TableErrors, PlacesAnErrorOfTheWholeTableAtItsBegin) {
  TableErrors errors{"x.csv"};
  errors.add("holds no row");
  EXPECT_EQ(errors.take().error(), (InputErrors{{"x.csv", 1, 1, "", "", "holds no row"}}));
}

TEST(TableErrors, KeepsAtMostFiftyErrorsAndFortyCharactersOfAValue) {
  TableErrors errors{"x.csv"};
  for (std::size_t i = 0; i < TableErrors::kMax; ++i) {
    EXPECT_FALSE(errors.full());
    errors.add(i + 1, 0, "a", std::string(60, 'v'), "bad");
  }
  EXPECT_TRUE(errors.full());
  errors.add("one more");
  const InputErrors all = errors.take().error();
  EXPECT_EQ(all.size(), 50u);
  EXPECT_EQ(all.back().line, 50);
  EXPECT_EQ(all.back().value, std::string(40, 'v'));
}

TEST(TableErrors, RepeatsWhyATextIsNoTable) {
  const auto table = CsvTable::parse("a[1],b\n");
  ASSERT_FALSE(table);
  TableErrors errors{"x.csv"};
  errors.add(table.error());
  const InputErrors all = errors.take().error();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(static_cast<std::size_t>(all[0].line), table.error().line);
  EXPECT_EQ(all[0].message, table.error().message);
}

}  // namespace
}  // namespace tandem::netsim
