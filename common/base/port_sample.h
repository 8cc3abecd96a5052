#pragma once

#include "common/base/axes.h"

namespace tandem {

/// What one end of a channel tells the other, per axis of the port.
struct PortSample {
  AxisArray x{};       ///< position: xc of a master, q of a slave, target y of the server [rad] or [m]
  AxisArray v{};       ///< velocity [rad/s] or [m/s]
  AxisArray f{};       ///< effort of the sender's end of the spring [N m] or [N]; law `replica`: up the force on the hand, down the position of the tool
  AxisArray a{};       ///< acceleration, of a client [rad/s^2] or [m/s^2]
  EnergyArray e_in{};  ///< cumulative energy the channel took in at the sender's end [nJ]
};

}  // namespace tandem
