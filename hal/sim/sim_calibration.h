#pragma once

#include "hal/sim/sim_device.h"

namespace tandem::hal::sim {

/// A slow motion of the tip around its start: one sine per axis, with frequencies of 1, 0.8 and 1.3 times `frequency`.
struct SlowMotion {
  double amplitude = 0.025;  ///< of each axis [m]
  double frequency = 0.25;   ///< [Hz]
  double length = 10;        ///< [s]
};

/// Measures weight and friction of a simulated device as a host measures a real one: no hand holds it, its own motors
/// move it slowly, without any compensation, and their effort is known. The model's numbers are not read.
/// @param setup  the device at its start; hand and surfaces do not act during the calibration
/// Error: the device cannot be made, or does not move enough, in words.
[[nodiscard]] Result<DeviceLoad> calibrate_load(const SimSetup& setup, const SlowMotion& motion = {});

}  // namespace tandem::hal::sim
