#pragma once

#include <expected>
#include <span>
#include <string_view>

#include "proto/spec/input_error.h"
#include "proto/spec/profile_spec.h"
#include "proto/text/embedded_file.h"

/// Named networks. A profile is a text file (proto/schema/profile.proto) with parameters, their sources and a version.
namespace tandem::netsim {

/// Inserts a recorded capacity (netsim/profiles/capacity_csv.h) into the recorded rates of a link.
/// @return true if the link has a recorded rate
bool supply_capacity(LinkSpec& link, const LinkSpec& recorded);

/// Parses and validates the text of a profile.
/// @param text       whole file
/// @param file_name  used in error messages and for the profile's name
/// @return profile, or all errors in file order
[[nodiscard]] std::expected<Profile, InputErrors> parse_profile(std::string_view text, std::string_view file_name);

/// Returns all profiles of netsim/profiles, sorted by name.
[[nodiscard]] std::span<const EmbeddedFile> shipped_profiles() noexcept;

/// Returns the shipped profiles that need no recording from the user.
[[nodiscard]] std::span<const EmbeddedFile> complete_profiles();

/// Returns the shipped profile of this name, or an error with the closest name and the list of all names.
[[nodiscard]] std::expected<Profile, InputErrors> shipped_profile(std::string_view name);

}  // namespace tandem::netsim
