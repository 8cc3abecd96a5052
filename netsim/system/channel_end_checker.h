#pragma once

#include <array>
#include <optional>

#include "netsim/system/observed_seat.h"
#include "netsim/system/starvation_checker.h"

namespace tandem::netsim {

/// Checks one end of a channel: its energy accounts, the steps of its reference, and starvation.
class ChannelEndChecker {
 public:
  struct Sample {
    const control::ChannelEnd& end;
    const AxisArray& scale;  ///< tip gain to port gain, per axis
    PortSample received;
    AxisArray x{};                     ///< position of the body that this end is coupled to, after the tick
    std::optional<AxisArray> coupled;  ///< position of that body when the reference moved; absent: `x` of the last tick
    AxisArray offset{};                ///< hand minus tool that the session has yet to close
    bool steady = false;               ///< the end is judged at all
    double gains_speed = 0;            ///< speed that a prediction may add to the received speed [m/s]
  };
  void check(const ObservedSeat& seat, const Sample& sample);
  /// The state of the end changed in between, or was not observed: the next check compares nothing.
  void skip() noexcept { known_ = false; }

 private:
  bool known_ = false;
  AxisArray ref_{}, x_{};
  EnergyArray in_{}, received_{};
  StarvationChecker starvation_;
};

/// Checks all ends of the channels of one seat, at the server and at the client.
class SeatEndsChecker {
 public:
  /// Checks the server's ends: one per tool for hands of law `replica`, else one in all.
  void check_server(const ObservedSeat& seat);
  /// Checks the client's ends. A master's reference moves against the virtual mass of the tick before, a slave's
  /// reference against this tick's reading.
  void check_client(const ObservedSeat& seat);
  void skip_server() noexcept;
  void skip_client() noexcept;
  /// The client's program was restarted.
  void reset_client() noexcept { client_ = {}; }

 private:
  std::array<ChannelEndChecker, kToolsMax> client_, server_;
};

}  // namespace tandem::netsim
