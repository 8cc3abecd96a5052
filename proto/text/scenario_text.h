#pragma once

#include <expected>
#include <optional>
#include <string_view>

#include "proto/spec/input_error.h"
#include "proto/spec/scenario_spec.h"

namespace tandem {

/// A scenario with the errors of its own file. The parts that were readable allow checks of names and files in the same
/// run.
struct ScenarioReading {
  std::optional<ScenarioSpec> spec;  ///< absent: too little was readable
  InputErrors errors;                ///< in file order
};
/// Parses a scenario and keeps the readable parts of an invalid one. @param text, file_name  as below
[[nodiscard]] ScenarioReading read_scenario_text(std::string_view text, std::string_view file_name);

/// Parses a scenario (proto/schema/scenario.proto in text format, or JSON if the name ends in `.json`).
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages and for the scenario's name
/// @return the scenario, or every error found, in file order
[[nodiscard]] std::expected<ScenarioSpec, InputErrors> parse_scenario_text(std::string_view text,
                                                                           std::string_view file_name);

}  // namespace tandem
