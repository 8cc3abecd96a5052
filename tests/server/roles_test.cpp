// Who may do what: the design's table once more, written down a second time and cell by cell; and the datagrams of each role.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string_view>

#include "server/roles.h"

namespace tandem::server {
namespace {

// As in the table of design notes, security 1.5, in words. yes; no; anything else is a part, and says which.
struct Row {
  Right right;
  std::array<std::string_view, kAccessRoles> words;  // instructor, trainee, evaluator, observer, operator, recorder
};
constexpr std::array<Row, kRights> kDesign{{
    {Right::kDrive, {"yes", "when given", "no", "no", "no", "no"}},
    {Right::kForce, {"yes", "yes", "lower clamp and tank", "no", "no", "no"}},
    {Right::kTelemetry, {"yes", "own and shared", "yes", "60 Hz", "counters only", "yes"}},
    {Right::kAuthority, {"yes", "offer back own", "no", "no", "no", "no"}},
    {Right::kLowerLimits, {"yes", "own", "own", "no", "no", "no"}},
    {Right::kRaiseLimits, {"no", "no", "no", "no", "no", "no"}},
    {Right::kStopOwnHand, {"yes", "yes", "yes", "no", "no", "no"}},
    {Right::kStopSession, {"yes", "pause", "pause", "no", "yes", "no"}},
    {Right::kEndPause, {"yes", "own, where nobody leads", "own, where nobody leads", "no", "yes", "no"}},
    {Right::kRecord, {"yes", "no", "no", "no", "no", "writes"}},
    {Right::kManageSeats, {"yes", "no", "no", "no", "yes", "no"}},
    {Right::kManageServer, {"no", "no", "no", "no", "yes", "no"}},
}};

TEST(Roles, EveryCellIsTheDesigns) {
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

TEST(Roles, WhatIsNotInTheTableIsNobodys) {
  EXPECT_EQ(allowed(static_cast<AccessRole>(kAccessRoles), Right::kForce), Grant::kNo);
  EXPECT_EQ(allowed(static_cast<AccessRole>(255), Right::kForce), Grant::kNo);
  EXPECT_EQ(allowed(AccessRole::kInstructor, static_cast<Right>(kRights)), Grant::kNo);
  EXPECT_FALSE(allowed(static_cast<AccessRole>(kAccessRoles), wire::Type::kState));
}

TEST(Roles, OnlyWhoHasARightToAuthorityMaySendIt) {
  for (std::uint8_t c = 0; c < kAccessRoles; ++c) {
    const auto role = static_cast<AccessRole>(c);
    const bool may = role == AccessRole::kInstructor || role == AccessRole::kTrainee;
    EXPECT_EQ(allowed(role, wire::Type::kAuthority), may) << to_text(role);
    for (const auto type : {wire::Type::kState, wire::Type::kClose, wire::Type::kPathResponse}) EXPECT_TRUE(allowed(role, type));
    for (const auto type : {wire::Type::kForce, wire::Type::kPathChallenge, wire::Type::kPing, static_cast<wire::Type>(1), static_cast<wire::Type>(15)})
      EXPECT_FALSE(allowed(role, type)) << "types that go the other way, or nowhere";
  }
}

// Frames over the control connection: every kind there is, for every role and for who has not joined, once more by hand.
// Columns: not joined yet, instructor, trainee, evaluator, observer, operator, recorder.
struct KindRow {
  control::Kind kind;
  std::string_view may;  // x: yes
};
using control::Kind;
constexpr std::array<KindRow, control::kKinds> kFrames{{
    {Kind::kHello, "x------"},
    {Kind::kWelcome, "-------"},
    {Kind::kRefused, "-------"},
    {Kind::kEnrol, "x------"},
    {Kind::kEnrolAck, "-------"},
    {Kind::kSessionListRequest, "xxxxxxx"},
    {Kind::kSessionList, "-------"},
    {Kind::kStopSession, "-x---x-"},
    {Kind::kResumeSession, "-xxx-x-"},
    {Kind::kPauseSession, "-xxx-x-"},
    {Kind::kSetAuthority, "-xx----"},
    {Kind::kAuthorityAnswer, "-------"},
    {Kind::kDrain, "-----x-"},
    {Kind::kPing, "xxxxxxx"},
    {Kind::kPong, "-------"},
    {Kind::kDone, "-------"},
    {Kind::kRemovePerson, "-x---x-"},
    {Kind::kStatusRequest, "-xxxxxx"},
    {Kind::kStatus, "-------"},
}};

TEST(Roles, EveryFrameOfEveryRoleIsTheDesigns) {
  std::set<Kind> seen;
  for (const KindRow& row : kFrames) {
    seen.insert(row.kind);
    const int number = static_cast<int>(row.kind);
    EXPECT_EQ(allowed(std::nullopt, row.kind), row.may[0] == 'x') << number;
    for (std::uint8_t c = 0; c < kAccessRoles; ++c) {
      const auto role = static_cast<AccessRole>(c);
      EXPECT_EQ(allowed(role, row.kind), row.may[c + 1U] == 'x') << to_text(role) << ", kind " << number;
      if (row.may[c + 1U] != 'x') {
        EXPECT_FALSE(why_not(role, row.kind).empty());
      }
    }
    EXPECT_EQ(said_by_clients(row.kind), row.may.find('x') != std::string_view::npos) << number;
  }
  EXPECT_EQ(seen.size(), control::kKinds);
}

TEST(Roles, FramesOutsideTheTableAreNobodys) {
  for (const int number : {0, 1, 2, 22, 255}) {
    const auto kind = static_cast<Kind>(number);
    EXPECT_FALSE(said_by_clients(kind));
    EXPECT_FALSE(allowed(std::nullopt, kind));
    EXPECT_FALSE(allowed(AccessRole::kOperator, kind));
  }
  for (const KindRow& row : kFrames) EXPECT_FALSE(allowed(static_cast<AccessRole>(kAccessRoles), row.kind)) << static_cast<int>(row.kind);
}

TEST(Roles, ARefusalNamesWhoMay) {
  EXPECT_EQ(why_not(AccessRole::kTrainee, Kind::kStopSession), "the role trainee may not stop the session; who may: instructor, operator");
  EXPECT_EQ(why_not(AccessRole::kInstructor, Kind::kDrain), "the role instructor may not drain the server; who may: operator");
  EXPECT_NE(why_not(std::nullopt, Kind::kDrain).find("join first"), std::string::npos);
}

TEST(Roles, WhoWorksInASessionSitsOnASeat) {
  for (std::uint8_t c = 0; c < kAccessRoles; ++c) {
    const auto role = static_cast<AccessRole>(c);
    EXPECT_EQ(may_stand(role), role == AccessRole::kInstructor || role == AccessRole::kOperator || role == AccessRole::kRecorder) << to_text(role);
  }
  EXPECT_FALSE(may_stand(static_cast<AccessRole>(kAccessRoles)));
}

}  // namespace
}  // namespace tandem::server
