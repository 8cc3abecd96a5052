#pragma once

#include <expected>
#include <string>

#include "proto/input_error.h"
#include "proto/scene_spec.h"

namespace tandem {

/// Loads what a person typed as SCENE: a path, or the bare name of a shipped scene.
/// A file that exists wins over a shipped scene of the same name; a name with a slash or an ending is always a path.
/// @return the scene, or every mistake; for a missing file the nearest shipped name and the list of all
[[nodiscard]] std::expected<SceneSpec, InputErrors> load_scene(const std::string& path_or_name);

/// Reads at most 1 MiB of text. @return the text, or one mistake that says why not
[[nodiscard]] std::expected<std::string, InputErrors> read_text_file(const std::string& path);

}  // namespace tandem
