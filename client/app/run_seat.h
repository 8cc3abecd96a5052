#pragma once

#include <optional>
#include <string>

#include "client/app/authority_script.h"
#include "client/app/join_client.h"
#include "client/app/seat_observer.h"
#include "hal/core/device.h"

namespace tandem::client {

/// Options of `join`. Each value is validated; values that depend on the session are not.
struct SeatOptions {
  /// Seat and server. Its capabilities are those of a simulated device that are known before the scene; `run_seat`
  /// replaces those of hardware, and sets the signals.
  JoinOptions join{.timeout = std::chrono::seconds(5)};
  std::string device = {};
  std::optional<AuthorityScript> script = {};
  std::string trace = {}, json = {};  ///< file names; `-` (JSON only) is standard output; empty: none
  double duration_s = 0;              ///< time at the seat [s]; 0: until the session ends
  double reconnect_timeout_s = 60;    ///< longest time for reconnects to a silent server [s]; 0: no reconnect
  bool quiet = false;
  SeatObserver* observer = nullptr;  ///< must outlive `run_seat`; null: none
};

/// Returns the capabilities that are known before the scene. A simulated device gets its numbers from the scene, so
/// only its axes are known, at most three.
[[nodiscard]] hal::DeviceCaps known_caps(const hal::DeviceCaps& opened);

/// Joins a session, runs the seat until it ends, and leaves. @return exit code of the program
[[nodiscard]] int run_seat(const SeatOptions& plan);

}  // namespace tandem::client
