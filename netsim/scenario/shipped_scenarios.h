#pragma once

#include <span>
#include <string_view>

namespace tandem::netsim {

/// A scenario of netsim/scenario, built into the program so that its name works from any folder. It uses shipped scenes
/// and profiles only.
struct ShippedScenario {
  std::string_view name;  ///< file name without `.textproto`
  std::string_view text;
};

/// Returns all shipped scenarios, sorted by name.
[[nodiscard]] std::span<const ShippedScenario> shipped_scenarios() noexcept;

/// Returns the shipped scenario of that name, or null.
[[nodiscard]] const ShippedScenario* find_shipped_scenario(std::string_view name) noexcept;

}  // namespace tandem::netsim
