#pragma once

#include "common/base/axes.h"

namespace tandem {

/// The sample that one end of a channel sends to the other, per axis of the port.
struct PortSample {
  AxisArray x{};  ///< position: xc of a master, q of a slave, target y of the server [rad] or [m]
  AxisArray v{};  ///< velocity [rad/s] or [m/s]
  AxisArray f{};  ///< effort of the sender's end of the spring [N m] or [N]. Law `replica`: from the client the force
                  ///< on the hand, from the server the position of the tool
  AxisArray a{};  ///< acceleration, from a client only [rad/s^2] or [m/s^2]
  EnergyArray e_in{};  ///< cumulative energy absorbed by the channel at the sender's end [nJ]
};

}  // namespace tandem
