#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/log.h"
#include "common/io/socket_address.h"
#include "server/app/control_plane.h"
#include "server/app/house.h"
#include "server/app/session_run.h"

namespace tandem::server {

/// What a server hosts, everything checked: one session (`run`) or many (`serve`).
struct HostPlan {
  const char* command = "run";    ///< for messages
  std::vector<SessionPlan> sessions;
  io::SocketAddress listen;
  std::string state;              ///< folder of keys and books as typed; empty: the usual place, or keys made on the spot on loopback
  ControlLimits limits{};
  LoadLimits load{};
  std::optional<io::SocketAddress> metrics{};
  std::vector<std::string> metrics_hosts{};  ///< names under which they may be asked for
  trust::AuditLimits audit{};
  std::optional<io::Level> json_log{};  ///< set: log lines are JSON, of this level and graver
  double wait_s = 0;              ///< for required seats; 0: until Ctrl-C
  bool quiet = false;
  bool fresh = false;             ///< goes on from nothing that was left
  bool returns = false;           ///< a signal ends the server, not its sessions: the next start goes on with them
};

/// Said of metrics that listen beyond loopback.
inline constexpr const char* kOpenMetrics =
    "warning: everybody who reaches this address reads the metrics, without a password; use 127.0.0.1, or put something that has a password in front";

/// Hosts sessions until they are over and none restarts, or until a signal: then nobody new comes in, all hands are let go gently, reports
/// are written. A second signal, or 3 s, ends it at once. Sessions go on from what a server left that died, or whose plan `returns`.
/// @return exit code
[[nodiscard]] int host(const HostPlan& plan);

}  // namespace tandem::server
