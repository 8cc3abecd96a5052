#include "server/roles.h"

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
    /* record        */ {yes, no, no, no, no, part},
    /* manage seats  */ {yes, no, no, no, yes, no},
    /* manage server */ {no, no, no, no, yes, no},
}};

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

}  // namespace tandem::server
