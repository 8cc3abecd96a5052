#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "client/seat/client_channel.h"
#include "client/seat/close_out.h"
#include "client/seat/coupling.h"
#include "client/seat/device_port.h"
#include "client/seat/force_separation.h"
#include "client/seat/motion_scale.h"
#include "client/seat/seat_guards.h"
#include "client/seat/seat_requests.h"
#include "client/seat/session_clock.h"
#include "client/seat/state_pace.h"
#include "client/seat/telemetry_pace.h"
#include "client/seat/tool_channels.h"
#include "common/base/time.h"
#include "common/control/force_gate.h"
#include "common/transport/secure_channel.h"
#include "hal/core/device.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// The client core of one seat: takes device states, returns device commands, receives and sends datagrams.
/// The same core runs on a device's servo thread and in virtual time. Order within a tick: move the reference towards
/// the received values as far as the law permits, virtual coupling (IPC), force gate, send (ARCHITECTURE.md, "Order
/// within a tick").
///
/// After construction: no heap, no lock, no clock; `prepare` and the `reconnect` that calls it allocate.
class Seat {
 public:
  /// @throws std::runtime_error if the law is unknown, the crypto library lacks a cipher, or the scene requests force
  /// separation from a device that is not calibrated.
  Seat(const SeatSetup& setup, const hal::DeviceCaps& caps, const transport::SecureChannel::Params& link);

  /// Channel and channel ends of one connection of this seat. Allocated outside the tick.
  struct Connection {
    std::unique_ptr<transport::SecureChannel> link;
    ToolChannels::Ends ends;
  };
  /// Returns a new connection for `reconnect`. Allocates. Any thread may call it, also while another thread ticks this
  /// seat.
  [[nodiscard]] Connection prepare(const transport::SecureChannel::Params& link) const;
  /// Replaces the connection after a server restart or a lost connection. Received values are dropped and energies
  /// restart at 0. The gate state and a local stop persist; a seat that is leaving stays closed.
  /// @param next  the new connection; holds the old one afterwards, so that the caller can free it outside the tick
  void reconnect(Connection& next) noexcept TANDEM_REALTIME;
  /// Prepares a connection and replaces the current one. Allocates, so it must not run within a tick.
  void reconnect(const transport::SecureChannel::Params& link);

