#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "proto/input_error.h"
#include "proto/scene_spec.h"

/// Scene files: Protocol Buffers text format against proto/scene.proto (JSON of the same schema if the name ends in
/// .json).
namespace tandem {

using SceneError = InputError;

/// Turns the text of a scene into numbers that cannot be wrong: every value finite and in range, every name resolved,
/// every row of weights summing to 1, every spring that meets a sampled device within its passivity limit
/// (k_c, k_s <= b / (T/2 + t_d), common/base/device_stiffness.h) unless the scene says `unsafe_gains` or the law softens it by itself.
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages; a name ending in `.json` selects JSON, where places are key paths only
/// @return the scene (its `name` is the file's name without folder and ending), or every mistake found, in file order
[[nodiscard]] std::expected<SceneSpec, InputErrors> parse_scene(std::string_view text, std::string_view file_name);

/// Puts another law in a scene, as if the scene had named it: the initial energy becomes the law's own, or stays what the scene
/// names if that is more.
void choose_law(SceneSpec& scene, LawKind law) noexcept;

/// Why the law of a scene's channel does not fit its other keys, if it does not. Callers that put another law in a scene ask after it.
struct LawProblem {
  std::string key;    ///< of the scene
  std::string words;  ///< follow the key
};
[[nodiscard]] std::optional<LawProblem> law_problem(const SceneSpec& scene);

/// Every value in force, defaults included, one per line: key, value and unit in three aligned columns. For `--check`.
[[nodiscard]] std::string effective_scene_text(const SceneSpec& scene);

}  // namespace tandem
