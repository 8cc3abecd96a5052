#pragma once

#include "hal/core/device.h"

namespace tandem::client {

/// Adapts a device that reports velocity instead of position (rate control). The adapter integrates the velocity [m/s]
/// to a point within a box [m], and the seat receives that point as the tip position. The box is the device's
/// workspace, or 0.1 m to each side if the device declares none. Such a device has no motors.
class RateControlAdapter {
 public:
  /// @param caps  capabilities of the device itself
  explicit RateControlAdapter(const hal::DeviceCaps& caps) noexcept;

  /// Returns the capabilities that the seat sees: three prismatic joints, position input, no force.
  [[nodiscard]] static hal::DeviceCaps adapted_caps(const hal::DeviceCaps& device);

  /// Returns the reading that the seat sees after the device's reading `state`.
  [[nodiscard]] hal::State integrate(const hal::State& state) noexcept TANDEM_REALTIME;

 private:
  hal::Vec3 low_, high_;
  hal::Vec3 x_ = hal::Vec3::Zero();
  Time before_{};
  bool begun_ = false;
};

}  // namespace tandem::client
