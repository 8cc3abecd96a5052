#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// What a run leaves behind, before anybody has read it.
struct RawRun {
  std::string json, trace;                 ///< as the programs write them
  std::string trainer, trainee;            ///< traces of the workstations; empty in virtual time
  std::string trainer_json, trainee_json;  ///< their reports, likewise
  NetworkSeries network;                   ///< of the bad network; empty otherwise
};

/// Told now and then how far a run is [s of session time]; set `stop` from a signal handler and the run ends soon.
struct RunWatch {
  std::function<void(double session_s)> progress;
  const std::atomic<bool>* stop = nullptr;
};

inline constexpr const char* kInterrupted = "interrupted";

}  // namespace tandem::netsim::demo
