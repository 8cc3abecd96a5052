#include "client/diagnostics/motor_registry.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

const std::string kDigest(64, 'a'), kOther(64, 'b');

MotorRegistry two() {
  MotorRegistry book;
  book.put({"serial:0001", kDigest, true, 1'700'000'000});
  book.put({"port:1-2", kOther, false, 1'700'000'001});
  return book;
}

TEST(MotorRegistry, SurvivesARoundTrip) {
  const auto read = MotorRegistry::parse(two().text());
  ASSERT_TRUE(read) << read.error();
  ASSERT_NE(read->find("serial:0001", kDigest), nullptr);
  EXPECT_TRUE(read->find("serial:0001", kDigest)->confirmed);
  EXPECT_FALSE(read->find("port:1-2", kOther)->confirmed);
  EXPECT_EQ(read->find("serial:0001", kOther), nullptr) << "another file: its signs may be others";
  EXPECT_EQ(read->find("serial:0002", kDigest), nullptr) << "another device";
  EXPECT_EQ(read->text(), two().text());
  EXPECT_TRUE(MotorRegistry::parse("")->records().empty());
}

TEST(MotorRegistry, ReplacesTheOldRecordByTheNewOne) {
  MotorRegistry book = two();
  book.put({"serial:0001", kDigest, false, 1'700'000'002});
  EXPECT_EQ(book.records().size(), 2u);
  EXPECT_FALSE(book.find("serial:0001", kDigest)->confirmed)
      << "a motor that was right and went the wrong way later is not confirmed";
}

TEST(MotorRegistry, IsBoundedAndDropsTheOldest) {
  MotorRegistry book;
  for (std::size_t i = 0; i <= MotorRegistry::kRecordsMax; ++i)
    book.put({"serial:" + std::to_string(i), kDigest, true, 1});
  EXPECT_EQ(book.records().size(), MotorRegistry::kRecordsMax);
  EXPECT_EQ(book.find("serial:0", kDigest), nullptr);
  EXPECT_TRUE(MotorRegistry::parse(book.text()));
}

TEST(MotorRegistry, RejectsATornOrForeignFileAsAWhole) {
  const std::string good = two().text();
  for (std::size_t n = 1; n < good.size(); ++n) {
    const auto cut = MotorRegistry::parse(std::string_view(good).substr(0, n));
    EXPECT_EQ(cut.has_value(), good[n - 1] == '\n') << "cut after " << n << " bytes";
  }
  const std::string line = "motors 1 serial:1 " + kDigest + " confirmed 5";
  EXPECT_TRUE(MotorRegistry::parse(line + "\n"));
  for (const std::string& bad :
       {line, line + " more\n", line + "\n" + line + "\n", "motors 2 serial:1 " + kDigest + " confirmed 5\n",
        "motors 1  " + kDigest + " confirmed 5\n", "motors 1 serial:1 " + kDigest.substr(1) + " confirmed 5\n",
        "motors 1 serial:1 " + kDigest + " yes 5\n", "motors 1 serial:1 " + kDigest + " confirmed -5\n",
        "motors 1 serial:1 " + kDigest + " confirmed \n", std::string("\0\0\0\n", 4)}) {
    const auto read = MotorRegistry::parse(bad);
    ASSERT_FALSE(read) << bad;
    EXPECT_TRUE(read.error().starts_with("line ")) << read.error();
  }
}

}  // namespace
}  // namespace tandem::client
