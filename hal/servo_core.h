#pragma once

#include <atomic>
#include <memory>

#include "common/base/histogram.h"
#include "hal/driver.h"
#include "hal/driver_guard.h"

namespace tandem::hal {

/// A driver with everything that is the same for all of them: phases, guard, misses, statistics, one client. Time is told
/// to it, so it runs in virtual time as it does on a device's thread.
///
/// Absent -> Opening -> Booting -> Identified -> Unhomed -> Ready (zero force) -> Enabled -> Fault | Lost. Fault (no answer
/// within the miss limit, or readings that cannot be, again and again) keeps exchanging zeros and needs `reset`; Lost is
/// for ever: a device that comes back is another one, and nobody enables it but a person. A homed device that loses its
/// origin is Unhomed again. Forces begin anew at zero, softly, after nobody stepped it for 20 ms. A driver that finds its firmware dead (Errc::kFirmware) is Booting: `bring_up` anew.
///
/// Threads: `bring_up` and `step` on the device's thread; `enable`, `disable`, `reset`, `phase` from any.
class ServoCore {
 public:
  /// @param limits  instead of those that follow from what the device says of itself
  explicit ServoCore(std::unique_ptr<Driver> driver, std::optional<GuardLimits> limits = {});
  /// @param signs  what is known of the directions of its motors
  ServoCore(std::unique_ptr<Driver> driver, MotorSigns signs);

  [[nodiscard]] const DeviceId& id() const noexcept { return driver_->id(); }
  [[nodiscard]] const DeviceCaps& caps() const noexcept { return driver_->caps(); }
  [[nodiscard]] const GuardLimits& limits() const noexcept { return limits_; }
  [[nodiscard]] Phase phase() const noexcept { return phase_.load(std::memory_order_acquire); }

  /// From Absent, Fault or Lost... to Unhomed or Ready. Error: the driver's, phase Fault or Lost.
  Result<> bring_up(BringUp& watcher);
  /// One exchange, then one call of the client; nothing while Booting.
  /// @return false: the device is Lost, and the client was told
  bool step(Time now, ServoClient& client) noexcept TANDEM_REALTIME;
  /// Whether the last step may have sent a force.
  [[nodiscard]] bool energised() const noexcept { return acted_ == Phase::kEnabled; }
  /// Zeros, while the link lives.
  void silence() noexcept { driver_->silence(); }
  /// How long the last exchange took, for the statistics: the core reads no clock.
  void took(Duration round_trip) noexcept { round_trips_.add(round_trip.count()); }

  Result<> enable();
  void disable() noexcept;
  Result<> reset();

  [[nodiscard]] const State& state() const noexcept { return state_; }
  [[nodiscard]] const DeviceStats& counts() const noexcept { return stats_; }
  [[nodiscard]] const Histogram& round_trips() const noexcept { return round_trips_; }

 private:
  bool change(Phase from, Phase to) noexcept { return phase_.compare_exchange_strong(from, to); }
  void follow_homing(Phase phase, Time now) noexcept;
  void judge(Time now, Exchange how) noexcept;

  std::unique_ptr<Driver> driver_;
  std::optional<GuardLimits> asked_;
  MotorSigns signs_ = MotorSigns::kUnconfirmed;
  GuardLimits limits_;
  DriverGuard guard_{{}, 0};
  std::atomic<Phase> phase_{Phase::kAbsent};
  Phase acted_ = Phase::kAbsent;  ///< the phase of the last step
  State state_;
  Command command_;
  Time asked_at_{};        ///< the last exchange
  Duration silent_for_{};  ///< time of exchanges without a whole answer since the last one with
  bool stepped_ = false;
  Time stepped_at_{};
  DeviceStats stats_;
  Histogram round_trips_;
};

}  // namespace tandem::hal