  /// Handles one received datagram. Drops and counts datagrams that are invalid, older than the newest one, or of a
  /// type that a client does not receive.
  /// @param arrived  as the kernel stamped it: a client that shifts its ticks reads the same datagram earlier or later
  void on_datagram(Time arrived, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;
  /// Advances the seat by one tick of 1 / `SeatSetup::tick_hz` and returns the joint effort for the device.
  /// @param now     time of the tick
  /// @param device  reading of the device, HAL frame, SI units. A stale, non-finite or implausible reading is not used:
  ///                the last good one replaces it for 3 ticks, then the gate faults.
  /// @return        joint effort [N m or N] after the force gate, with its expiry; finite for every input
  [[nodiscard]] hal::Command on_servo(Time now, const hal::State& device) noexcept TANDEM_REALTIME;
  /// Writes the next datagram into `buffer`.
  /// @return its size [bytes]; nullopt when no datagram is due or `buffer` is too small
  [[nodiscard]] std::optional<std::size_t> poll_transmit(Time now,
                                                         std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

  /// Requests of the user of this seat.
  [[nodiscard]] SeatRequests& requests() noexcept { return requests_; }
  [[nodiscard]] const SeatRequests& requests() const noexcept { return requests_; }
  /// Sets the number of ticks of this client that began late so far. The seat sends it to the server for its status.
  void set_late_ticks(std::uint32_t total) noexcept { state_.telemetry.late_ticks = total; }
  /// Leaves the session: the gate ramps the force to zero, then the seat sends three CLOSE datagrams.
  void leave() noexcept { close_out_.leave(); }

  /// True once either end has closed the connection, for `close_reason`.
  [[nodiscard]] bool closed() const noexcept { return close_out_.closed(); }
  [[nodiscard]] wire::CloseReason close_reason() const noexcept { return close_out_.reason(); }
  /// The newest FORCE received and the STATE of the last tick. Both contain the values of the first tool.
  [[nodiscard]] const wire::ForceMessage& force() const noexcept { return tools_.force(); }
  [[nodiscard]] const wire::StateMessage& sample() const noexcept { return state_; }
  /// Values sent for one tool. @pre tool < tools().size()
  [[nodiscard]] const PortSample& sent(std::size_t tool) const noexcept {
    return tool == 0 ? state_.port : tools_.further_samples()[tool - 1];
  }
  [[nodiscard]] const SeatSetup& setup() const noexcept { return setup_; }
  [[nodiscard]] const transport::SecureChannel& link() const noexcept { return channel_.link(); }
  [[nodiscard]] const ToolChannels& tools() const noexcept { return tools_; }
  [[nodiscard]] const Coupling& coupling() const noexcept { return *coupling_; }
  [[nodiscard]] const control::ForceGate& gate() const noexcept { return gate_; }
  [[nodiscard]] const DevicePort& device() const noexcept { return device_; }
  [[nodiscard]] const ForceSeparation& separation() const noexcept { return separation_; }
  [[nodiscard]] const MotionScale& motion_scale() const noexcept { return motion_scale_; }
  [[nodiscard]] const SeatGuards& guards() const noexcept { return guards_; }
  [[nodiscard]] const SessionClock& clock() const noexcept { return clock_; }
  /// Age of the received values for the law [s]; a sample that the server holds back counts as new.
  [[nodiscard]] double sample_age(Time now) const noexcept { return seconds(link().timing().age(now)) - held_.held(); }
  [[nodiscard]] const AxisArray& effort() const noexcept { return effort_; }  ///< after the gate, port axes [N or N m]

 private:
  void on_force(Time arrived, const transport::SecureChannel::Opened& datagram) noexcept TANDEM_REALTIME;
  /// True if local stop, session state, role, guards and sensor all allow this seat to be engaged.
  [[nodiscard]] bool may_engage() const noexcept;
  [[nodiscard]] Coupling::Input coupling_input(double age) const noexcept;
  /// Restarts the coupling with zero elongation.
  void rest() noexcept TANDEM_REALTIME;
  void fill_state(Time now, bool homed, const AxisArray& wanted) noexcept TANDEM_REALTIME;

  SeatSetup setup_;
  double dt_;
  Duration command_life_;
  ClientChannel channel_;
  ToolChannels tools_;
  std::unique_ptr<Coupling> coupling_;
  control::ForceGate gate_;
  DevicePort device_;
  MotionScale motion_scale_;
  ForceSeparation separation_;
  SeatGuards guards_;
  SessionClock clock_;
  TelemetryPace telemetry_;
  std::optional<StatePace> pace_;  ///< empty: a STATE at every tick
  control::HeldSample held_;
  Duration wait_{};  ///< part of the loop age for which both ends may hold datagrams back; the gate does not count it
  SeatRequests requests_;
  CloseOut close_out_;
  wire::StateMessage state_{};
  AxisArray effort_{};
  bool fresh_ = false;  ///< a newer FORCE arrived since the last servo tick
  bool state_due_ = false;
  std::optional<Time> first_tick_;
  std::uint32_t tick_ = 0;
  double age_p99_ms_ = 0;
  std::uint64_t command_seq_ = 0;
};

/// Position of a seat's tip minus that of the leader [m], 3x1, HAL frame, both at the hand of this seat. The leader's
/// position is extrapolated to `now`. nullopt if no other seat leads, or if the law sends no leader.
[[nodiscard]] std::optional<hal::Vec3> offset_from_leader(const Seat& seat, Time now) noexcept;

}  // namespace tandem::client
