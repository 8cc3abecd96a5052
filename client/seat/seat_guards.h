#pragma once

#include <cstddef>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "common/control/overspeed_guard.h"
#include "common/control/overtemperature_guard.h"
#include "common/control/stuck_sensor_guard.h"
#include "hal/core/device.h"
#include "proto/text/seat_setup.h"

namespace tandem::client {

/// The guards that keep a seat disengaged, independently of server and control law: speed of the tip, heat of the
/// motors, stuck sensor. Real-time safe.
class SeatGuards {
 public:
  /// @param joints  joints of the device
  SeatGuards(const SeatSetup& setup, std::size_t joints) noexcept
      : joints_(joints),
        dof_(setup.dof),
        scale_(setup.axis_scale),
        // A slave in contact with a stiff object may rest without a stuck sensor.
        checks_sensor_(setup.seat.kind == SeatKind::kMaster) {}

  /// Judges one reading.
  /// @param reading  newest valid reading  @param reference  of the seat's first tool, port axes
  /// @param effort   motor effort of the last tick, port axes  @param active  force may reach the hand
  void update(Time now, const hal::State& reading, const AxisArray& reference, const AxisArray& effort,
              bool active) noexcept TANDEM_REALTIME {
    if (checks_sensor_) stuck_sensor_.update(now, reading.q, joints_, reference, effort, scale_, dof_, active);
    overspeed_.update(now, reading.dx.norm(), active);
    overtemperature_.update(reading.heat, active);
  }
  /// Clears latched guards.
  void reset() noexcept {
    overspeed_.reset();
    overtemperature_.reset();
  }

  /// True if the seat must not engage.
  [[nodiscard]] bool inhibit() const noexcept {
    return stuck_sensor_.stuck() || overspeed_.inhibits() || overtemperature_.inhibits();
  }
  /// True if only `reset` ends the inhibition.
  [[nodiscard]] bool latched() const noexcept { return overspeed_.latched() || overtemperature_.latched(); }
  [[nodiscard]] const control::StuckSensorGuard& stuck_sensor() const noexcept { return stuck_sensor_; }
  [[nodiscard]] const control::OverspeedGuard& overspeed() const noexcept { return overspeed_; }
  [[nodiscard]] const control::OvertemperatureGuard& overtemperature() const noexcept { return overtemperature_; }

 private:
  std::size_t joints_, dof_;
  AxisArray scale_;
  bool checks_sensor_;
  control::StuckSensorGuard stuck_sensor_;
  control::OverspeedGuard overspeed_;
  control::OvertemperatureGuard overtemperature_;
};

}  // namespace tandem::client
