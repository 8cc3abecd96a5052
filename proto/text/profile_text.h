#pragma once

#include <expected>
#include <string_view>

#include "proto/spec/input_error.h"
#include "proto/spec/profile_spec.h"

namespace tandem::netsim {

/// Parses a network profile (proto/schema/profile.proto in text format, or JSON if the name ends in `.json`).
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages and for the profile's name
/// @return the profile, or every error found, in file order
[[nodiscard]] std::expected<Profile, InputErrors> parse_profile_text(std::string_view text, std::string_view file_name);

}  // namespace tandem::netsim
