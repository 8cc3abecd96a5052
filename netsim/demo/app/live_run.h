#pragma once

#include <expected>
#include <filesystem>

#include "netsim/demo/app/raw_run.h"
#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Where things are.
struct LivePlaces {
  std::filesystem::path programs;  ///< folder of tandem-server, tandem-client, tandem-netsim
  std::filesystem::path output;    ///< folder for NAME.json, NAME.csv and NAME-PROGRAM.log
};

/// The programs that are not there; empty: the demo can begin.
[[nodiscard]] std::string missing_programs(const LivePlaces& places);

/// The run in real time: a server, the network simulator and two clients, all over UDP on loopback, each a process of
/// its own. Whatever happens, all of them have ended when this returns.
/// @return report and trace, or what went wrong with the last lines of the log that says why
[[nodiscard]] std::expected<RawRun, std::string> live_run(const RunPlan& plan, const LivePlaces& places,
                                                          const RunWatch& watch);

/// The address in a line `listening on HOST:PORT`, empty if there is no such (whole) line yet.
[[nodiscard]] std::string listening_address(const std::string& output);

}  // namespace tandem::netsim::demo
