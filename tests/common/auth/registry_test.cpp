#include "common/auth/registry.h"

#include <gtest/gtest.h>

#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::kNow;

const KeyFingerprint kTouch{test::counting<32>(1)}, kOther{test::counting<32>(2)};
const EnrolmentCode kCode = test::secret_from<16>(1);

TEST(Registry, EnrolsOneWorkstationPerCodeOnce) {
  std::vector<WorkstationRow> book;
  std::vector<CodeRow> codes;
  issue_code(codes, kCode, "touch-07", kNow, kNow + 10);
  ASSERT_EQ(codes.size(), 1u);
  const auto row = enroll(book, codes, kCode, kTouch, kNow + 10);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->name, "touch-07");
  EXPECT_TRUE(codes.empty());
  ASSERT_NE(find_workstation(book, kTouch), nullptr);
  EXPECT_EQ(find_workstation(book, kTouch)->name, "touch-07");
  EXPECT_EQ(find_workstation(book, kOther), nullptr);
  const auto again = enroll(book, codes, kCode, kOther, kNow + 10);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), EnrollError::kUnknownCode);
}

TEST(Registry, RejectsACodeOneBitOff) {
  std::vector<WorkstationRow> book;
  std::vector<CodeRow> codes;
  issue_code(codes, kCode, "a", kNow, kNow + 10);
  for (std::size_t bit = 0; bit < 128; ++bit) {
    auto wrong = kCode;
    wrong.bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_EQ(enroll(book, codes, wrong, kTouch, kNow).error(), EnrollError::kUnknownCode);
  }
  EXPECT_TRUE(book.empty());
  EXPECT_EQ(codes.size(), 1u);
}

TEST(Registry, ReportsAndRemovesACodeOneSecondTooOld) {
  std::vector<WorkstationRow> book;
  std::vector<CodeRow> codes;
  issue_code(codes, kCode, "a", kNow, kNow + 10);
  EXPECT_EQ(enroll(book, codes, kCode, kTouch, kNow + 11).error(), EnrollError::kExpired);
  EXPECT_TRUE(codes.empty());
  EXPECT_TRUE(book.empty());
}

TEST(Registry, ReplacesTheOldCodeOfANameAndRemovesExpiredOnes) {
  std::vector<CodeRow> codes;
  issue_code(codes, test::secret_from<16>(9), "gone", kNow - 100, kNow - 1);
  issue_code(codes, kCode, "a", kNow - 50, kNow + 10);
  issue_code(codes, test::secret_from<16>(2), "a", kNow, kNow + 20);
  ASSERT_EQ(codes.size(), 1u);
  std::vector<WorkstationRow> book;
  EXPECT_EQ(enroll(book, codes, kCode, kTouch, kNow).error(), EnrollError::kUnknownCode);
  EXPECT_TRUE(enroll(book, codes, test::secret_from<16>(2), kTouch, kNow));
}

TEST(Registry, ReassignsANameToANewKeyAndRejectsTheOldKey) {
  std::vector<WorkstationRow> book{{"a", kTouch.sha256, 1}};
  std::vector<CodeRow> codes;
  issue_code(codes, kCode, "a", kNow, kNow + 10);
  ASSERT_TRUE(enroll(book, codes, kCode, kOther, kNow));
  EXPECT_EQ(book.size(), 1u);
  EXPECT_EQ(find_workstation(book, kTouch), nullptr);
}

TEST(Registry, AllowsOneNamePerKey) {
  std::vector<WorkstationRow> book{{"a", kTouch.sha256, 1}};
  std::vector<CodeRow> codes;
  issue_code(codes, kCode, "b", kNow, kNow + 10);
  EXPECT_EQ(enroll(book, codes, kCode, kTouch, kNow).error(), EnrollError::kKeyTaken);
  EXPECT_EQ(codes.size(), 1u) << "the code was not used";
  issue_code(codes, test::secret_from<16>(2), "a", kNow, kNow + 10);
  EXPECT_TRUE(enroll(book, codes, test::secret_from<16>(2), kTouch, kNow)) << "the same name again is fine";
}

TEST(Registry, IsBounded) {
  std::vector<WorkstationRow> book;
  for (int i = 0; i < 4096; ++i) {
    KeyFingerprint fingerprint;
    fingerprint.sha256[0] = static_cast<std::byte>(i);
    fingerprint.sha256[1] = static_cast<std::byte>(i >> 8);
    fingerprint.sha256[2] = std::byte{1};
    book.push_back({"w" + std::to_string(i), fingerprint.sha256, 0});
  }
  std::vector<CodeRow> codes;
  issue_code(codes, kCode, "b", kNow, kNow + 10);
  EXPECT_EQ(enroll(book, codes, kCode, kTouch, kNow).error(), EnrollError::kBookFull);
}

TEST(Registry, RemovesTheKeyAndTheCodesOfARevokedName) {
  std::vector<WorkstationRow> book{{"a", kTouch.sha256, 1}, {"b", kOther.sha256, 1}};
  std::vector<CodeRow> codes;
  issue_code(codes, kCode, "a", kNow, kNow + 10);
  const Revoked gone = revoke(book, codes, "a");
  EXPECT_EQ(gone.workstations, 1u);
  EXPECT_EQ(gone.codes, 1u);
  EXPECT_EQ(find_workstation(book, kTouch), nullptr);
  EXPECT_NE(find_workstation(book, "b"), nullptr);
  EXPECT_EQ(revoke(book, codes, "a").workstations, 0u);
}

TEST(Registry, FindsServersByTheRemoteAddress) {
  std::vector<ServerRow> known;
  store_server(known, {"h:1", kTouch.sha256, "a"});
  store_server(known, {"h:2", kOther.sha256, "a"});
  store_server(known, {"h:1", kOther.sha256, "b"});
  ASSERT_EQ(known.size(), 2u);
  EXPECT_EQ(find_server(known, "h:1")->name, "b");
  EXPECT_EQ(find_server(known, "h:3"), nullptr);
}

TEST(Registry, AcceptsTheSameNamesAsSeats) {
  EXPECT_TRUE(is_valid_name("touch-07_A"));
  EXPECT_TRUE(is_valid_name(std::string(32, 'x')));
  for (const std::string bad : {"", "a b", "a/b", "..", "\xc3\xa4"}) EXPECT_FALSE(is_valid_name(bad));
  EXPECT_FALSE(is_valid_name(std::string(33, 'x')));
}

}  // namespace
}  // namespace tandem::auth
