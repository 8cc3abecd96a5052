#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "proto/scene_spec.h"

namespace tandem {

/// What somebody is allowed in a session (design notes, security 1.5). The first four are the roles of a scene's seats, with the same
/// numbers; the other two sit on no seat. The number is a byte of tickets and of the context that keys come from: append-only.
enum class AccessRole : std::uint8_t { kInstructor, kTrainee, kEvaluator, kObserver, kOperator, kRecorder };

inline constexpr std::uint8_t kAccessRoles = 6;

static_assert(static_cast<int>(AccessRole::kInstructor) == static_cast<int>(Role::kInstructor) &&
              static_cast<int>(AccessRole::kTrainee) == static_cast<int>(Role::kTrainee) &&
              static_cast<int>(AccessRole::kEvaluator) == static_cast<int>(Role::kEvaluator) &&
              static_cast<int>(AccessRole::kObserver) == static_cast<int>(Role::kObserver));

/// The role of who sits on a seat.
[[nodiscard]] constexpr AccessRole access_role(Role role) noexcept { return static_cast<AccessRole>(role); }

/// For people and command lines: `instructor`, ...
[[nodiscard]] constexpr std::string_view to_text(AccessRole role) noexcept {
  constexpr std::string_view kNames[] = {"instructor", "trainee", "evaluator", "observer", "operator", "recorder"};
  return static_cast<std::uint8_t>(role) < kAccessRoles ? kNames[static_cast<std::uint8_t>(role)] : "?";
}
/// The role that `to_text` calls so.
[[nodiscard]] constexpr std::optional<AccessRole> access_role_named(std::string_view name) noexcept {
  for (std::uint8_t i = 0; i < kAccessRoles; ++i)
    if (to_text(static_cast<AccessRole>(i)) == name) return static_cast<AccessRole>(i);
  return std::nullopt;
}

}  // namespace tandem
