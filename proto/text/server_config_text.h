#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "proto/spec/server_config_spec.h"

namespace tandem {

/// Parses a configuration (JSON of the same schema if the name ends in .json).
/// @return the configuration, or every error found, in file order. Addresses, scenes and folders are not resolved.
[[nodiscard]] std::expected<ServerConfigSpec, InputErrors> parse_server_config(std::string_view text,
                                                                               std::string_view file_name);

/// The same, for callers that continue with other checks after an error.
/// @param errors  receives the errors  @return the readable part; nothing if the text is no document at all
[[nodiscard]] std::optional<ServerConfigSpec> read_server_config(std::string_view text, std::string_view file_name,
                                                                 InputErrors& errors);

/// Every value in force, including defaults, one per line: key, value and unit in three aligned columns. For `--check`.
[[nodiscard]] std::string effective_server_config_text(const ServerConfigSpec& config);

}  // namespace tandem
