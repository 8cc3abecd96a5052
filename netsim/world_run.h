#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/quality_text.h"
#include "netsim/world_setup.h"
#include "server/report.h"

namespace tandem::netsim {

class World;

/// Who looks on while a world runs. All may be empty.
struct WorldRunWatch {
  /// Told the session's time [s] some times per virtual second; false ends the run early.
  std::function<bool(double session_s)> go_on = {};
  /// The rows of the trace (server/trace_csv.h), header first, in pieces.
  std::function<void(std::string_view rows)> trace = {};
  /// Told after every tick.
  std::function<void(World& world)> tick = {};
};

struct WorldRun {
  server::RunReport report;  ///< `cpu_s` is the caller's: cores read no clock
  std::vector<NamedLink> links;  ///< every seat's, if the setup asked for it (`watch_quality`)
  std::vector<std::string> notes;  ///< what a reader must know: netsim/world_notes.h
  std::string trouble;       ///< why there is nothing to judge; empty: the session ran
  bool interrupted = false;  ///< `go_on` said no; the report is of what ran until then
};

/// Runs a session in virtual time to its end and judges it. Same setup and build: same report, `trace_hash` included.
/// Keeps nothing outside: many may run side by side.
[[nodiscard]] WorldRun run_world(const WorldSetup& setup, const WorldRunWatch& watch = {});
/// The same of a world that was just made; the notes are the caller's, who has the setup (netsim/world_notes.h).
/// @param seed  of its setup, for the report
[[nodiscard]] WorldRun run_world(World& world, std::uint64_t seed, const WorldRunWatch& watch = {});

}  // namespace tandem::netsim
