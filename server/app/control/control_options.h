#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/socket_address.h"
#include "server/app/control/control_services.h"
#include "server/policy/admission_control.h"

namespace tandem::server {

/// Options of the control side of a server process, validated.
struct ControlOptions {
  io::SocketAddress listen{};  ///< port 0: a port that is free for UDP and TCP
  /// State directory as given. Empty: the default directory, or ephemeral keys on loopback.
  std::string state{};
  ControlLimits limits{};
  LoadLimits load_limits{};  ///< load of a shard above which new joins are rejected
  /// Address of /metrics, /healthz and /readyz; nullopt: none.
  std::optional<io::SocketAddress> metrics{};
  std::vector<std::string> metrics_hosts{};  ///< accepted Host names of the metrics endpoint, in addition to addresses
  auth::AuditLimits audit{};
  std::string notes{};  ///< folder for marks and sheets; empty: the state directory, or none with ephemeral keys
};

}  // namespace tandem::server
