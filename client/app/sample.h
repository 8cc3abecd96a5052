#pragma once

#include <array>

#include "common/base/axes.h"
#include "common/io/spsc_queue.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// One servo tick of a trace.
struct Sample {
  double t_s = 0;  ///< session time [s]; before the session, minus the time since the first tick
  AxisArray q{};   ///< joints [rad or m]
  std::array<double, 3> x{}, f_cmd{}, f_gate{}, f_out{};  ///< tip [m]; force wanted, after the gate, delivered [N]
  wire::GateState gate = wire::GateState::kOff;
  double alpha = 0;  ///< own authority [0, 1]
  double silence_s =
      -1;  ///< time since the newest accepted datagram on the client's clock [s]; -1: none on this connection
};
using SampleQueue = io::SpscQueue<Sample>;

}  // namespace tandem::client
