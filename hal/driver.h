#pragma once

#include <cstdint>
#include <expected>
#include <string_view>

#include "hal/device.h"

namespace tandem::hal {

/// Who waits while a device is brought up: told how far it is, asked whether to go on.
struct BringUp {
  virtual ~BringUp() = default;
  /// @param fraction  of this step [0, 1]
  virtual void progress(std::string_view step, double fraction) = 0;
  [[nodiscard]] virtual bool cancelled() const noexcept = 0;
  /// Asks the person to do something, and waits for their word that it is done.
  /// @return false: nobody is there to answer, or they gave up
  [[nodiscard]] virtual bool person_did(std::string_view request) { return (void)request, false; }
};

/// What the motors shall do during one exchange; already guarded, so a driver only maps, clamps to its integers, sends.
struct Orders {
  std::uint64_t seq = 0;  ///< of the command behind it; comes back as State::echo_command
  AxisArray effort{};     ///< joint effort [N m] or [N], finite
  bool homing = false;    ///< ask the device to find its origin; the effort is zero then
  std::uint8_t leds = 0;  ///< bit per light
};

/// How one exchange went.
enum class Exchange : std::uint8_t {
  kFresh,     ///< `state` is new
  kNothing,   ///< no (whole) answer in time; `state` is as before
  kResynced,  ///< as kFresh, after bytes were lost or thrown away: positions may have jumped
};

/// One kind of device on the wire: codec, kinematics, start-up. Owned and called by one thread; waits only in pipes and on
/// the clock it was given, so that the same driver runs in virtual time. State machine, guard and statistics are not
/// here: ServoCore has them, for all drivers.
struct Driver {
  virtual ~Driver() = default;
  [[nodiscard]] virtual const DeviceId& id() const noexcept = 0;
  /// Final once `bring_up` has succeeded.
  [[nodiscard]] virtual const DeviceCaps& caps() const noexcept = 0;
  /// Reset, firmware, calibration, first reading. May take seconds and be repeated after trouble. Leaves zero effort.
  /// Error: message with cause and remedy.
  virtual Result<> bring_up(BringUp& watcher) = 0;
  /// Sends orders and takes the newest reading, within about one period. Sets of `state`: seq, echo_command, sampled_at,
  /// q, dq, x, dx, J, tau_out, f_out (of what was really sent, after integer encoding), raw, buttons, homed, saturated; heat where it is told.
  /// Error: kUnplugged ends the device; kFraming, kProtocol, kTimeout are counted against the miss limit.
  virtual std::expected<Exchange, Errc> exchange(const Orders& orders, State& state) noexcept TANDEM_REALTIME = 0;
  /// At least three frames with zero effort, while the link lives. May be called again and after any error.
  virtual void silence() noexcept = 0;
};

}  // namespace tandem::hal
