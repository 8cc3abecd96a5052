#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "proto/input_error.h"
#include "proto/trust_spec.h"

/// The books of proto/trust.proto between text and rows. Reading is strict: unknown keys, values out of range, names or keys that come
/// twice are mistakes, all listed with file, line and remedy. A text without rows is an empty book.
namespace tandem {

[[nodiscard]] std::expected<std::vector<WorkstationRow>, InputErrors> parse_workstations(std::string_view text, std::string_view file);
[[nodiscard]] std::expected<std::vector<CodeRow>, InputErrors> parse_codes(std::string_view text, std::string_view file);
[[nodiscard]] std::expected<std::vector<ServerRow>, InputErrors> parse_servers(std::string_view text, std::string_view file);
[[nodiscard]] std::expected<ServingSpec, InputErrors> parse_serving(std::string_view text, std::string_view file);

/// What the parser of the same name reads back as the same rows.
[[nodiscard]] std::string print_workstations(const std::vector<WorkstationRow>& rows);
[[nodiscard]] std::string print_codes(const std::vector<CodeRow>& rows);
[[nodiscard]] std::string print_servers(const std::vector<ServerRow>& rows);
[[nodiscard]] std::string print_serving(const ServingSpec& serving);

}  // namespace tandem
