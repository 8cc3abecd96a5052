#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/quality/quality_text.h"
#include "netsim/system/simulation_config.h"
#include "server/report/report.h"

namespace tandem::netsim {

class Simulation;

/// Callbacks of a running simulation. Each may be empty.
struct SimulationObserver {
  /// Receives the session's time [s] some times per virtual second; false ends the run early.
  std::function<bool(double session_s)> keep_running = {};
  /// Receives the rows of the trace (server/report/trace_csv.h), header first, in pieces.
  std::function<void(std::string_view rows)> trace = {};
  /// Called once, before the first step.
  std::function<void(Simulation& simulation)> begin = {};
  /// Called after every tick.
  std::function<void(Simulation& simulation)> tick = {};
};

/// Result of a run.
struct SimulationResult {
  server::RunReport report;        ///< the caller sets `cpu_s`, because the cores read no clock
  std::vector<NamedLink> links;    ///< of every seat, if the setup requested them (`monitor_quality`)
  std::vector<std::string> notes;  ///< facts needed to understand the report: netsim/system/session_notes.h
  std::string trouble;             ///< why there is no result; empty: the session ran
  bool interrupted = false;        ///< `keep_running` returned false; the report covers the time until then
};

/// Runs a session in virtual time to its end and returns its report. The same setup and build give the same report,
/// `trace_hash` included. It has no global state: several threads may call it at the same time.
[[nodiscard]] SimulationResult run_simulation(const SimulationConfig& setup, const SimulationObserver& observer = {});
/// Runs a simulation that has just been made. The caller, which has the setup, adds the notes
/// (netsim/system/session_notes.h).
/// @param simulation  has not yet taken a step
/// @param seed        seed of the setup, for the report
/// @param observer    callbacks, each may be empty
[[nodiscard]] SimulationResult run_simulation(Simulation& simulation, std::uint64_t seed,
                                              const SimulationObserver& observer = {});

}  // namespace tandem::netsim
