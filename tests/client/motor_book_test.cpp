#include "client/motor_book.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

const std::string kDigest(64, 'a'), kOther(64, 'b');

MotorBook two() {
  MotorBook book;
  book.put({"serial:0001", kDigest, true, 1'700'000'000});
  book.put({"port:1-2", kOther, false, 1'700'000'001});
  return book;
}

TEST(MotorBook, IsReadAsItWasWritten) {
  const auto read = MotorBook::parse(two().text());
  ASSERT_TRUE(read) << read.error();
  ASSERT_NE(read->find("serial:0001", kDigest), nullptr);
  EXPECT_TRUE(read->find("serial:0001", kDigest)->confirmed);
  EXPECT_FALSE(read->find("port:1-2", kOther)->confirmed);
  EXPECT_EQ(read->find("serial:0001", kOther), nullptr) << "another file: its signs may be others";
  EXPECT_EQ(read->find("serial:0002", kDigest), nullptr) << "another device";
  EXPECT_EQ(read->text(), two().text());
  EXPECT_TRUE(MotorBook::parse("")->records().empty());
}

TEST(MotorBook, ANewRecordTakesThePlaceOfTheOld) {
  MotorBook book = two();
  book.put({"serial:0001", kDigest, false, 1'700'000'002});
  EXPECT_EQ(book.records().size(), 2u);
  EXPECT_FALSE(book.find("serial:0001", kDigest)->confirmed) << "what was right and went the wrong way later is not confirmed";
}

TEST(MotorBook, IsBoundedAndLosesTheOldest) {
  MotorBook book;
  for (std::size_t i = 0; i <= MotorBook::kRecordsMax; ++i) book.put({"serial:" + std::to_string(i), kDigest, true, 1});
  EXPECT_EQ(book.records().size(), MotorBook::kRecordsMax);
  EXPECT_EQ(book.find("serial:0", kDigest), nullptr);
  EXPECT_TRUE(MotorBook::parse(book.text()));
}

TEST(MotorBook, OfATornOrForeignFileNothingCounts) {
  const std::string good = two().text();
  for (std::size_t n = 1; n < good.size(); ++n) {
    const auto cut = MotorBook::parse(std::string_view(good).substr(0, n));
    EXPECT_EQ(cut.has_value(), good[n - 1] == '\n') << "cut after " << n << " bytes";
  }
  const std::string line = "motors 1 serial:1 " + kDigest + " confirmed 5";
  EXPECT_TRUE(MotorBook::parse(line + "\n"));
  for (const std::string& bad :
       {line, line + " more\n", line + "\n" + line + "\n", "motors 2 serial:1 " + kDigest + " confirmed 5\n", "motors 1  " + kDigest + " confirmed 5\n",
        "motors 1 serial:1 " + kDigest.substr(1) + " confirmed 5\n", "motors 1 serial:1 " + kDigest + " yes 5\n",
        "motors 1 serial:1 " + kDigest + " confirmed -5\n", "motors 1 serial:1 " + kDigest + " confirmed \n", std::string("\0\0\0\n", 4)}) {
    const auto read = MotorBook::parse(bad);
    ASSERT_FALSE(read) << bad;
    EXPECT_TRUE(read.error().starts_with("line ")) << read.error();
  }
}

}  // namespace
}  // namespace tandem::client
