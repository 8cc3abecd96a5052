#pragma once

#include <optional>
#include <string>

#include "client/app/authority_script.h"
#include "client/app/seat_observer.h"
#include "common/io/socket_address.h"
#include "hal/core/device.h"

namespace tandem::client {

/// Options of `join`. Each value is validated; values that depend on the session are not.
struct SeatOptions {
  io::SocketAddress server;
  std::string session, ticket, state;  ///< unparsed; see JoinOptions
  std::string seat, device;
  hal::DeviceCaps caps;  ///< known capabilities of a simulated device before the scene is known
  std::optional<AuthorityScript> script;
  std::string trace, json;          ///< file names; `-` (JSON only) is standard output; empty: none
  double duration_s = 0;            ///< time at the seat [s]; 0: until the session ends
  double timeout_s = 5;             ///< connect timeout [s]
  double reconnect_timeout_s = 60;  ///< longest time for reconnects to a silent server [s]; 0: no reconnect
  bool quiet = false;
  SeatObserver* observer = nullptr;  ///< must outlive `run_seat`; null: none
};

/// Returns the capabilities that are known before the scene. A simulated device gets its numbers from the scene, so
/// only its axes are known, at most three.
[[nodiscard]] hal::DeviceCaps known_caps(const hal::DeviceCaps& opened);

/// Joins a session, runs the seat until it ends, and leaves. @return exit code of the program
[[nodiscard]] int run_seat(const SeatOptions& plan);

}  // namespace tandem::client
