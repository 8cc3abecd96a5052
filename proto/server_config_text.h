#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "proto/server_config_spec.h"

namespace tandem {

/// Reads a configuration (JSON of the same schema if the name ends in .json).
/// @return the configuration, or every mistake found, in file order. Addresses, scenes and folders are only texts so far.
[[nodiscard]] std::expected<ServerConfigSpec, InputErrors> parse_server_config(std::string_view text, std::string_view file_name);

/// The same, for whoever wants to look further whatever is wrong so far.
/// @param errors  what was found  @return what could be read; nothing if the text is no document at all
[[nodiscard]] std::optional<ServerConfigSpec> read_server_config(std::string_view text, std::string_view file_name, InputErrors& errors);

/// Every value in force, defaults included, one per line: key, value and unit in three aligned columns. For `--check`.
[[nodiscard]] std::string effective_server_config_text(const ServerConfigSpec& config);

}  // namespace tandem
