#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/path_spec.h"
#include "proto/input_error.h"

namespace tandem {
struct ProfileOutage;
}

/// Named networks. A profile is a text file (proto/profile.proto) with numbers, their sources and a version.
namespace tandem::netsim {

/// What a profile promises at 1 kHz with 128-byte datagrams: quantiles of the one-way delay of one direction.
struct ProfileCheck {
  Direction direction = Direction::kUp;
  std::array<double, 4> delay_ms{};  ///< p5, p50, p95, p99 [ms]
};

struct Profile {
  std::string name;  ///< file name without folder and ending
  std::uint32_t version = 0;
  std::string summary;
  std::vector<std::string> sources;
  LinkSpec link;
  std::vector<ProfileCheck> checks;
  /// Set: the rates marked `recorded` need a recorded capacity before the link can be simulated (`supply_capacity`).
  /// The file the profile names, or empty: the user must name one.
  std::optional<std::string> capacity_file = {};
};

/// An outage as people write it, in the engine's numbers.
[[nodiscard]] OutageSpec outage_from(const ProfileOutage& in);

/// Puts a recorded capacity (netsim/capacity_csv.h) where the link asks for one.
/// @return whether it did
bool supply_capacity(LinkSpec& link, const LinkSpec& recorded);

/// Turns the text of a profile into numbers that cannot be wrong.
/// @param file_name  used in messages and for the name
/// @return the profile, or every mistake found, in file order
[[nodiscard]] std::expected<Profile, InputErrors> parse_profile(std::string_view text, std::string_view file_name);

/// A profile of netsim/profiles, built into the program.
struct ShippedProfile {
  std::string_view name;  ///< file name without `.textproto`
  std::string_view text;
};
/// All of them, by name.
[[nodiscard]] std::span<const ShippedProfile> shipped_profiles() noexcept;

/// Those that need no recording of the user's.
[[nodiscard]] std::span<const ShippedProfile> complete_profiles();

/// The shipped profile of that name, or a mistake that names the nearest and lists all.
[[nodiscard]] std::expected<Profile, InputErrors> shipped_profile(std::string_view name);

}  // namespace tandem::netsim
