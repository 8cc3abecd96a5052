#pragma once

#include <expected>
#include <string>
#include <vector>

#include "netsim/scenario.h"

namespace tandem::netsim {

/// The word that stands for all shipped scenarios.
inline constexpr std::string_view kAllShipped = "shipped";

/// Loads what a person typed as SCENARIO...: a path, a folder (its scenarios, by name), the name of a shipped scenario, or
/// `shipped`. A file is read once, however often it is named. Of a folder's *.textproto those are left out that are good
/// scenes, profiles or scripts; one that is none of these counts as a scenario with mistakes, so that none gets lost.
/// @param left_out  told which were left out and what they are, one line for each folder
/// @return the scenarios in that order, or every mistake in all of them
[[nodiscard]] std::expected<std::vector<Scenario>, InputErrors> load_scenarios(const std::vector<std::string>& arguments,
                                                                              std::vector<std::string>* left_out = nullptr);

/// One scenario's text, its files relative to `file_name`'s folder. @param shipped  it may name shipped things only
[[nodiscard]] std::expected<Scenario, InputErrors> load_scenario_text(const std::string& text, const std::string& file_name,
                                                                      bool shipped);

}  // namespace tandem::netsim
