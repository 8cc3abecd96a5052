#pragma once

#include <atomic>
#include <memory>

#include "common/base/histogram.h"
#include "hal/core/driver.h"
#include "hal/core/driver_guard.h"

namespace tandem::hal {

/// A driver with the functions common to all drivers: phases, guard, missed replies, statistics, one client.
/// The caller passes the time, so the core runs in virtual time as it does on a device's thread.
///
/// Phases: Absent -> Opening -> Booting -> Identified -> Unhomed -> Ready (zero force) -> Enabled -> Fault | Lost.
/// - Fault: no reply within the miss limit, or repeated implausible readings. The core keeps exchanging zeros until
///   `reset`.
/// - Lost: final. A device that is plugged in again is a new device, and only the user enables it.
/// - A homed device that loses its origin becomes Unhomed again.
/// - A driver that finds its firmware dead (Errc::kFirmware) becomes Booting and needs `bring_up` again.
/// After 20 ms without a step, forces restart at zero with a soft start.
///
/// Threads: `bring_up` and `step` on the device's thread; `enable`, `disable`, `reset`, `phase` from any thread.
class ServoCore {
 public:
  /// @param driver  not yet brought up
  /// @param limits  replace the limits that follow from the device's capabilities
  explicit ServoCore(std::unique_ptr<Driver> driver, std::optional<GuardLimits> limits = {});
  /// @param driver  not yet brought up
  /// @param signs  knowledge of its motor directions
  ServoCore(std::unique_ptr<Driver> driver, MotorSigns signs);

  /// Returns the identity of the device.
  [[nodiscard]] const DeviceId& id() const noexcept { return driver_->id(); }
  /// Returns the capabilities of the device.
  [[nodiscard]] const DeviceCaps& caps() const noexcept { return driver_->caps(); }
  /// Returns the limits of the guard.
  [[nodiscard]] const GuardLimits& limits() const noexcept { return limits_; }
  /// Returns the present phase. Thread-safe.
  [[nodiscard]] Phase phase() const noexcept { return phase_.load(std::memory_order_acquire); }

  /// Brings the device up, from Absent, Fault, Lost or Booting to Unhomed or Ready. Error: that of the driver; the
  /// phase is then Fault or Lost.
  Result<> bring_up(BringUp& watcher);
  /// Performs one exchange, then calls the client once; does nothing while Booting.
  /// @return false: the device is Lost, and the client has received `lost`
  bool step(Time now, ServoClient& client) noexcept TANDEM_REALTIME;
  /// Returns whether the last step may have sent a force.
  [[nodiscard]] bool motors_enabled() const noexcept { return acted_ == Phase::kEnabled; }
  /// Sends zero effort if the device is reachable.
  void send_zeros() noexcept { driver_->send_zeros(); }
  /// Records the duration of the last exchange for the statistics: the core reads no clock.
  void record_round_trip(Duration round_trip) noexcept { round_trips_.add(round_trip.count()); }

  /// Lets commands reach the motors. Error: kBadState unless Ready.
  Result<> enable();
  /// Keeps commands from the motors: Enabled -> Ready.
  void disable() noexcept;
  /// Leaves Fault. Error: kBadState if the device is Lost.
  Result<> reset();

  /// Returns the newest reading.
  [[nodiscard]] const State& state() const noexcept { return state_; }
  /// Returns the counters so far.
  [[nodiscard]] const DeviceStats& counts() const noexcept { return stats_; }
  /// Returns the durations that `record_round_trip` received [ns].
  [[nodiscard]] const Histogram& round_trips() const noexcept { return round_trips_; }

 private:
  bool change(Phase from, Phase to) noexcept { return phase_.compare_exchange_strong(from, to); }
  void follow_homing(Phase phase, Time now) noexcept;
  void check_response(Time now, Exchange how) noexcept;

  std::unique_ptr<Driver> driver_;
  std::optional<GuardLimits> asked_;
  MotorSigns signs_ = MotorSigns::kUnconfirmed;
  GuardLimits limits_;
  DriverGuard guard_{{}, 0};
  std::atomic<Phase> phase_{Phase::kAbsent};
  Phase acted_ = Phase::kAbsent;  ///< the phase of the last step
  State state_;
  Command command_;
  Time asked_at_{};        ///< time of the last exchange
  Duration silent_for_{};  ///< time of exchanges without a complete reply since the last complete one
  bool stepped_ = false;
  Time stepped_at_{};
  DeviceStats stats_;
  Histogram round_trips_;
};

}  // namespace tandem::hal
