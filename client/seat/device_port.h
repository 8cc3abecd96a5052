#pragma once

#include <cstddef>

#include "common/base/axes.h"
#include "common/control/energy_meter.h"
#include "hal/core/device.h"
#include "hal/core/port_map.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// The device of a seat as a port: the newest valid reading, its position and velocity in port axes, and the energy
/// that the motors delivered. Real-time safe.
class DevicePort {
 public:
  DevicePort(PortSpace space, std::size_t dof, std::size_t joints) noexcept
      : map_(space, dof, joints), joints_(joints) {}

  /// Takes a reading. A stale, non-finite or implausible reading is not used: the last valid one replaces it.
  /// @return false if more than 3 consecutive readings were invalid
  [[nodiscard]] bool update(const hal::State& device) noexcept TANDEM_REALTIME;

  [[nodiscard]] std::size_t joints() const noexcept { return joints_; }
  [[nodiscard]] const hal::State& reading() const noexcept { return reading_; }
  /// Position and velocity of the port [m, m/s or rad, rad/s].
  [[nodiscard]] const AxisArray& q() const noexcept { return q_; }
  [[nodiscard]] const AxisArray& v() const noexcept { return v_; }
  /// Returns the joint effort [N or N m] of an effort in port axes.
  [[nodiscard]] AxisArray joint_effort(const AxisArray& effort) const noexcept TANDEM_REALTIME {
    return map_.joint_effort(reading_, effort);
  }
  /// Returns an effort in port axes as a force at the tip [N], 3x1, HAL frame.
  [[nodiscard]] hal::Vec3 tip_force(const AxisArray& effort) const noexcept TANDEM_REALTIME {
    return map_.tip_force(reading_, effort);
  }
  /// Writes the values of the device into `out`. @param wanted  effort before the gate, port axes
  void fill(const AxisArray& wanted, wire::Telemetry& out) const noexcept TANDEM_REALTIME;

 private:
  hal::PortMap map_;
  std::size_t joints_;
  hal::State reading_{};
  AxisArray q_{}, v_{};
  unsigned invalid_readings_ = 0;  ///< consecutive
  control::EnergyMeter delivered_;
};

}  // namespace tandem::client
