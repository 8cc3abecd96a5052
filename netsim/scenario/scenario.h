#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "netsim/scenario/scenario_limits.h"
#include "netsim/system/simulation_config.h"
#include "proto/spec/input_error.h"
#include "proto/spec/scenario_spec.h"

namespace tandem::netsim {

/// The network of a scenario.
struct ScenarioLink {
  LinkSpec link;
  std::string description;              ///< one line for reports
  std::vector<std::string> notes = {};  ///< facts that a report must contain about it
};

/// A scenario with all names and files resolved; it runs with any seed.
struct Scenario {
  std::string name, file, summary;
  std::string scene;                                               ///< as written
  std::uint64_t seed = 1;                                          ///< the first seed
  std::uint32_t seeds = 1;                                         ///< number of seeds
  std::string network;                                             ///< description for reports
  std::vector<std::pair<std::string, std::string>> seat_networks;  ///< seat and description
  std::vector<std::string> hands;                                  ///< descriptions for reports
  std::vector<std::string> notes;  ///< facts that a report must contain about its networks, one line each
  SimulationConfig setup;          ///< the caller sets its seed
  std::vector<Limit> limits;
};

/// Resolves the names in a scenario. An error without a file name is reported at the position of the name in the
/// scenario. An error with a file name stays unchanged.
struct ScenarioSources {
  std::function<std::expected<SceneSpec, InputErrors>(const std::string& name)> scene;
  std::function<std::expected<ScenarioLink, InputErrors>(const ScenarioNetworkSpec&)> network;
  std::function<std::expected<std::shared_ptr<const hal::sim::RecordedMotion>, InputErrors>(const std::string& option)>
      motion;
};

/// Checks a scenario against its scene: every seat, tool and phase exists, and every limit has a number in this run.
/// @param known  errors found by the parser (ScenarioReading); errors that follow from them are not repeated
/// @return the scenario, or all errors including the known ones, in file order
[[nodiscard]] std::expected<Scenario, InputErrors> make_scenario(const ScenarioSpec& spec,
                                                                 const ScenarioSources& sources,
                                                                 InputErrors known = {});

/// Returns all effective values, one per line, for `--check`: key, value and unit in three aligned columns.
[[nodiscard]] std::string effective_scenario_text(const Scenario& scenario);

}  // namespace tandem::netsim
