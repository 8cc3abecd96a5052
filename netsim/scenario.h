#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "netsim/scenario_limits.h"
#include "netsim/world_setup.h"
#include "proto/input_error.h"
#include "proto/scenario_spec.h"

namespace tandem::netsim {

/// A network that a scenario asked for.
struct ScenarioLink {
  LinkSpec link;
  std::string description;  ///< one line for people
  std::vector<std::string> notes = {};  ///< what a report must say about it
};

/// A scenario whose names and files were found: ready to run with any seed.
struct Scenario {
  std::string name, file, summary;
  std::string scene;              ///< as written
  std::uint64_t seed = 1;         ///< the first
  std::uint32_t seeds = 1;        ///< how many
  std::string network;            ///< for people
  std::vector<std::pair<std::string, std::string>> seat_networks;  ///< seat, for people
  std::vector<std::string> hands;  ///< for people
  std::vector<std::string> notes;  ///< what a report must say about its networks, one line each
  WorldSetup setup;                ///< its seed is the caller's
  std::vector<Limit> limits;
};

/// Where a scenario's words become things. A mistake without a file name is put at the word's place in the scenario; one
/// with a file name stays as it is.
struct ScenarioSources {
  std::function<std::expected<SceneSpec, InputErrors>(const std::string& name)> scene;
  std::function<std::expected<ScenarioLink, InputErrors>(const ScenarioNetworkSpec&)> network;
  std::function<std::expected<std::shared_ptr<const hal::sim::RecordedMotion>, InputErrors>(const std::string& option)> motion;
};

/// Holds a scenario against its scene: every seat, tool and phase exists, every limit is of a number that this run has.
/// @param known  mistakes found when it was read (ScenarioReading): what they explain is not told again
/// @return the scenario, or every mistake found, the known ones too, in file order
[[nodiscard]] std::expected<Scenario, InputErrors> make_scenario(const ScenarioSpec& spec, const ScenarioSources& sources,
                                                                 InputErrors known = {});

/// Every value in force, one per line: key, value and unit in three aligned columns. For `--check`.
[[nodiscard]] std::string effective_scenario_text(const Scenario& scenario);

}  // namespace tandem::netsim
