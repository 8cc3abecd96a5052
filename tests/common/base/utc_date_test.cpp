#include "common/base/utc_date.h"

#include <gtest/gtest.h>

namespace tandem {
namespace {

TEST(UtcDate, IsTheDayThatHoldsTheSecond) {
  EXPECT_EQ(utc_date(0), "1970-01-01");
  EXPECT_EQ(utc_date(86399), "1970-01-01");
  EXPECT_EQ(utc_date(86400), "1970-01-02");
  EXPECT_EQ(utc_date(-1), "1969-12-31");
  EXPECT_EQ(utc_date(951782400), "2000-02-29");  // `date -u -d @951782400`
  EXPECT_EQ(utc_date(1798761599), "2026-12-31");
}

}  // namespace
}  // namespace tandem
