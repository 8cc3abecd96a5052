#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/scene_spec.h"
#include "proto/script_spec.h"

/// A scenario as its file says it: every number finite and in range. Names of seats, tools, phases and files are still
/// words; netsim/scenario.h holds them against the scene. Made by proto/scenario_text.h only.
namespace tandem {

/// Where something was written, for mistakes that are found later.
struct ScenarioPlace {
  int line = 0, column = 0;  ///< from 1; 0: unknown
  std::string key;
  std::string value;         ///< as written
};
struct ScenarioName {
  std::string text;
  ScenarioPlace place;
};

struct ScenarioNetworkSpec {
  std::optional<ScenarioName> profile;  ///< name or file
  std::optional<double> delay_ms, jitter_ms, loss_percent, duplicate_percent, reorder_percent, trace_interval_ms;
  ScenarioPlace place;
};
struct SeatNetworkSpec {
  std::vector<ScenarioName> seats;
  ScenarioNetworkSpec network;
};
struct ScenarioEventSpec {
  ScriptEventSpec event;              ///< its clients are words still, those of `seats`
  std::vector<ScenarioName> seats;    ///< none: every one
};
struct ScenarioHandSpec {
  ScenarioName seat, motion;
};
struct ScenarioFaultSpec {
  std::string kind;                 ///< as netsim/fault.h spells it
  std::vector<ScenarioName> seats;  ///< none: every one
  double at_s = 0, for_ms = 0;
  ScenarioPlace place;
};
struct ScenarioEndpointSpec {
  enum class Wake : std::uint8_t { kExact, kUniform, kMeasured } wake = Wake::kExact;
  struct Step {
    double at_s = 0, by_ms = 0;
  };
  std::vector<ScenarioName> seats;  ///< none: every one
  double offset_ms = 0, drift_ppm = 0, late_max_ms = 0;
  std::vector<Step> steps;
  ScenarioPlace place;
};

/// One number that must lie in a range.
struct ScenarioLimitSpec {
  enum class Of : std::uint8_t { kSeat, kTool, kSession, kFeel } of = Of::kSeat;
  std::vector<ScenarioName> names;    ///< seats or tools; none: every MASTER seat, every tool
  std::optional<ScenarioName> phase;  ///< none: the whole run
  std::string metric;                 ///< key of the schema, such as `tracking_rms_m`
  std::string unit;                   ///< empty: a plain number
  std::optional<double> min, max;     ///< at least one
  ScenarioPlace place;
};

struct ScenarioSpec {
  std::string name;  ///< file name without folder and ending
  std::string file;  ///< as given
  std::string summary;
  ScenarioName scene;
  std::optional<double> duration_s;
  std::uint64_t seed = 1;
  std::uint32_t seeds = 1;
  std::optional<LawKind> channel;
  std::optional<MfsMode> mfs;
  ScenarioNetworkSpec network;
  std::vector<SeatNetworkSpec> seat_networks;
  std::vector<ScenarioEventSpec> events;
  std::vector<ScenarioHandSpec> hands;
  std::vector<ScenarioFaultSpec> faults;
  std::vector<ScenarioEndpointSpec> endpoints;
  std::vector<ScenarioLimitSpec> limits;  ///< in the order of the schema within each block, blocks as written
};

}  // namespace tandem
