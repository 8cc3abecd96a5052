#pragma once

#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "proto/spec/input_error.h"
#include "proto/spec/script_spec.h"

namespace tandem {

/// A script with its errors, as far as it was readable.
struct ScriptReading {
  std::optional<ScriptSpec> spec;  ///< absent: too little was readable
  InputErrors errors;
};
/// Parses a script and keeps the readable parts of an invalid one. @param text, file_name, clients  as below
[[nodiscard]] ScriptReading read_script_text(std::string_view text, std::string_view file_name,
                                             std::span<const std::string> clients);

/// Parses a network script (proto/schema/script.proto in text format, or JSON if the name ends in `.json`).
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages
/// @param clients    allowed names; empty: whole numbers from 1 (order of arrival at a proxy)
/// @return the script, or every error found, in file order
[[nodiscard]] std::expected<ScriptSpec, InputErrors> parse_script_text(std::string_view text,
                                                                       std::string_view file_name,
                                                                       std::span<const std::string> clients);

}  // namespace tandem
