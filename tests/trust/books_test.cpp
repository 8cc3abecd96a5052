#include "common/trust/books.h"

#include <gtest/gtest.h>

#include "tests/trust/support.h"

namespace tandem::trust {
namespace {

using test::kNow;

const Pin kTouch{test::counting<32>(1)}, kOther{test::counting<32>(2)};
const EnrolmentCode kCode = test::secret_from<16>(1);

TEST(Books, ACodeTakesOneWorkstationInOnce) {
  std::vector<WorkstationRow> book;
  std::vector<CodeRow> codes;
  give_out(codes, kCode, "touch-07", kNow, kNow + 10);
  ASSERT_EQ(codes.size(), 1u);
  const auto row = enrol(book, codes, kCode, kTouch, kNow + 10);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->name, "touch-07");
  EXPECT_TRUE(codes.empty());
  ASSERT_NE(find_workstation(book, kTouch), nullptr);
  EXPECT_EQ(find_workstation(book, kTouch)->name, "touch-07");
  EXPECT_EQ(find_workstation(book, kOther), nullptr);
  const auto again = enrol(book, codes, kCode, kOther, kNow + 10);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), EnrolFault::kUnknownCode);
}

TEST(Books, ACodeOneBitOffIsNoCode) {
  std::vector<WorkstationRow> book;
  std::vector<CodeRow> codes;
  give_out(codes, kCode, "a", kNow, kNow + 10);
  for (std::size_t bit = 0; bit < 128; ++bit) {
    auto wrong = kCode;
    wrong.bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_EQ(enrol(book, codes, wrong, kTouch, kNow).error(), EnrolFault::kUnknownCode);
  }
  EXPECT_TRUE(book.empty());
  EXPECT_EQ(codes.size(), 1u);
}

TEST(Books, ACodeOneSecondTooOldIsToldSoAndGoes) {
  std::vector<WorkstationRow> book;
  std::vector<CodeRow> codes;
  give_out(codes, kCode, "a", kNow, kNow + 10);
  EXPECT_EQ(enrol(book, codes, kCode, kTouch, kNow + 11).error(), EnrolFault::kExpired);
  EXPECT_TRUE(codes.empty());
  EXPECT_TRUE(book.empty());
}

TEST(Books, ANewCodeForANameReplacesTheOldOneAndSweepsExpiredOnes) {
  std::vector<CodeRow> codes;
  give_out(codes, test::secret_from<16>(9), "gone", kNow - 100, kNow - 1);
  give_out(codes, kCode, "a", kNow - 50, kNow + 10);
  give_out(codes, test::secret_from<16>(2), "a", kNow, kNow + 20);
  ASSERT_EQ(codes.size(), 1u);
  std::vector<WorkstationRow> book;
  EXPECT_EQ(enrol(book, codes, kCode, kTouch, kNow).error(), EnrolFault::kUnknownCode);
  EXPECT_TRUE(enrol(book, codes, test::secret_from<16>(2), kTouch, kNow));
}

TEST(Books, AMachineSetUpAnewTakesItsOldNameAndItsOldKeyIsOut) {
  std::vector<WorkstationRow> book{{"a", kTouch.sha256, 1}};
  std::vector<CodeRow> codes;
  give_out(codes, kCode, "a", kNow, kNow + 10);
  ASSERT_TRUE(enrol(book, codes, kCode, kOther, kNow));
  EXPECT_EQ(book.size(), 1u);
  EXPECT_EQ(find_workstation(book, kTouch), nullptr);
}

TEST(Books, OneKeyHasOneName) {
  std::vector<WorkstationRow> book{{"a", kTouch.sha256, 1}};
  std::vector<CodeRow> codes;
  give_out(codes, kCode, "b", kNow, kNow + 10);
  EXPECT_EQ(enrol(book, codes, kCode, kTouch, kNow).error(), EnrolFault::kKeyTaken);
  EXPECT_EQ(codes.size(), 1u) << "the code was not used";
  give_out(codes, test::secret_from<16>(2), "a", kNow, kNow + 10);
  EXPECT_TRUE(enrol(book, codes, test::secret_from<16>(2), kTouch, kNow)) << "the same name again is fine";
}

TEST(Books, AreBounded) {
  std::vector<WorkstationRow> book;
  for (int i = 0; i < 4096; ++i) {
    Pin pin;
    pin.sha256[0] = static_cast<std::byte>(i);
    pin.sha256[1] = static_cast<std::byte>(i >> 8);
    pin.sha256[2] = std::byte{1};
    book.push_back({"w" + std::to_string(i), pin.sha256, 0});
  }
  std::vector<CodeRow> codes;
  give_out(codes, kCode, "b", kNow, kNow + 10);
  EXPECT_EQ(enrol(book, codes, kCode, kTouch, kNow).error(), EnrolFault::kBookFull);
}

TEST(Books, RevokingTakesTheKeyAndTheCodesOfAName) {
  std::vector<WorkstationRow> book{{"a", kTouch.sha256, 1}, {"b", kOther.sha256, 1}};
  std::vector<CodeRow> codes;
  give_out(codes, kCode, "a", kNow, kNow + 10);
  const Revoked gone = revoke(book, codes, "a");
  EXPECT_EQ(gone.workstations, 1u);
  EXPECT_EQ(gone.codes, 1u);
  EXPECT_EQ(find_workstation(book, kTouch), nullptr);
  EXPECT_NE(find_workstation(book, "b"), nullptr);
  EXPECT_EQ(revoke(book, codes, "a").workstations, 0u);
}

TEST(Books, ServersAreKnownByTheAddressDialled) {
  std::vector<ServerRow> known;
  remember(known, {"h:1", kTouch.sha256, "a"});
  remember(known, {"h:2", kOther.sha256, "a"});
  remember(known, {"h:1", kOther.sha256, "b"});
  ASSERT_EQ(known.size(), 2u);
  EXPECT_EQ(find_server(known, "h:1")->name, "b");
  EXPECT_EQ(find_server(known, "h:3"), nullptr);
}

TEST(Books, NamesAreThoseOfSeats) {
  EXPECT_TRUE(legal_name("touch-07_A"));
  EXPECT_TRUE(legal_name(std::string(32, 'x')));
  for (const std::string bad : {"", "a b", "a/b", "..", "\xc3\xa4"}) EXPECT_FALSE(legal_name(bad));
  EXPECT_FALSE(legal_name(std::string(33, 'x')));
}

}  // namespace
}  // namespace tandem::trust
