#pragma once

#include <array>

#include "hal/sim/touch_kinematics.h"

/// Masses, inertia and mechanical stops of the simulated Touch.
namespace tandem::hal::sim::touch {

inline constexpr double kG = 9.81;                   // [m/s^2]
inline constexpr double kM2 = 0.04, kM3 = 0.08;      // [kg]
inline constexpr double kR2 = 0.0443, kR3 = 0.1108;  // centres of mass [m]
inline constexpr double kI = 2e-4;                   // I1 = I2 = I3 [kg m^2], assumed
inline constexpr double kL1 = kTouchL1, kL2 = kTouchL2;
inline constexpr double kM22 = kI + kM2 * kR2 * kR2 + kM3 * kL1 * kL1;
inline constexpr double kM33 = kI + kM3 * kR3 * kR3;
inline constexpr double kM23 = kM3 * kL1 * kR3;
inline constexpr double kG2 = (kM2 * kR2 + kM3 * kL1) * kG;
inline constexpr double kG3 = kM3 * kR3 * kG;

// Mechanical stops (assumed: somewhat outside the reachable part of the vendor's workspace).
// A stop is a stiff implicit spring and damper. Beyond kStopSoft the joint is held, so that q is bounded under every
// force.
inline constexpr std::array<double, 3> kStopLow{-1.1, -0.4, -0.9};
inline constexpr std::array<double, 3> kStopHigh{1.1, 1.8, 1.6};
inline constexpr double kStopElbow = 1.45;  // limit of |q3 - q2|: the arm is neither fully stretched nor folded
inline constexpr double kStopK = 20.0, kStopB = 0.05, kStopSoft = 0.6;

}  // namespace tandem::hal::sim::touch
