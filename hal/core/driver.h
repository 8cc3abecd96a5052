#pragma once

#include <cstdint>
#include <expected>
#include <string_view>

#include "hal/core/device.h"

namespace tandem::hal {

/// Observer of a device's bring-up: receives progress, can cancel, and relays requests to the user.
struct BringUp {
  virtual ~BringUp() = default;
  /// Reports progress.
  /// @param step      text for the user
  /// @param fraction  of this step [0, 1]
  virtual void progress(std::string_view step, double fraction) = 0;
  /// Returns whether the bring-up should end early.
  [[nodiscard]] virtual bool cancelled() const noexcept = 0;
  /// Asks the user for an action and waits for their confirmation.
  /// @return false: no user can answer, or the user gave up
  [[nodiscard]] virtual bool request_user_action(std::string_view request) { return (void)request, false; }
};

/// Motor command of one exchange. It has passed the guard: a driver only maps it, clamps it to its integer range and
/// sends it.
struct ServoCommand {
  std::uint64_t seq = 0;  ///< sequence number of the original command; returned as State::echo_command
  AxisArray effort{};     ///< joint effort [N m] or [N], finite
  bool homing = false;    ///< ask the device to find its origin; the effort is zero meanwhile
  std::uint8_t leds = 0;  ///< bit per light
};

/// Result of one exchange.
enum class Exchange : std::uint8_t {
  kFresh,     ///< `state` is new
  kNothing,   ///< no complete reply in time; `state` is unchanged
  kResynced,  ///< as kFresh, after bytes were lost or discarded: positions may have jumped
};

/// Driver of one kind of device: protocol codec, kinematics, start-up.
/// One thread owns and calls it. It waits only in pipes and on the clock it was given, so the same driver runs in
/// virtual time.
/// The phases, the guard and the statistics are in ServoCore, shared by all drivers.
struct Driver {
  virtual ~Driver() = default;
  /// Returns the identity.
  [[nodiscard]] virtual const DeviceId& id() const noexcept = 0;
  /// Constant after `bring_up` has succeeded.
  [[nodiscard]] virtual const DeviceCaps& caps() const noexcept = 0;
  /// Brings the device up: reset, firmware, calibration, first reading. Leaves zero effort.
  /// May take seconds; may be called again after an error. Error: message with cause and remedy.
  virtual Result<> bring_up(BringUp& watcher) = 0;
  /// Sends `command` and receives the newest reading, within about one period.
  /// Sets in `state`: seq, echo_command, sampled_at, q, dq, x, dx, J, raw, buttons, homed, saturated; heat if the
  /// device reports it. Also tau_out and f_out, computed from the effort sent after integer encoding.
  /// Error: kUnplugged ends the device; kFraming, kProtocol and kTimeout count against the miss limit.
  virtual std::expected<Exchange, Errc> exchange(const ServoCommand& command,
                                                 State& state) noexcept TANDEM_REALTIME = 0;
  /// Sends at least three frames with zero effort if the device is reachable. May be called again and after any error.
  virtual void send_zeros() noexcept = 0;
};

}  // namespace tandem::hal
