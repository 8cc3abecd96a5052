#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal/sim/recorded_motion.h"
#include "netsim/endpoint_clock.h"
#include "netsim/fault.h"
#include "netsim/path_spec.h"
#include "netsim/replay.h"
#include "netsim/script.h"
#include "proto/scene_spec.h"
#include "server/contact_source.h"

namespace tandem::netsim {

/// A whole session in virtual time: who, over which network, and what goes wrong.
struct WorldSetup {
  SceneSpec scene;
  LinkSpec network = {};  ///< every seat has one of its own
  std::uint64_t seed = 1;
  std::map<std::string, std::shared_ptr<const hal::sim::RecordedMotion>> motions = {};  ///< by seat
  std::map<std::string, LinkSpec> seat_networks = {};                                   ///< by seat, instead of `network`
  std::vector<NetworkEvent> events = {};                                                ///< by time of the network
  std::shared_ptr<const Replay> replay = {};  ///< instead of every network and event: seat i is flow i of the recording
  std::vector<Fault> faults = {};                                                       ///< in any order
  std::map<std::string, EndpointSpec> endpoints = {};  ///< by seat: its clock, and when its program wakes up
  bool watch_quality = false;  ///< judges every seat's link from the session's begin on: World::quality
  /// Processor time that the server's tick of this moment takes, in which it sends so many datagrams; longer than a tick: the next ones are
  /// missed and made up for. Empty: none.
  std::function<Duration(Time now, std::size_t sent)> tick_cost = {};
  /// How much the calling thread has taken from the heap so far (common/base/heap_count.h); null: "no heap below a tick" is
  /// not judged, as whoever runs the world did not replace operator new.
  std::uint64_t (*heap_count)() noexcept = nullptr;
  /// Makes the source of contacts of a tool (server/contact_source.h) when a session is made, law REPLICA; null: the scene's surfaces are all.
  std::function<std::unique_ptr<server::ContactSource>(std::size_t tool)> contact_source = {};
  bool keep_record = true;  ///< false: World::record() stays empty; for runs that only judge invariants
};

}  // namespace tandem::netsim
