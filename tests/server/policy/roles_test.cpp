// Rights of roles: an independent copy of the design's table, compared cell by cell; and the datagrams of each role.
#include "server/policy/roles.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string_view>

namespace tandem::server {
namespace {

// One row per right in words: yes, no, or a description of a partial right.
struct Row {
  Right right;
  std::array<std::string_view, kAccessRoles> words;  // instructor, trainee, evaluator, observer, operator, recorder
};
constexpr std::array<Row, kRights> kDesign{{
    {Right::kDrive, {"yes", "when given", "no", "no", "no", "no"}},
    {Right::kForce, {"yes", "yes", "lower clamp and tank", "no", "no", "no"}},
    {Right::kTelemetry, {"yes", "own and shared", "yes", "60 Hz", "counters only", "yes"}},
    {Right::kAuthority, {"yes", "offer back own", "no", "no", "no", "no"}},
    {Right::kStopSession, {"yes", "pause", "pause", "no", "yes", "no"}},
    {Right::kEndPause, {"yes", "own, without instructor", "own, without instructor", "no", "yes", "no"}},
    {Right::kManageSeats, {"yes", "no", "no", "no", "yes", "no"}},
    {Right::kManageServer, {"no", "no", "no", "no", "yes", "no"}},
    {Right::kScore, {"yes", "no", "yes", "no", "yes", "no"}},
    {Right::kRecord, {"yes", "no", "no", "no", "yes", "no"}},
}};

TEST(Roles, MatchTheDesignTableInEveryRight) {
  std::set<Right> seen;
  for (const Row& row : kDesign) {
    seen.insert(row.right);
    for (std::uint8_t c = 0; c < kAccessRoles; ++c) {
      const Grant wanted = row.words[c] == "yes" ? Grant::kYes : row.words[c] == "no" ? Grant::kNo : Grant::kPart;
      EXPECT_EQ(allowed(static_cast<AccessRole>(c), row.right), wanted)
          << to_text(static_cast<AccessRole>(c)) << ", right " << static_cast<int>(row.right);
    }
  }
  EXPECT_EQ(seen.size(), kRights);
}

TEST(Roles, GrantNothingOutsideTheTable) {
  EXPECT_EQ(allowed(static_cast<AccessRole>(kAccessRoles), Right::kForce), Grant::kNo);
  EXPECT_EQ(allowed(static_cast<AccessRole>(255), Right::kForce), Grant::kNo);
  EXPECT_EQ(allowed(AccessRole::kInstructor, static_cast<Right>(kRights)), Grant::kNo);
  EXPECT_FALSE(allowed(static_cast<AccessRole>(kAccessRoles), wire::Type::kState));
}

TEST(Roles, LetOnlyInstructorsAndTraineesSendAuthority) {
  for (std::uint8_t c = 0; c < kAccessRoles; ++c) {
    const auto role = static_cast<AccessRole>(c);
    const bool may = role == AccessRole::kInstructor || role == AccessRole::kTrainee;
    EXPECT_EQ(allowed(role, wire::Type::kAuthority), may) << to_text(role);
    for (const auto type : {wire::Type::kState, wire::Type::kClose, wire::Type::kPathResponse})
      EXPECT_TRUE(allowed(role, type));
    for (const auto type : {wire::Type::kForce, wire::Type::kPathChallenge, wire::Type::kPing, wire::Type::kLinkProbe,
                            wire::Type::kLinkReport, wire::Type::kTelemetry, wire::Type::kWatch,
                            static_cast<wire::Type>(1), static_cast<wire::Type>(15)})
      EXPECT_FALSE(allowed(role, type)) << "types that go the other way, or nowhere";
  }
}

// Frames on the control connection: an independent copy for every kind and role, and for clients that have not joined.
// Columns: not joined, instructor, trainee, evaluator, observer, operator, recorder.
struct KindRow {
  rpc::Kind kind;
  std::string_view may;  // x: yes
};
using rpc::Kind;
constexpr std::array<KindRow, rpc::kKinds> kFrames{{
    {Kind::kHello, "x------"},
    {Kind::kWelcome, "-------"},
    {Kind::kErrorReply, "-------"},
    {Kind::kEnroll, "x------"},
    {Kind::kEnrollAck, "-------"},
    {Kind::kSessionListRequest, "xxxxxxx"},
    {Kind::kSessionList, "-------"},
    {Kind::kStopSession, "-x---x-"},
    {Kind::kResumeSession, "-xxx-x-"},
    {Kind::kPauseSession, "-xxx-x-"},
    {Kind::kSetAuthority, "-xx----"},
    {Kind::kAuthorityReply, "-------"},
    {Kind::kDrain, "-----x-"},
    {Kind::kPing, "xxxxxxx"},
    {Kind::kPong, "-------"},
    {Kind::kOk, "-------"},
    {Kind::kRemoveParticipant, "-x---x-"},
    {Kind::kStatusRequest, "-xxxxxx"},
    {Kind::kStatus, "-------"},
    {Kind::kCreateSession, "-----x-"},
    {Kind::kSessionCreated, "-------"},
    {Kind::kEndSession, "-----x-"},
    {Kind::kNote, "-x-x-x-"},
    {Kind::kSceneListRequest, "-----x-"},
    {Kind::kSceneList, "-------"},
    {Kind::kNotesRequest, "-x-x-x-"},
    {Kind::kNoteList, "-------"},
    {Kind::kRecordSession, "-x---x-"},
    {Kind::kElsewhere, "-------"},
}};

TEST(Roles, MatchTheDesignTableForEveryFrame) {
  std::set<Kind> seen;
  for (const KindRow& row : kFrames) {
    seen.insert(row.kind);
    const int number = static_cast<int>(row.kind);
    EXPECT_EQ(allowed(std::nullopt, row.kind), row.may[0] == 'x') << number;
    for (std::uint8_t c = 0; c < kAccessRoles; ++c) {
      const auto role = static_cast<AccessRole>(c);
      EXPECT_EQ(allowed(role, row.kind), row.may[c + 1U] == 'x') << to_text(role) << ", kind " << number;
      if (row.may[c + 1U] != 'x') {
        EXPECT_FALSE(forbidden_text(role, row.kind).empty());
      }
    }
    EXPECT_EQ(is_client_message(row.kind), row.may.find('x') != std::string_view::npos) << number;
  }
  EXPECT_EQ(seen.size(), rpc::kKinds);
}

TEST(Roles, AllowNoFrameOutsideTheTable) {
  for (const int number : {0, 1, 2, 32, 255}) {
    const auto kind = static_cast<Kind>(number);
    EXPECT_FALSE(is_client_message(kind));
    EXPECT_FALSE(allowed(std::nullopt, kind));
    EXPECT_FALSE(allowed(AccessRole::kOperator, kind));
  }
  for (const KindRow& row : kFrames)
    EXPECT_FALSE(allowed(static_cast<AccessRole>(kAccessRoles), row.kind)) << static_cast<int>(row.kind);
}

TEST(Roles, NameThePermittedRolesInARejection) {
  EXPECT_EQ(forbidden_text(AccessRole::kTrainee, Kind::kStopSession),
            "the role trainee may not stop the session; permitted for: instructor, operator");
  EXPECT_EQ(forbidden_text(AccessRole::kInstructor, Kind::kDrain),
            "the role instructor may not drain the server; permitted for: operator");
  EXPECT_NE(forbidden_text(std::nullopt, Kind::kDrain).find("join first"), std::string::npos);
}

// Every role sees at least its own and the shared values at 60 Hz, so each may watch from a console.
TEST(Roles, LetEveryRoleWatchFromAConsole) {
  for (std::uint8_t c = 0; c < kAccessRoles; ++c) EXPECT_TRUE(may_join_console(static_cast<AccessRole>(c)));
  EXPECT_FALSE(may_join_console(static_cast<AccessRole>(kAccessRoles)));
}

// Frames of consoles: an independent copy. Columns: instructor, trainee, evaluator, observer, operator, recorder.
constexpr std::array<KindRow, 12> kConsoleFrames{{
    {Kind::kSessionListRequest, "xxxxxx"},
    {Kind::kPing, "xxxxxx"},
    {Kind::kStatusRequest, "xxxxxx"},
    {Kind::kStopSession, "x---x-"},
    {Kind::kPauseSession, "x-x-x-"},
    {Kind::kResumeSession, "x-x-x-"},
    {Kind::kSetAuthority, "x-----"},
    {Kind::kRemoveParticipant, "x---x-"},
    {Kind::kDrain, "----x-"},
    {Kind::kCreateSession, "----x-"},
    {Kind::kEndSession, "----x-"},
    {Kind::kNote, "x-x-x-"},
}};

TEST(Roles, LetConsolesOfTraineesAndObserversOnlyWatch) {
  std::set<Kind> seen;
  for (const KindRow& row : kConsoleFrames) {
    seen.insert(row.kind);
    for (std::uint8_t c = 0; c < kAccessRoles; ++c) {
      const auto role = static_cast<AccessRole>(c);
      EXPECT_EQ(allowed_without_seat(role, row.kind), row.may[c] == 'x')
          << to_text(role) << ", kind " << static_cast<int>(row.kind);
    }
  }
  for (std::size_t i = 0; i < rpc::kKinds; ++i) {
    const auto kind = static_cast<Kind>(static_cast<std::size_t>(Kind::kHello) + i);
    for (std::uint8_t c = 0; c < kAccessRoles; ++c) {
      const auto role = static_cast<AccessRole>(c);
      EXPECT_TRUE(allowed(role, kind) || !allowed_without_seat(role, kind)) << "a console has no right of its own";
      if (!allowed_without_seat(role, kind)) {
        EXPECT_FALSE(forbidden_text_without_seat(role, kind).empty());
      }
      if (!seen.contains(kind)) {
        EXPECT_EQ(allowed_without_seat(role, kind), allowed(role, kind));
      }
    }
  }
  EXPECT_EQ(forbidden_text_without_seat(AccessRole::kTrainee, Kind::kPauseSession),
            "the role trainee may pause the session from a seat only; without a seat it watches the session");
  EXPECT_EQ(forbidden_text_without_seat(AccessRole::kTrainee, Kind::kStopSession),
            forbidden_text(AccessRole::kTrainee, Kind::kStopSession));
}

}  // namespace
}  // namespace tandem::server
