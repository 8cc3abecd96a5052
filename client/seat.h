#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "client/coupling.h"
#include "client/frozen_sensor.h"
#include "client/over_speed.h"
#include "client/over_temperature.h"
#include "common/base/time.h"
#include "common/control/channel.h"
#include "common/control/energy_meter.h"
#include "common/control/force_gate.h"
#include "common/link/link.h"
#include "hal/device.h"
#include "hal/port_map.h"
#include "proto/seat_setup.h"
#include "proto/wire_codec.h"

namespace tandem::client {

/// One hand at one seat: device state in, device command out, datagrams in between. The same core runs on a device's servo thread
/// and in virtual time. Order within a tick: move the reference to what was received, IPC, force gate, send (design notes, control 4).
///
/// No heap, no lock, no clock after construction.
class Seat {
 public:
  /// @throws SetupError-like std::runtime_error if the law is unknown or the crypto library lacks a cipher.
  Seat(const SeatSetup& setup, const hal::DeviceCaps& caps, const link::Link::Params& link);
  Seat(const Seat&) = delete;  // its ties point into it
  Seat& operator=(const Seat&) = delete;

  /// A new connection for this hand, made where memory may be taken.
  struct Connection {
    std::unique_ptr<link::Link> link;
    std::vector<std::unique_ptr<control::ChannelEnd>> ends;  ///< one per tie
  };
  /// On any thread, also while others serve this seat.
  [[nodiscard]] Connection prepare(const link::Link::Params& link) const;
  /// The server gave this hand a new connection, as it was started anew or the old one was lost: what was received is void and
  /// energies start at 0. The gate, and what a person has stopped, stay as they are; who is leaving does not come back.
  /// @param next  holds the old one afterwards, to be given back elsewhere
  void rejoin(Connection& next) noexcept TANDEM_REALTIME;
  /// Both at once. Not below a tick: takes memory.
  void rejoin(const link::Link::Params& link);

