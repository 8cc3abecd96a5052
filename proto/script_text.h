#pragma once

#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "proto/input_error.h"
#include "proto/script_spec.h"

namespace tandem {

/// A script as far as it could be read in spite of its mistakes.
struct ScriptReading {
  std::optional<ScriptSpec> spec;  ///< empty: too little was read
  InputErrors errors;
};
/// @param text, file_name, clients  as below
[[nodiscard]] ScriptReading read_script_text(std::string_view text, std::string_view file_name,
                                             std::span<const std::string> clients);

/// Reads a network script (proto/script.proto in text format, or JSON if the name ends in `.json`).
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages
/// @param clients    names that may be written; none: whole numbers from 1 (order of arrival at a proxy)
/// @return the script, or every mistake found, in file order
[[nodiscard]] std::expected<ScriptSpec, InputErrors> parse_script_text(std::string_view text,
                                                                       std::string_view file_name,
                                                                       std::span<const std::string> clients);

}  // namespace tandem
