#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "proto/rpc/rpc_messages.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/session_telemetry.h"
#include "server/console/evaluation_notes.h"
#include "server/console/tool_velocities.h"

namespace tandem::console {

/// Newest live values of a session, from TELEMETRY. Values that are not known are NaN.
struct LiveValues {
  wire::SessionTelemetry telemetry;
  std::array<wire::WatchedLink, kSeatsMax> links{};
  std::array<wire::WatchedAuthority, kToolsMax> authorities{};
  std::array<ToolVelocities::Velocity, kToolsMax> velocities = ToolVelocities::unknown();  ///< of the tools [m/s]
  Time arrived{};  ///< of the newest datagram, on the gateway's monotonic clock
};

/// Newest picture of a session.
struct LivePicture {
  rpc::Status status;
  AccessRole role = AccessRole::kObserver;  ///< of the connection that the picture comes from
  std::uint64_t number = 0;                 ///< increases with each picture; 0: nothing is known yet
  bool connected = false;                   ///< false: the connection to the server is lost
  bool again = false;                       ///< the gateway tries to connect again
  bool answers = false;                     ///< not connected, although the server answered: it refused, or has moved
  std::string warning;                      ///< why live values are missing; empty: they are there
  std::shared_ptr<const SceneSpec> scene;   ///< null: not known
  std::shared_ptr<const LiveValues> live;   ///< null: no datagrams arrive
  std::shared_ptr<const std::vector<rpc::ListedSession>> sessions;  ///< of the server; null: not known
  std::shared_ptr<const rpc::SceneList> scenes;  ///< for new sessions; null: not known, or not allowed
  std::shared_ptr<const EvaluationNotes> notes;  ///< that this connection may read; null: none known
  std::string person;                            ///< name in the ticket of the connection; empty: not named
};

}  // namespace tandem::console
