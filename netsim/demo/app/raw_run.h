#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Texts that the programs of one demo run wrote: report, traces and network, not parsed yet.
struct RawRun {
  std::string json, trace;                 ///< as written by the programs
  std::string trainer, trainee;            ///< traces of the clients; empty in virtual time
  std::string trainer_json, trainee_json;  ///< reports of the clients, likewise
  NetworkSeries network;                   ///< of the bad network; empty otherwise
};

/// Receives the progress of a run at intervals [s of session time]. A signal handler may set `stop`; the run then ends
/// soon. A live run's server listens at `listen`, and its address is given to `listening`, if that is not empty.
struct RunObserver {
  std::function<void(double session_s)> progress;
  const std::atomic<bool>* stop = nullptr;
  std::string listen = "127.0.0.1:0";
  std::function<void(const std::string& address)> listening{};
};

inline constexpr const char* kInterrupted = "interrupted";

}  // namespace tandem::netsim::demo
