#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "proto/spec/input_error.h"
#include "proto/spec/registry_spec.h"

/// Conversion of the registry files of proto/schema/registry.proto between text and rows. Parsing is strict: unknown
/// keys, values out of range, and repeated names or keys are errors. All are listed with file, line and remedy. A text
/// without rows is valid.
namespace tandem {

[[nodiscard]] std::expected<std::vector<WorkstationRow>, InputErrors> parse_workstations(std::string_view text,
                                                                                         std::string_view file);
[[nodiscard]] std::expected<std::vector<CodeRow>, InputErrors> parse_codes(std::string_view text,
                                                                           std::string_view file);
[[nodiscard]] std::expected<std::vector<ServerRow>, InputErrors> parse_servers(std::string_view text,
                                                                               std::string_view file);
[[nodiscard]] std::expected<ServingSpec, InputErrors> parse_serving(std::string_view text, std::string_view file);

/// Text that the parser of the same name reads as the same rows.
[[nodiscard]] std::string print_workstations(const std::vector<WorkstationRow>& rows);
[[nodiscard]] std::string print_codes(const std::vector<CodeRow>& rows);
[[nodiscard]] std::string print_servers(const std::vector<ServerRow>& rows);
[[nodiscard]] std::string print_serving(const ServingSpec& serving);

}  // namespace tandem
