#pragma once

#include <expected>
#include <string>
#include <vector>

#include "netsim/scenario/scenario.h"

namespace tandem::netsim {

/// Argument that stands for all shipped scenarios.
inline constexpr std::string_view kAllShipped = "shipped";

/// Loads the arguments SCENARIO... of a command: a path, a folder (its scenarios, by name), the name of a shipped
/// scenario, or `shipped`. A file is read once, even if it is named several times. A folder's *.textproto files that
/// are valid scenes, profiles or scripts are skipped. A file that is none of these counts as a scenario with errors, so
/// that no scenario is skipped by mistake.
/// @param left_out  receives the skipped files and their kinds, one line per folder
/// @return the scenarios in that order, or all errors of all of them
[[nodiscard]] std::expected<std::vector<Scenario>, InputErrors> load_scenarios(
    const std::vector<std::string>& arguments, std::vector<std::string>* left_out = nullptr);

/// Loads one scenario from its text; its files are relative to the folder of `file_name`.
/// @param shipped  true: it may name shipped scenes and profiles only
[[nodiscard]] std::expected<Scenario, InputErrors> load_scenario_text(const std::string& text,
                                                                      const std::string& file_name, bool shipped);

}  // namespace tandem::netsim
