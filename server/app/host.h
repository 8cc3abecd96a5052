#pragma once

#include <string>

#include "common/io/socket_address.h"
#include "proto/scene_spec.h"

namespace tandem::server {

/// A run as a person asked for it, everything checked.
struct HostPlan {
  SceneSpec scene;
  io::SocketAddress listen;
  std::string state;        ///< folder of keys and books as typed; empty: the usual place, or keys made on the spot on loopback
  std::uint64_t seed = 1;   ///< for the report: nothing in a live session is drawn from it
  std::string json, trace;  ///< file names; `-` (JSON only) is standard output; empty: not wanted
  double wait_s = 0;        ///< for required seats; 0: until Ctrl-C
  bool quiet = false;
};

/// Hosts one session: shard, recorder, status, reports. @return exit code
[[nodiscard]] int host(const HostPlan& plan);

}  // namespace tandem::server
