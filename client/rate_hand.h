#pragma once

#include "hal/device.h"

namespace tandem::client {

/// Holds a tool with a device that says how fast, not where: its commanded velocity moves a point in a box, and that point
/// is what the seat sees as the device's tip. Such a device has no motors: the effort that comes back reaches nobody.
class RateHand final : public hal::ServoClient {
 public:
  /// @param seat  served with the point; must outlive this
  /// @param caps  of the device itself
  RateHand(hal::ServoClient& seat, const hal::DeviceCaps& caps) noexcept;

  /// What the seat is told of the device: three prismatic joints, no force.
  [[nodiscard]] static hal::DeviceCaps seen_caps(const hal::DeviceCaps& device);

  hal::Command tick(const hal::State& state) noexcept TANDEM_REALTIME override;
  void lost(hal::Errc why) noexcept override { seat_->lost(why); }

 private:
  hal::ServoClient* seat_;
  hal::Vec3 low_, high_;
  hal::Vec3 x_ = hal::Vec3::Zero();
  Time before_{};
  bool begun_ = false;
};

}  // namespace tandem::client
