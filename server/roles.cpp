#include "server/roles.h"

#include <algorithm>
#include <array>

namespace tandem::server {

namespace {

constexpr Grant no = Grant::kNo, part = Grant::kPart, yes = Grant::kYes;

// Rows: rights. Columns: instructor, trainee, evaluator, observer, operator, recorder.
constexpr std::array<std::array<Grant, kAccessRoles>, kRights> kTable{{
    /* drive         */ {yes, part, no, no, no, no},
    /* force         */ {yes, yes, part, no, no, no},
    /* telemetry     */ {yes, part, yes, part, part, yes},
    /* authority     */ {yes, part, no, no, no, no},
    /* lower limits  */ {yes, part, part, no, no, no},
    /* raise limits  */ {no, no, no, no, no, no},
    /* stop own hand */ {yes, yes, yes, no, no, no},
    /* stop session  */ {yes, part, part, no, yes, no},
    /* end a pause   */ {yes, part, part, no, yes, no},
    /* record        */ {yes, no, no, no, no, part},
    /* manage seats  */ {yes, no, no, no, yes, no},
    /* manage server */ {no, no, no, no, yes, no},
}};

/// What a frame asks for: at least `least` of `right`.
struct Need {
  control::Kind kind;
  Right right;
  Grant least;
  const char* words;  ///< "... may not WORDS"
};
constexpr std::array<Need, 7> kNeeds{{
    {control::Kind::kStopSession, Right::kStopSession, Grant::kYes, "stop the session"},
    {control::Kind::kPauseSession, Right::kStopSession, Grant::kPart, "pause the session"},
    {control::Kind::kResumeSession, Right::kEndPause, Grant::kPart, "resume the session"},
    {control::Kind::kSetAuthority, Right::kAuthority, Grant::kPart, "move authority"},
    {control::Kind::kRemovePerson, Right::kManageSeats, Grant::kYes, "remove a person"},
    {control::Kind::kDrain, Right::kManageServer, Grant::kYes, "drain the server"},
    {control::Kind::kStatusRequest, Right::kTelemetry, Grant::kPart, "see the session's status"},
}};

const Need* need_of(control::Kind kind) noexcept {
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
    case wire::Type::kState:  // what in it acts is decided field by field
    case wire::Type::kPathResponse:
    case wire::Type::kClose:
      return static_cast<std::uint8_t>(role) < kAccessRoles;
    case wire::Type::kAuthority:
      return allowed(role, Right::kAuthority) != Grant::kNo;
    case wire::Type::kForce:
    case wire::Type::kPathChallenge:
    case wire::Type::kPing:
      return false;
  }
  return false;
}

bool said_by_clients(control::Kind kind) noexcept {
  using control::Kind;
  const bool asks = kind == Kind::kHello || kind == Kind::kEnrol || kind == Kind::kSessionListRequest || kind == Kind::kPing;
  return asks || need_of(kind) != nullptr;
}

bool allowed(std::optional<AccessRole> standing, control::Kind kind) noexcept {
  using control::Kind;
  if (kind == Kind::kSessionListRequest || kind == Kind::kPing) return !standing || static_cast<std::uint8_t>(*standing) < kAccessRoles;
  if (kind == Kind::kHello || kind == Kind::kEnrol) return !standing;
  const Need* const need = need_of(kind);
  return need != nullptr && standing && allowed(*standing, need->right) >= need->least;
}

std::string why_not(std::optional<AccessRole> standing, control::Kind kind) {
  if (!standing) return "join first: what somebody may order depends on his role";
  if (kind == control::Kind::kHello || kind == control::Kind::kEnrol) return "this connection has joined already; open another one";
  const Need* const need = need_of(kind);
  if (need == nullptr) return "nobody may say this to a server";
  std::string who;
  for (std::uint8_t r = 0; r < kAccessRoles; ++r) {
    const auto role = static_cast<AccessRole>(r);
    if (allowed(role, kind)) who += (who.empty() ? "" : ", ") + std::string(to_text(role));
  }
  return "the role " + std::string(to_text(*standing)) + " may not " + need->words + "; who may: " + who;
}

bool may_stand(AccessRole role) noexcept { return role == AccessRole::kInstructor || role == AccessRole::kOperator || role == AccessRole::kRecorder; }

}  // namespace tandem::server
