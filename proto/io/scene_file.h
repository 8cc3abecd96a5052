#pragma once

#include <expected>
#include <string>

#include "proto/spec/input_error.h"
#include "proto/spec/scene_spec.h"

namespace tandem {

/// Loads the scene of a SCENE argument: a path, or the bare name of a shipped scene. An existing file takes precedence
/// over a shipped scene of the same name. A name with a slash or an extension is always a path.
/// @return the scene, or all errors; for a missing file the most similar shipped name and the list of all
[[nodiscard]] std::expected<SceneSpec, InputErrors> load_scene(const std::string& path_or_name);

/// Reads at most 1 MiB of text. @return the text, or one error with the cause
[[nodiscard]] std::expected<std::string, InputErrors> read_text_file(const std::string& path);

}  // namespace tandem
