#pragma once

#include <cstddef>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "proto/spec/input_error.h"
#include "proto/spec/registry_spec.h"

/// Conversion of the files of a service and of its members (proto/schema/registry.proto) between text and rows. Parsing
/// is strict; all mistakes are listed with file, line and remedy. Signatures are checked elsewhere (common/auth).
namespace tandem {

[[nodiscard]] std::expected<MemberRow, InputErrors> parse_member(std::string_view text, std::string_view file);
/// @return the changes of the service's key, encoded, oldest first
[[nodiscard]] std::expected<std::vector<std::vector<std::byte>>, InputErrors> parse_service(std::string_view text,
                                                                                            std::string_view file);
[[nodiscard]] std::expected<std::vector<VouchedRow>, InputErrors> parse_vouched(std::string_view text,
                                                                                std::string_view file);

/// Text that the parser of the same name reads as the same values. That of a member holds a secret.
[[nodiscard]] std::string print_member(const MemberRow& member);
[[nodiscard]] std::string print_service(const std::vector<std::vector<std::byte>>& key_changes);
[[nodiscard]] std::string print_vouched(const std::vector<VouchedRow>& rows);

}  // namespace tandem
