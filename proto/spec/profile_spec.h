#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Expected one-way delay quantiles of one direction of a profile, for 128-byte datagrams at 1 kHz.
struct ProfileCheck {
  Direction direction = Direction::kUp;
  std::array<double, 4> delay_ms{};  ///< p5, p50, p95, p99 [ms]
};

/// A network profile: every number is finite and in range, and relations between numbers hold. The keys of
/// proto/schema/profile.proto explain the models.
struct Profile {
  std::string name;  ///< file name without folder and extension
  std::uint32_t version = 0;
  std::string summary;
  std::vector<std::string> sources;
  LinkSpec link;
  std::vector<ProfileCheck> checks;
  /// Set if rates marked `recorded` need a recorded capacity before the link can be simulated (`supply_capacity`). The
  /// value is the file named by the profile; empty if the user must name one.
  std::optional<std::string> capacity_file = {};
};

}  // namespace tandem::netsim