  void on_datagram(Time now, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;
  /// Once per device exchange. Total: a reading that is not finite, or that no device can have, never leaves this seat and never
  /// moves the hand.
  [[nodiscard]] hal::Command on_servo(Time now, const hal::State& device) noexcept TANDEM_REALTIME;
  /// Writes the next datagram into `buffer`; nullopt when nothing is due.
  [[nodiscard]] std::optional<std::size_t> poll_transmit(Time now, std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

  /// Asks for new weights until the server shows a newer version, for 1 s at most. INSTRUCTOR seats; a TRAINEE only gets to give back to instructors
  /// what is his. @return false for other roles.
  bool request_authority(std::uint32_t tool, std::span<const double> alpha) noexcept;
  /// The person stops his own hand: it is let go with the next servo tick and stays so until the same person resumes.
  void press_stop() noexcept { own_stop_ = true; }
  /// The person wants everybody's hands stopped, or paused where his role may no more: asked until the server counts a new stop.
  /// @return false for roles that may not
  bool press_stop_all() noexcept;
  /// Ends the own stop; and the session's, where the role may: the stop that this person sees, not a newer one.
  void press_resume() noexcept;
  [[nodiscard]] bool stopped() const noexcept { return own_stop_; }

  /// The person pressed the button that clears a latched gate.
  void press_reset() noexcept { reset_ = true; }
  /// Ticks of this machine that began late, so far: told to the server for its status.
  void note_late_ticks(std::uint32_t total) noexcept { tx_.late_ticks = total; }
  /// Lets go: the gate ramps out, then the server is told.
  void leave() noexcept { leaving_ = true; }

  /// Seconds since the session began, on the own clock, without the time for which a stop made it stand still; nullopt before. What
  /// simulated hands follow; a server that comes back from a checkpoint does not turn it back.
  [[nodiscard]] std::optional<double> session_time(Time now) const noexcept;
  /// The same as the server counts that answers now, which was not there during an outage: for scripts and screens, so that all people
  /// of a session read one time. nullopt until it runs.
  [[nodiscard]] std::optional<double> server_time(Time now) const noexcept;
  /// The session clock stands still: the session is STOPPED or PAUSED, and its scene does not want it to run on.
  [[nodiscard]] bool clock_stands() const noexcept;
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  [[nodiscard]] wire::CloseReason close_reason() const noexcept { return close_reason_; }
  [[nodiscard]] const wire::ForceMessage& force() const noexcept { return rx_; }
  [[nodiscard]] const wire::StateMessage& sample() const noexcept { return tx_; }
  [[nodiscard]] const control::ForceGate& gate() const noexcept { return gate_; }
  /// Tools that this hand is tied to, each by an end of its own: the first one's stands in `force` and `sample`.
  [[nodiscard]] std::size_t ties() const noexcept { return ties_.size(); }
  [[nodiscard]] const control::ChannelEnd& channel(std::size_t tie = 0) const noexcept { return *ends_[tie]; }
  [[nodiscard]] const wire::TieForce& told(std::size_t tie) const noexcept { return *ties_[tie].told; }
  [[nodiscard]] const PortSample& told_of(std::size_t tie) const noexcept { return tie == 0 ? tx_.port : further_tx_[tie - 1]; }
  /// The largest over any of its tools.
  [[nodiscard]] double authority() const noexcept;
  [[nodiscard]] const link::Link& link() const noexcept { return *link_; }
  [[nodiscard]] const SeatSetup& setup() const noexcept { return setup_; }
  [[nodiscard]] const Coupling& coupling() const noexcept { return *coupling_; }
  [[nodiscard]] bool sensor_frozen() const noexcept { return sensor_.frozen(); }
  [[nodiscard]] const OverSpeed& over_speed() const noexcept { return over_speed_; }
  [[nodiscard]] const OverTemperature& over_temperature() const noexcept { return over_temperature_; }
  [[nodiscard]] const std::optional<double>& heat() const noexcept { return reading_.heat; }  ///< as the device told it (hal::State)
  [[nodiscard]] const AxisArray& effort() const noexcept { return effort_; }  ///< after the gate, port axes
  /// The tip minus that of the hand that leads, as far as both are known by now [m]; nothing: no other hand leads, or the law does not tell.
  [[nodiscard]] std::optional<hal::Vec3> beside_leader(Time now) const noexcept;
  [[nodiscard]] hal::Vec3 tip_force() const noexcept { return map_.tip_force(reading_, effort_); }  ///< the same at the tip [N]

 private:
  [[nodiscard]] bool take_reading(const hal::State& device) noexcept;
  [[nodiscard]] AxisArray control(Time now) noexcept TANDEM_REALTIME;
  /// Whether the person, the session and the sensor let this hand be engaged.
  [[nodiscard]] bool may_engage() const noexcept;
  /// A guard keeps this hand from being engaged; or only the person's button lets it be again.
  [[nodiscard]] bool held_off() const noexcept { return over_speed_.holds_off() || over_temperature_.holds_off(); }
  [[nodiscard]] bool latched_off() const noexcept { return over_speed_.latched() || over_temperature_.latched(); }
  void settle_wishes() noexcept;
  void meet_new_version() noexcept TANDEM_REALTIME;
  void set_session_clock(Time now) noexcept TANDEM_REALTIME;
  [[nodiscard]] Coupling::Input coupling_input(double age) const noexcept;
  void tie() noexcept;
  void rest() noexcept TANDEM_REALTIME;
  void fill_sample(Time now, const hal::State& device, const AxisArray& wanted) noexcept TANDEM_REALTIME;

  SeatSetup setup_;
  hal::PortMap map_;
  std::size_t joints_;
  double dt_;
  Duration command_life_;
  std::unique_ptr<link::Link> link_;
  wire::Codec codec_;
  std::vector<std::unique_ptr<control::ChannelEnd>> ends_;
  std::unique_ptr<Coupling> coupling_;
  control::ForceGate gate_;
  control::EnergyMeter meter_;

  hal::State reading_{};       ///< last valid one
  AxisArray q_{}, v_{};        ///< of the port
  unsigned bad_readings_ = 0;
  FrozenSensor sensor_;
  OverSpeed over_speed_;
  OverTemperature over_temperature_;
  wire::ForceMessage rx_{};
  wire::StateMessage tx_{};
  /// Of the ties beyond the first. What is heard is read into room of its own: a datagram that is refused half way changes nothing.
  std::vector<wire::TieForce> further_rx_, further_next_;
  std::vector<PortSample> further_tx_;
  std::vector<Coupling::Tie> ties_;
  AxisArray effort_{};
  bool fresh_ = false;         ///< something newer came since the last servo tick
  bool heard_force_ = false;
  Time started_{};
  std::uint32_t tick_ = 0;
  bool ticked_ = false;
  std::optional<Time> session_begin_;  ///< as this server counts
  std::optional<Time> person_begin_;   ///< as the first server did: people go on while servers come and go
  std::uint32_t clock_stops_ = 0;      ///< stops so far when the clock was learned
  double age_p99_ms_ = 0;

  bool own_stop_ = false, stop_all_ = false;
  std::optional<std::uint32_t> stops_at_press_;  ///< of the wish; nothing: this server has not spoken since
  std::uint32_t resume_stop_ = 0;
  bool state_due_ = false, reset_ = false, leaving_ = false, closed_ = false;
  unsigned close_due_ = 0;
  wire::CloseReason close_reason_ = wire::CloseReason::kDone;
  std::optional<wire::PathMessage> path_answer_;  ///< the server asks whether this end really is where it heard it from
  std::optional<wire::AuthorityMessage> authority_;
  bool authority_follows_ = false;  ///< one that it replaces was sent against the same version
  Time authority_sent_{}, authority_asked_{};
  std::uint64_t command_seq_ = 0;
};

}  // namespace tandem::client
