#pragma once

#include "common/base/rng.h"
#include "hal/core/device.h"
#include "netsim/system/fault_schedule.h"

namespace tandem::netsim {

/// Sensors of a simulated device with the faults of a schedule: readings that are frozen, absurd or not numbers, and
/// motors that report too much heat.
class SensorFaults {
 public:
  /// @param key  randomness of joints and values of invalid readings, by tick
  SensorFaults(RandomKey key, Duration tick) : key_(key), tick_(tick) {}

  /// Returns the reading that the program gets at `now` in place of the device's state. The result lives no
  /// longer than `state`.
  /// @param joints  number of joints of the device
  [[nodiscard]] const hal::State& read(Time now, const FaultSchedule& faults, const hal::State& state,
                                       std::size_t joints) noexcept;
  /// Returns whether the last reading was invalid.
  [[nodiscard]] bool invalid() const noexcept { return invalid_; }

 private:
  RandomKey key_;
  Duration tick_;
  hal::State reading_{};
  bool frozen_ = false, invalid_ = false;
};

}  // namespace tandem::netsim
