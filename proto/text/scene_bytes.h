#pragma once

#include <cstddef>
#include <expected>
#include <span>
#include <string>

#include "proto/spec/input_error.h"
#include "proto/spec/scene_spec.h"

/// A whole scene as bytes: the server sends it to watchers, inside Welcome.
namespace tandem {

/// Writes the scene as the protobuf message tandem.pb.Scene, with every value in force. Phases and changes of authority
/// that a shortened session does not reach are left out.
/// @return bytes written; 0 if it does not fit into `out`
[[nodiscard]] std::size_t encode_scene(const SceneSpec& scene, std::span<char> out);

/// Parses the output of encode_scene. Any input is safe: the ranges and rules of scene files are checked.
/// @param name  of the scene
/// @return the scene, or every error, by key path
[[nodiscard]] std::expected<SceneSpec, InputErrors> decode_scene(std::span<const char> bytes, const std::string& name);

/// Writes the scene as a scene file in text format, with every value in force. parse_scene reads the same scene from
/// it. If an option of a program shortened the session, so that it ends within a phase, the text has no duration_s,
/// because parse_scene would reject it.
[[nodiscard]] std::string scene_file_text(const SceneSpec& scene);

}  // namespace tandem
