#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/models/path_spec.h"
#include "proto/spec/input_error.h"

namespace tandem {
struct ProfileOutage;
}

/// Named networks. A profile is a text file (proto/schema/profile.proto) with parameters, their sources and a version.
namespace tandem::netsim {

/// Expected one-way delay quantiles of one direction of a profile, for 128-byte datagrams at 1 kHz.
struct ProfileCheck {
  Direction direction = Direction::kUp;  ///< direction that is checked
  std::array<double, 4> delay_ms{};      ///< p5, p50, p95, p99 [ms]
};

/// Parsed and validated profile.
struct Profile {
  std::string name;                  ///< file name without folder and extension
  std::uint32_t version = 0;         ///< version of the file's content
  std::string summary;               ///< one line for lists
  std::vector<std::string> sources;  ///< sources of the numbers
  LinkSpec link;                     ///< the network
  std::vector<ProfileCheck> checks;  ///< expected quantiles
  /// Set if rates marked `recorded` need a recorded capacity before the link can be simulated (`supply_capacity`). The
  /// value is the file named by the profile; empty if the user must name one.
  std::optional<std::string> capacity_file = {};
};

/// Converts an outage from a profile's units to the engine's specification.
[[nodiscard]] OutageSpec outage_from(const ProfileOutage& in);

/// Inserts a recorded capacity (netsim/profiles/capacity_csv.h) into the recorded rates of a link.
/// @return true if the link has a recorded rate
bool supply_capacity(LinkSpec& link, const LinkSpec& recorded);

/// Parses and validates the text of a profile.
/// @param text       whole file
/// @param file_name  used in error messages and for the profile's name
/// @return profile, or all errors in file order
[[nodiscard]] std::expected<Profile, InputErrors> parse_profile(std::string_view text, std::string_view file_name);

/// Profile of netsim/profiles, embedded in the program.
struct ShippedProfile {
  std::string_view name;  ///< file name without `.textproto`
  std::string_view text;  ///< content of the file
};
/// Returns all shipped profiles, sorted by name.
[[nodiscard]] std::span<const ShippedProfile> shipped_profiles() noexcept;

/// Returns the shipped profiles that need no recording from the user.
[[nodiscard]] std::span<const ShippedProfile> complete_profiles();

/// Returns the shipped profile of this name, or an error with the closest name and the list of all names.
[[nodiscard]] std::expected<Profile, InputErrors> shipped_profile(std::string_view name);

}  // namespace tandem::netsim
