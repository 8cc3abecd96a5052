#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/spec/scene_spec.h"
#include "proto/spec/script_spec.h"

/// A scenario after validation of its own file: every number is finite and in range. Names of seats, tools, phases and
/// files are not resolved; netsim/scenario/scenario.h checks them against the scene. Only proto/text/scenario_text.h
/// creates it.
namespace tandem {

/// Location of a value in the file, for errors that a later check finds.
struct ScenarioLocation {
  int line = 0, column = 0;  ///< from 1; 0: unknown
  std::string key;
  std::string value;  ///< as written
};
struct ScenarioName {
  std::string text;
  ScenarioLocation place;
};

struct ScenarioNetworkSpec {
  std::optional<ScenarioName> profile;  ///< name or file
  std::optional<double> delay_ms, jitter_ms, loss_percent, duplicate_percent, reorder_percent, trace_interval_ms;
  ScenarioLocation place;
};
struct SeatNetworkSpec {
  std::vector<ScenarioName> seats;
  ScenarioNetworkSpec network;
};
struct ScenarioEventSpec {
  ScriptEventSpec event;            ///< its client names are not resolved; they are those of `seats`
  std::vector<ScenarioName> seats;  ///< empty: every seat
};
struct ScenarioHandSpec {
  ScenarioName seat, motion;
};
struct ScenarioFaultSpec {
  std::string kind;                 ///< as spelled in netsim/system/fault.h
  std::vector<ScenarioName> seats;  ///< empty: every seat
  double at_s = 0, for_ms = 0;
  ScenarioLocation place;
};
struct ScenarioEndpointSpec {
  enum class Wake : std::uint8_t { kExact, kUniform, kMeasured } wake = Wake::kExact;
  struct Step {
    double at_s = 0, by_ms = 0;
  };
  std::vector<ScenarioName> seats;  ///< empty: every seat
  double offset_ms = 0, drift_ppm = 0, late_max_ms = 0;
  std::vector<Step> steps;
  ScenarioLocation place;
};

/// One number with its allowed range.
struct ScenarioLimitSpec {
  enum class Of : std::uint8_t { kSeat, kTool, kSession, kFeel } of = Of::kSeat;
  std::vector<ScenarioName> names;    ///< seats or tools; empty: every MASTER seat, every tool
  std::optional<ScenarioName> phase;  ///< absent: the whole run
  std::string metric;                 ///< key of the schema, such as `tracking_rms_m`
  std::string unit;                   ///< empty: dimensionless
  std::optional<double> min, max;     ///< at least one
  ScenarioLocation place;
};

struct ScenarioSpec {
  std::string name;  ///< file name without folder and extension
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
  /// In the order of the schema within each block; blocks in the order of the file.
  std::vector<ScenarioLimitSpec> limits;
};

}  // namespace tandem
