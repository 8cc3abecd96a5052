#pragma once

#include <array>
#include <optional>
#include <string>

#include "proto/wire/wire_messages.h"

namespace tandem::console {

/// A seat that a person holds in a browser, as its page sees it. Positions and forces in the frame of the scene, as in
/// `state`.
struct SeatPicture {
  std::string seat;
  bool joined = false;                                        ///< the server admitted it
  bool heard = false;                                         ///< the server answers
  wire::SessionState session = wire::SessionState::kWaiting;  ///< as the seat's own datagrams say
  wire::GateState gate = wire::GateState::kOff;
  double authority = 0;                                     ///< own, over the seat's tool [0, 1]
  double force_limit_n = 0;                                 ///< of the seat [N]
  std::optional<std::array<double, 3>> x{}, f{}, target{};  ///< hand [m], force on it [N], where the person points [m]
  std::array<double, 3> workspace_min{}, workspace_max{};   ///< where `target` stays [m]; both 0: unknown
  bool limited = false;                                     ///< the person points beyond the workspace
  std::string ended;                                        ///< why the seat is over; empty: it is not
};

/// Returns the message `seat`. Values that are not known are null.
[[nodiscard]] std::string seat_json(const SeatPicture& picture);

}  // namespace tandem::console
