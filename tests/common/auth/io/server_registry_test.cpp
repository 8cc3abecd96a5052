// Workstations and codes of a server, in memory and in a state directory that several programs share.
#include "common/auth/io/server_registry.h"

#include <gtest/gtest.h>

#include "tests/common/auth/io/temporary_folder.h"

namespace tandem::auth {
namespace {

constexpr std::int64_t kNow = 1'000'000;

EnrolmentCode code_of(unsigned number) {
  EnrolmentCode code;
  code.bytes[0] = static_cast<std::byte>(number);
  return code;
}
KeyFingerprint key_of(unsigned number) { return {{static_cast<std::byte>(number)}}; }

/// State directory for the registries of two programs.
struct SharedRegistry {
  [[nodiscard]] ServerRegistry open() const {
    return {std::make_shared<StateDirectory>(
                std::move(*StateDirectory::open(folder.path("state"), StateDirectory::Missing::kIsMade))),
            std::make_shared<AuditLog>()};
  }
  test::Folder folder;
};

TEST(ServerRegistry, EnrollsAWorkstationOnceByItsCode) {
  ServerRegistry registry{nullptr, nullptr};
  EXPECT_EQ(registry.issue_code(code_of(1), "touch-07", kNow, kNow + 60), "");
  EXPECT_EQ(registry.pending_codes(kNow + 60), 1U);
  EXPECT_EQ(registry.pending_codes(kNow + 61), 0U) << "expired";
  EXPECT_EQ(registry.find(key_of(5)).value(), std::optional<WorkstationRow>{});

  const auto row = registry.enroll(code_of(1), key_of(5), kNow + 10);
  ASSERT_TRUE(row) << row.error().text;
  EXPECT_EQ(*row, (WorkstationRow{"touch-07", key_of(5).sha256, kNow + 10}));
  EXPECT_EQ(registry.find(key_of(5)).value(), std::optional(*row));
  EXPECT_EQ(registry.workstations(), std::vector{*row});
  EXPECT_EQ(registry.pending_codes(kNow), 0U);
  const auto again = registry.enroll(code_of(1), key_of(6), kNow + 10);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().fault, EnrollError::kUnknownCode);
}

TEST(ServerRegistry, RejectsAnExpiredCode) {
  ServerRegistry registry{nullptr, nullptr};
  EXPECT_EQ(registry.issue_code(code_of(1), "touch-07", kNow, kNow + 60), "");
  const auto late = registry.enroll(code_of(1), key_of(5), kNow + 61);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().fault, EnrollError::kExpired);
}

TEST(ServerRegistry, RevokesAWorkstationAndItsCode) {
  ServerRegistry registry{nullptr, nullptr};
  EXPECT_EQ(registry.enroll_without_code({"touch-07", key_of(5).sha256, kNow}), "");
  EXPECT_EQ(registry.enroll_without_code({"desk", key_of(6).sha256, kNow}), "");
  EXPECT_EQ(registry.issue_code(code_of(1), "touch-07", kNow, kNow + 60), "");
  const auto gone = registry.revoke("touch-07");
  ASSERT_TRUE(gone) << gone.error();
  EXPECT_EQ(gone->workstations, 1U);
  EXPECT_EQ(gone->codes, 1U);
  EXPECT_EQ(registry.find(key_of(5)).value(), std::optional<WorkstationRow>{});
  EXPECT_TRUE(registry.find(key_of(6))->has_value());
  EXPECT_EQ(registry.pending_codes(kNow), 0U);
}

TEST(ServerRegistry, EnrollsAKeyOrNameAgainInPlaceOfTheOldRow) {
  ServerRegistry registry{nullptr, nullptr};
  EXPECT_EQ(registry.enroll_without_code({"desk", key_of(5).sha256, kNow}), "");
  EXPECT_EQ(registry.enroll_without_code({"desk", key_of(6).sha256, kNow}), "");
  EXPECT_EQ(registry.enroll_without_code({"office", key_of(6).sha256, kNow}), "");
  EXPECT_EQ(registry.workstations(), (std::vector<WorkstationRow>{{"office", key_of(6).sha256, kNow}}));
}

TEST(ServerRegistry, SeesChangesOfAnotherProgramAtOnce) {
  const SharedRegistry shared;
  ServerRegistry server = shared.open(), command = shared.open();
  EXPECT_EQ(server.find(key_of(5)).value(), std::optional<WorkstationRow>{});
  EXPECT_EQ(command.issue_code(code_of(1), "touch-07", kNow, kNow + 60), "");
  EXPECT_EQ(server.pending_codes(kNow), 1U);
  ASSERT_TRUE(server.enroll(code_of(1), key_of(5), kNow));
  EXPECT_EQ(command.workstations(), (std::vector<WorkstationRow>{{"touch-07", key_of(5).sha256, kNow}}));
  ASSERT_TRUE(command.revoke("touch-07"));
  EXPECT_EQ(server.find(key_of(5)).value(), std::optional<WorkstationRow>{});
}

TEST(ServerRegistry, ReportsAnUnreadableListAndAdmitsNoWorkstation) {
  const SharedRegistry shared;
  ServerRegistry registry = shared.open();
  EXPECT_EQ(registry.problem(), "");
  EXPECT_EQ(registry.enroll_without_code({"desk", key_of(5).sha256, kNow}), "");
  shared.folder.write("state/workstations.textproto", "no list");
  EXPECT_FALSE(registry.find(key_of(5)));
  EXPECT_FALSE(registry.workstations());
  EXPECT_NE(registry.problem().find("workstations.textproto"), std::string::npos) << registry.problem();
  EXPECT_NE(registry.enroll_without_code({"office", key_of(6).sha256, kNow}), "") << "it would lose the other rows";
}

}  // namespace
}  // namespace tandem::auth
