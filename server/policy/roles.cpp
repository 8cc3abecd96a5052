#include "server/policy/roles.h"

#include <algorithm>
#include <array>

#include "common/base/enumerator_count.h"

namespace tandem::server {

static_assert(kRights == enumerator_count<Right>());

namespace {

using enum Grant;

// Rows: rights. Columns: instructor, trainee, evaluator, observer, operator, recorder.
constexpr std::array<std::array<Grant, kAccessRoles>, kRights> kTable{{
    /* drive         */ {kYes, kPart, kNo, kNo, kNo, kNo},
    /* force         */ {kYes, kYes, kPart, kNo, kNo, kNo},
    /* telemetry     */ {kYes, kPart, kYes, kPart, kPart, kYes},
    /* authority     */ {kYes, kPart, kNo, kNo, kNo, kNo},
    /* stop session  */ {kYes, kPart, kPart, kNo, kYes, kNo},
    /* end a pause   */ {kYes, kPart, kPart, kNo, kYes, kNo},
    /* manage seats  */ {kYes, kNo, kNo, kNo, kYes, kNo},
    /* manage server */ {kNo, kNo, kNo, kNo, kYes, kNo},
    /* score         */ {kYes, kNo, kYes, kNo, kYes, kNo},
    /* record        */ {kYes, kNo, kNo, kNo, kYes, kNo},
}};

/// Permission that a frame requires: at least `least` of `right`.
struct Need {
  rpc::Kind kind;
  Right right;
  Grant least;
  const char* words;  ///< "... may not WORDS"
};
constexpr std::array<Need, 11> kNeeds{{
    {rpc::Kind::kStopSession, Right::kStopSession, Grant::kYes, "stop the session"},
    {rpc::Kind::kPauseSession, Right::kStopSession, Grant::kPart, "pause the session"},
    {rpc::Kind::kResumeSession, Right::kEndPause, Grant::kPart, "resume the session"},
    {rpc::Kind::kSetAuthority, Right::kAuthority, Grant::kPart, "move authority"},
    {rpc::Kind::kRemoveParticipant, Right::kManageSeats, Grant::kYes, "remove a participant"},
    {rpc::Kind::kDrain, Right::kManageServer, Grant::kYes, "drain the server"},
    {rpc::Kind::kStatusRequest, Right::kTelemetry, Grant::kPart, "see the session's status"},
    {rpc::Kind::kCreateSession, Right::kManageServer, Grant::kYes, "create a session"},
    {rpc::Kind::kEndSession, Right::kManageServer, Grant::kYes, "end a session"},
    {rpc::Kind::kNote, Right::kScore, Grant::kYes, "write marks and sheets"},
    {rpc::Kind::kRecordSession, Right::kRecord, Grant::kYes, "start or end a recording"},
}};

const Need* need_of(rpc::Kind kind) noexcept {
  const auto found = std::ranges::find(kNeeds, kind, &Need::kind);
  return found == kNeeds.end() ? nullptr : &*found;
}

}  // namespace

Grant allowed(AccessRole role, Right right) noexcept {
  const auto r = static_cast<std::size_t>(right);
  const auto c = static_cast<std::size_t>(role);
  return r < kRights && c < kAccessRoles ? kTable[r][c] : Grant::kNo;
}

bool allowed(AccessRole role, wire::Type from_client) noexcept {
  switch (from_client) {
    case wire::Type::kState:  // the session checks each field of STATE separately
    case wire::Type::kPathResponse:
    case wire::Type::kClose:
      return static_cast<std::uint8_t>(role) < kAccessRoles;
    case wire::Type::kAuthority:
      return allowed(role, Right::kAuthority) != Grant::kNo;
    case wire::Type::kForce:
    case wire::Type::kPathChallenge:
    case wire::Type::kPing:
    case wire::Type::kLinkProbe:  // of link-test peers, which have no role
    case wire::Type::kLinkReport:
    case wire::Type::kTelemetry:
    case wire::Type::kWatch:  // of watchers, which have a console's role and no seat
      return false;
  }
  return false;
}

bool is_client_message(rpc::Kind kind) noexcept {
  using rpc::Kind;
  const bool asks =
      kind == Kind::kHello || kind == Kind::kEnroll || kind == Kind::kSessionListRequest || kind == Kind::kPing;
  return asks || need_of(kind) != nullptr;
}

bool allowed(std::optional<AccessRole> standing, rpc::Kind kind) noexcept {
  using rpc::Kind;
  if (kind == Kind::kSessionListRequest || kind == Kind::kPing)
    return !standing || static_cast<std::uint8_t>(*standing) < kAccessRoles;
  if (kind == Kind::kHello || kind == Kind::kEnroll) return !standing;
  const Need* const need = need_of(kind);
  return need != nullptr && standing && allowed(*standing, need->right) >= need->least;
}

std::string forbidden_text(std::optional<AccessRole> standing, rpc::Kind kind) {
  if (!standing) return "join first: the permitted commands depend on the role";
  if (kind == rpc::Kind::kHello || kind == rpc::Kind::kEnroll)
    return "this connection has joined already; open another one";
  const Need* const need = need_of(kind);
  if (need == nullptr) return "clients must not send this message";
  std::string who;
  for (std::uint8_t r = 0; r < kAccessRoles; ++r) {
    const auto role = static_cast<AccessRole>(r);
    if (allowed(role, kind)) who += (who.empty() ? "" : ", ") + std::string(to_text(role));
  }
  return "the role " + std::string(to_text(*standing)) + " may not " + need->words + "; permitted for: " + who;
}

bool may_join_console(AccessRole role) noexcept {
  return role == AccessRole::kInstructor || role == AccessRole::kEvaluator || role == AccessRole::kOperator ||
         role == AccessRole::kRecorder;
}

}  // namespace tandem::server
