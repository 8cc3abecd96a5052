#pragma once

#include <string>
#include <string_view>

namespace tandem::server {

/// Depth of nested objects and arrays in a note that the server accepts.
inline constexpr int kNoteDepthMax = 8;

/// Returns why the server rejects the JSON of a note; empty: it is an object of at most kNoteDepthMax levels. Total.
/// @param json  at most rpc::kNoteMax bytes
[[nodiscard]] std::string note_problem(std::string_view json);

}  // namespace tandem::server
