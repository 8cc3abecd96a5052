#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "proto/spec/scene_spec.h"

namespace tandem {

/// Role of a participant or console in a session (rights: server/policy/roles.cpp). The first four are the roles of a
/// scene's seats, with the same numbers; the other two have no seat. The number is a byte of tickets and of the
/// key-derivation context: append-only.
enum class AccessRole : std::uint8_t { kInstructor, kTrainee, kEvaluator, kObserver, kOperator, kRecorder };

inline constexpr std::uint8_t kAccessRoles = 6;

static_assert(static_cast<int>(AccessRole::kInstructor) == static_cast<int>(Role::kInstructor) &&
              static_cast<int>(AccessRole::kTrainee) == static_cast<int>(Role::kTrainee) &&
              static_cast<int>(AccessRole::kEvaluator) == static_cast<int>(Role::kEvaluator) &&
              static_cast<int>(AccessRole::kObserver) == static_cast<int>(Role::kObserver));

/// The role of the participant at a seat.
[[nodiscard]] constexpr AccessRole access_role(Role role) noexcept { return static_cast<AccessRole>(role); }

/// The role as shown on screens and command lines: `instructor`, ...; "?" for an unknown number.
[[nodiscard]] constexpr std::string_view to_text(AccessRole role) noexcept {
  constexpr std::string_view kNames[] = {"instructor", "trainee", "evaluator", "observer", "operator", "recorder"};
  return static_cast<std::uint8_t>(role) < kAccessRoles ? kNames[static_cast<std::uint8_t>(role)] : "?";
}
/// The role with this `to_text`; nothing if there is none.
[[nodiscard]] constexpr std::optional<AccessRole> access_role_named(std::string_view name) noexcept {
  for (std::uint8_t i = 0; i < kAccessRoles; ++i)
    if (to_text(static_cast<AccessRole>(i)) == name) return static_cast<AccessRole>(i);
  return std::nullopt;
}

}  // namespace tandem
