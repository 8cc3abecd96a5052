#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "client/seat/coupling.h"
#include "common/base/time.h"
#include "common/control/channel.h"
#include "common/control/energy_meter.h"
#include "common/control/force_gate.h"
#include "common/control/overspeed_guard.h"
#include "common/control/overtemperature_guard.h"
#include "common/control/stuck_sensor_guard.h"
#include "common/transport/secure_channel.h"
#include "hal/core/device.h"
#include "hal/core/port_map.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_codec.h"

namespace tandem::client {

/// The client core of one seat: takes device states, returns device commands, receives and sends datagrams.
/// The same core runs on a device's servo thread and in virtual time. Order within a tick: move the reference to the
/// received values, virtual coupling (IPC), force gate, send (design notes, control 4).
///
/// The term `tie` denotes the coupling of this seat to one tool. A seat has one tie, or under law `replica` one for
/// each tool that it follows.
///
/// After construction: no heap, no lock, no clock; `prepare` and the `reconnect` that calls it allocate.
class Seat {
 public:
  /// @throws std::runtime_error if the law is unknown or the crypto library lacks a cipher.
  Seat(const SeatSetup& setup, const hal::DeviceCaps& caps, const transport::SecureChannel::Params& link);
  Seat(const Seat&) = delete;  // ties_ points into this object
  Seat& operator=(const Seat&) = delete;

