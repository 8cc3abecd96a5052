#pragma once

#include <expected>
#include <optional>
#include <string_view>

#include "proto/input_error.h"
#include "proto/scenario_spec.h"

namespace tandem {

/// A scenario as far as it could be read in spite of its mistakes: those between names and files can be told as well then.
struct ScenarioReading {
  std::optional<ScenarioSpec> spec;  ///< empty: too little was read
  InputErrors errors;                ///< in file order
};
/// @param text, file_name  as below
[[nodiscard]] ScenarioReading read_scenario_text(std::string_view text, std::string_view file_name);

/// Reads a scenario (proto/scenario.proto in text format, or JSON if the name ends in `.json`).
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages and for the scenario's name
/// @return what it says, or every mistake found, in file order
[[nodiscard]] std::expected<ScenarioSpec, InputErrors> parse_scenario_text(std::string_view text,
                                                                           std::string_view file_name);

}  // namespace tandem
