#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "netsim/engine/schedule.h"
#include "netsim/models/endpoint_clock.h"
#include "netsim/models/path_spec.h"
#include "netsim/system/fault.h"
#include "proto/spec/scene_spec.h"
#include "server/session/contact_source.h"

namespace tandem::hal::sim {
class RecordedMotion;
}

namespace tandem::server {
class InputJournal;
}

namespace tandem::netsim {

class Replay;

/// Configuration of one session in virtual time: scene, networks, faults and clocks.
struct SimulationConfig {
  SceneSpec scene;         ///< scene of the session
  LinkSpec network = {};   ///< every seat has its own link with this specification
  std::uint64_t seed = 1;  ///< seed of all random draws
  std::map<std::string, std::shared_ptr<const hal::sim::RecordedMotion>> motions = {};  ///< by seat
  std::set<std::string> free_seats = {};  ///< optional seats whose program never starts; no participant takes them
  std::map<std::string, LinkSpec> seat_networks = {};  ///< by seat, instead of `network`
  std::vector<NetworkEvent> events = {};               ///< in network time
  std::shared_ptr<const Replay> replay = {};  ///< replaces every network and event: seat i is flow i of the recording
  std::vector<Fault> faults = {};             ///< in any order
  std::map<std::string, EndpointSpec> endpoints = {};  ///< by seat: clock errors and wake-up times of its program
  bool monitor_quality = false;  ///< judges every seat's link from the session's begin on: Simulation::link_qualities
  /// Returns the processor time of the server's tick at `now`, which sends `sent` datagrams. If it exceeds a tick, the
  /// server misses the next ticks and runs them later. Empty: ticks take no time.
  std::function<Duration(Time now, std::size_t sent)> tick_cost = {};
  /// Returns how often the calling thread has allocated from the heap (common/base/heap_count.h). Null: the invariant
  /// "no heap below a tick" is not judged; it needs a replaced operator new.
  std::uint64_t (*heap_count)() noexcept = nullptr;
  /// Makes the source of contacts of a tool (server/session/contact_source.h) when a session is made, law REPLICA.
  /// Null: the tool has only the scene's surfaces.
  std::function<std::unique_ptr<server::ContactSource>(std::size_t tool)> contact_source = {};
  /// Returns `heap_count()`, and 0 if it is null.
  [[nodiscard]] std::uint64_t heap_taken() const noexcept { return heap_count != nullptr ? heap_count() : 0; }
  /// Clients send telemetry at every tick. False: at 60 Hz, as to a live server that records nothing.
  bool telemetry_every_tick = true;
  /// Receives all inputs of the session, and of those after restarts of the server (netsim/replay); null: none. Drain
  /// it after every tick. Must outlive the simulation.
  server::InputJournal* journal = nullptr;
  bool keep_record = true;  ///< false: Simulation::record() stays empty; for runs that only judge invariants
};

}  // namespace tandem::netsim