  /// Channel and channel ends of one connection of this seat. Allocated outside the tick.
  struct Connection {
    std::unique_ptr<transport::SecureChannel> link;
    std::vector<std::unique_ptr<control::ChannelEnd>> ends;  ///< one per tie
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
  void on_datagram(Time now, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;
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

  /// Requests new authority over one tool. Sent every 20 ms until the server shows a newer version, at most for 1 s.
  /// Allowed for INSTRUCTOR and TRAINEE seats; the server grants a trainee only the return of own authority to
  /// instructors.
  /// @param tool   number of the tool
  /// @param alpha  authority of each master seat, in [0, 1], sum 1
  /// @return       false for other roles, or for more than `kMastersMax` values
  bool request_authority(std::uint32_t tool, std::span<const double> alpha) noexcept;
  /// Stops this seat: its force ramps to zero from the next tick on. The local stop lasts until `request_resume`.
  void request_local_stop() noexcept { local_stop_ = true; }
  /// Requests a stop of the whole session, or a pause if the role may only pause. The request is repeated until the
  /// server counts a new stop.
  /// @return false for observers and for SLAVE seats
  bool request_stop_all() noexcept;
  /// Ends the local stop, and also the session's stop or pause if this seat may end it. The request names the newest
  /// stop received, so it does not end a later one.
  void request_resume() noexcept;
  [[nodiscard]] bool locally_stopped() const noexcept { return local_stop_; }

  /// Clears a latched gate and latched guards with the next tick.
  void request_gate_reset() noexcept { reset_ = true; }
  /// Sets the number of ticks of this client that began late so far. The seat sends it to the server for its status.
  void set_late_ticks(std::uint32_t total) noexcept { tx_.late_ticks = total; }
  /// Leaves the session: the gate ramps the force to zero, then the seat sends three CLOSE datagrams.
  void leave() noexcept { leaving_ = true; }

  /// Time since the session start on this client's clock [s], without the stops that halt the session clock; nullopt
  /// before the start. Simulated devices follow it, because a server that restores a checkpoint does not set it back.
  [[nodiscard]] std::optional<double> session_time(Time now) const noexcept;
  /// Session time as the current server counts it [s]: without outages of the server. nullopt until the session runs.
  /// Scripts and screens use it, so that all participants of a session read the same time.
  [[nodiscard]] std::optional<double> server_time(Time now) const noexcept;
  /// True if the session clock is halted: the session is STOPPED or PAUSED and its scene does not let the clock run on.
  [[nodiscard]] bool clock_stopped() const noexcept;
  /// True once either end has closed the connection, for `close_reason`.
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  [[nodiscard]] wire::CloseReason close_reason() const noexcept { return close_reason_; }
  /// The newest FORCE received and the STATE of the last tick.
  [[nodiscard]] const wire::ForceMessage& force() const noexcept { return rx_; }
  [[nodiscard]] const wire::StateMessage& sample() const noexcept { return tx_; }
  [[nodiscard]] const control::ForceGate& gate() const noexcept { return gate_; }
  /// Number of tools that this seat is coupled to, each by its own channel end. `force` and `sample` contain the values
  /// of the first tie.
  [[nodiscard]] std::size_t ties() const noexcept { return ties_.size(); }
  /// Channel end, received and sent values of one tie. @pre tie < ties()
  [[nodiscard]] const control::ChannelEnd& channel(std::size_t tie = 0) const noexcept { return *ends_[tie]; }
  [[nodiscard]] const wire::ToolForce& received(std::size_t tie) const noexcept { return *ties_[tie].received; }
  [[nodiscard]] const PortSample& sent(std::size_t tie) const noexcept {
    return tie == 0 ? tx_.port : further_tx_[tie - 1];
  }
  /// Largest authority of this seat over any of its tools, in [0, 1].
  [[nodiscard]] double authority() const noexcept;
  [[nodiscard]] const transport::SecureChannel& link() const noexcept { return *link_; }
  [[nodiscard]] const SeatSetup& setup() const noexcept { return setup_; }
  [[nodiscard]] const Coupling& coupling() const noexcept { return *coupling_; }
  [[nodiscard]] bool sensor_stuck() const noexcept { return stuck_sensor_.stuck(); }
  [[nodiscard]] const control::OverspeedGuard& overspeed_guard() const noexcept { return overspeed_; }
  [[nodiscard]] const control::OvertemperatureGuard& overtemperature_guard() const noexcept { return overtemperature_; }
  [[nodiscard]] const std::optional<double>& heat() const noexcept {
    return reading_.heat;
  }  ///< of the hottest motor, as in hal::State: share of the allowed heat; 1 is too hot
  [[nodiscard]] const AxisArray& effort() const noexcept { return effort_; }  ///< after the gate, port axes [N or N m]
  /// Position of this seat's tip minus that of the leader [m], 3x1, HAL frame. The leader's position is extrapolated to
  /// `now`. nullopt if no other seat leads, or if the law sends no leader.
  [[nodiscard]] std::optional<hal::Vec3> offset_from_leader(Time now) const noexcept;
  [[nodiscard]] hal::Vec3 tip_force() const noexcept {
    return map_.tip_force(reading_, effort_);
  }  ///< `effort` as a force at the tip [N], 3x1, HAL frame

 private:
  [[nodiscard]] bool take_reading(const hal::State& device) noexcept;
  [[nodiscard]] AxisArray control(Time now) noexcept TANDEM_REALTIME;
  /// True if local stop, session state, role, guards and sensor all allow this seat to be engaged.
  [[nodiscard]] bool may_engage() const noexcept;
  /// `inhibited`: a guard prevents engagement. `latched`: only `request_gate_reset` ends that.
  [[nodiscard]] bool inhibited() const noexcept { return overspeed_.inhibits() || overtemperature_.inhibits(); }
  [[nodiscard]] bool latched() const noexcept { return overspeed_.latched() || overtemperature_.latched(); }
  void clear_satisfied_requests() noexcept;
  void on_new_authority_version() noexcept TANDEM_REALTIME;
  void set_session_clock(Time now) noexcept TANDEM_REALTIME;
  [[nodiscard]] Coupling::Input coupling_input(double age) const noexcept;
  void bind_ties() noexcept;
  void rest() noexcept TANDEM_REALTIME;
  void fill_sample(Time now, const hal::State& device, const AxisArray& wanted) noexcept TANDEM_REALTIME;

  SeatSetup setup_;
  hal::PortMap map_;
  std::size_t joints_;
  double dt_;
  Duration command_life_;
  std::unique_ptr<transport::SecureChannel> link_;
  wire::Codec codec_;
  std::vector<std::unique_ptr<control::ChannelEnd>> ends_;
  std::unique_ptr<Coupling> coupling_;
  control::ForceGate gate_;
  control::EnergyMeter meter_;

  hal::State reading_{};  ///< last valid reading
  AxisArray q_{}, v_{};   ///< position and velocity of the port [m, m/s or rad, rad/s]
  unsigned bad_readings_ = 0;
  control::StuckSensorGuard stuck_sensor_;
  control::OverspeedGuard overspeed_;
  control::OvertemperatureGuard overtemperature_;
  wire::ForceMessage rx_{};
  wire::StateMessage tx_{};
  /// Received and sent values of the ties beyond the first. Datagrams are decoded into `further_next_`, so that a
  /// datagram rejected half way changes nothing.
  std::vector<wire::ToolForce> further_rx_, further_next_;
  std::vector<PortSample> further_tx_;
  std::vector<Coupling::Tie> ties_;
  AxisArray effort_{};
  bool fresh_ = false;  ///< a newer FORCE arrived since the last servo tick
  bool heard_force_ = false;
  Time started_{};
  std::uint32_t tick_ = 0;
  bool ticked_ = false;
  std::optional<Time> session_start_;        ///< by the current server's count
  std::optional<Time> first_session_start_;  ///< by the first server's count; survives server restarts
  std::uint32_t stops_at_clock_ = 0;         ///< number of stops when the session clock was last set
  double age_p99_ms_ = 0;

  bool local_stop_ = false, stop_all_ = false;
  std::optional<std::uint32_t> stops_at_request_;  ///< number of stops at the request; empty: no FORCE received since
  std::uint32_t resume_stop_ = 0;
  bool state_due_ = false, reset_ = false, leaving_ = false, closed_ = false;
  unsigned close_due_ = 0;
  wire::CloseReason close_reason_ = wire::CloseReason::kDone;
  std::optional<wire::PathMessage> path_answer_;  ///< reply due to a PATH_CHALLENGE (address validation)
  std::optional<wire::AuthorityMessage> authority_;
  bool authority_follows_ = false;  ///< replaces a request that was sent against the same version
  Time authority_sent_{}, authority_asked_{};
  std::uint64_t command_seq_ = 0;
};

}  // namespace tandem::client
