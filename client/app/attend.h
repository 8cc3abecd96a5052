#pragma once

#include <optional>
#include <string>

#include "client/app/alpha_script.h"
#include "client/app/companion.h"
#include "common/io/socket_address.h"
#include "hal/device.h"

namespace tandem::client {

/// A seat as a person asked for it, everything checked that can be checked alone.
struct AttendPlan {
  io::SocketAddress server;
  std::string session, ticket, state;  ///< as typed; see Asking
  std::string seat, device;
  hal::DeviceCaps caps;  ///< what is certain of a simulated device before the scene is known
  std::optional<AlphaScript> script;
  std::string trace, json;  ///< file names; `-` (JSON only) is standard output; empty: not wanted
  double duration_s = 0;    ///< at the seat; 0: until the session ends
  double patience_s = 5;    ///< for a server that does not answer
  double rejoin_s = 60;     ///< how long to try to come back when the server fell silent; 0: not at all
  bool quiet = false;
  Companion* companion = nullptr;  ///< outlives `attend`; null: none
};

/// What can be said of the device before the scene is known: a simulated one gets its numbers from the scene, so that only its axes are
/// certain, and not more than a Touch's three.
[[nodiscard]] hal::DeviceCaps certain_caps(const hal::DeviceCaps& opened);

/// Joins, attends the session, leaves. @return exit code
[[nodiscard]] int attend(const AttendPlan& plan);

}  // namespace tandem::client
