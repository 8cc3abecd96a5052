#pragma once

#include <expected>
#include <filesystem>

#include "netsim/demo/app/raw_run.h"
#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Folders of the demo.
struct DemoPaths {
  std::filesystem::path programs;  ///< folder of tandem-server, tandem-client, tandem-netsim
  std::filesystem::path output;    ///< folder for NAME.json, NAME.csv and NAME-PROGRAM.log
};

/// Returns the names of missing programs; empty: the demo can begin.
[[nodiscard]] std::string missing_programs(const DemoPaths& places);

/// Runs in real time: a server, the network simulator and two clients, each in its own process, over UDP on loopback.
/// All processes have ended when this function returns, also after an error.
/// @return report and trace, or the error with the last lines of the log that explains it
[[nodiscard]] std::expected<RawRun, std::string> live_run(const RunPlan& plan, const DemoPaths& places,
                                                          const RunObserver& observer);

/// Returns the address in a line `listening on HOST:PORT`; empty if there is no such complete line yet.
[[nodiscard]] std::string listening_address(const std::string& output);

}  // namespace tandem::netsim::demo
