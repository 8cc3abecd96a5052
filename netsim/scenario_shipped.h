#pragma once

#include <span>
#include <string_view>

namespace tandem::netsim {

/// A scenario of netsim/scenarios, built into the program so that a bare name works from any folder. It names shipped
/// scenes and profiles only.
struct ShippedScenario {
  std::string_view name;  ///< file name without `.textproto`
  std::string_view text;
};

/// All of them, by name.
[[nodiscard]] std::span<const ShippedScenario> shipped_scenarios() noexcept;

/// The shipped scenario of that name, or null.
[[nodiscard]] const ShippedScenario* find_shipped_scenario(std::string_view name) noexcept;

}  // namespace tandem::netsim
