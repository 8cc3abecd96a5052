#pragma once

#include <optional>

#include "client/seat/motion_scale.h"
#include "hal/core/device.h"
#include "proto/text/seat_setup.h"

namespace tandem::client {

/// Force separation: the part of a seat's force that its device exerts by its own weight and friction, and not its
/// hand. The spring between device and tool carries all three; others feel only what is left after this part is taken
/// out.
///
///     F_device = -J^-T (tau_g + 0.8 tau_f)        the part that motors do not balance
///
/// Weight is conservative. Four fifths of an estimate that errs by at most a fifth are at most the friction itself, so
/// what is taken out is never more than the device dissipates. Own hand and own motors are not affected.
class ForceSeparation {
 public:
  /// Share of the friction that is taken out.
  static constexpr double kFrictionShare = 0.8;

  /// @throws std::runtime_error if the scene requests it for a device whose weight and friction are not calibrated
  ForceSeparation(const SeatSetup& setup, const hal::DeviceCaps& caps);

  [[nodiscard]] bool on() const noexcept { return load_.has_value(); }
  /// Updates the estimate from a reading. @pre on()
  void update(const hal::State& reading, const MotionScale& scale) noexcept TANDEM_REALTIME;
  /// The part as the tool sees it [N], port TIP; 0 while off.
  [[nodiscard]] const AxisArray& force() const noexcept { return force_; }

 private:
  std::optional<hal::DeviceLoad> load_;
  std::size_t joints_ = 0, dof_ = 0;
  AxisArray force_{};
};

}  // namespace tandem::client
