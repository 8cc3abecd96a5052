#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "proto/spec/input_error.h"
#include "proto/spec/scene_spec.h"

/// Scene files: Protocol Buffers text format against proto/schema/scene.proto (JSON of the same schema if the name ends
/// in .json).
namespace tandem {

/// One error in a scene.
using SceneError = InputError;

/// Parses a scene and validates it completely: every value is finite and in range, and every name is resolved. Every
/// authority row sums to 1. Every spring that acts on a sampled device is within its passivity limit (k_c, k_s <= b /
/// (T/2 + t_d), common/base/stiffness_limit.h). The last rule does not apply if the scene sets `unsafe_gains` or if the
/// law reduces the spring.
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages; a name ending in `.json` selects JSON, where locations are key paths only
/// @return the scene (its `name` is the file name without folder and extension), or every error found, in file order
[[nodiscard]] std::expected<SceneSpec, InputErrors> parse_scene(std::string_view text, std::string_view file_name);

/// Replaces the law of a scene as if the scene had set it. The initial energy becomes the default of the law, or stays
/// at the scene's value if that is larger.
void choose_law(SceneSpec& scene, LawKind law) noexcept;

/// Conflict between the law of a scene's channel and its other keys. Callers of choose_law check it afterwards.
struct LawProblem {
  std::string key;    ///< key in the scene
  std::string words;  ///< message that follows the key
};
/// Returns the first conflict of a scene; empty if there is none.
[[nodiscard]] std::optional<LawProblem> law_problem(const SceneSpec& scene);

/// Every value in force, including defaults, one per line: key, value and unit in three aligned columns. For `--check`.
[[nodiscard]] std::string effective_scene_text(const SceneSpec& scene);

}  // namespace tandem
