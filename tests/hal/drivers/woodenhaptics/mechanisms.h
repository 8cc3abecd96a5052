#pragma once

#include <array>
#include <utility>

#include "proto/spec/woodenhaptics_spec.h"

namespace tandem::test {

/// Returns the arms and motors of WoodenHaptics 2015 on a V2 board, which counts with the angles.
/// The values come from the published dimensions, independent of the shipped presets.
inline WoodenHapticsSpec wooden_2015() {
  WoodenHapticsSpec s;
  s.capstan = {0.010, 0.010, 0.010};
  s.body = {0.160, 0.120, 0.120};
  s.link = {0.080, 0.205, 0.245};
  s.origin = {0.220, 0.0, 0.080};
  s.torque_constant = {0.0259, 0.0259, 0.0259};
  s.counts_per_turn = 2000;
  s.calibration_counts = {0, 0, 6000};
  s.arm_mass = {0.170, 0.110};
  s.arm_mass_at = {0.051, 0.091};
  s.stiffness_max = 1000;
  return s;
}

inline WoodenHapticsSpec aluhaptics_v2() {
  WoodenHapticsSpec s = wooden_2015();
  s.capstan = {0.0138, 0.0098, 0.0098};
  s.body = {0.116, 0.076, 0.076};
  s.link = {0.111, 0.140, 0.111};
  s.origin = {0.140, 0.0, 0.0};
  s.calibration_counts = {0, 3878, 0};
  return s;
}

inline WoodenHapticsSpec polhem_v1() {
  WoodenHapticsSpec s = wooden_2015();
  s.body = {0.180, 0.100, 0.100};
  s.link = {0.058, 0.174, 0.133};
  s.origin = {0.140, 0.0, 0.100};
  s.torque_constant = {0.0538, 0.0538, 0.0538};
  s.calibration_counts = {0, 0, -5000};
  s.encoder_direction = s.motor_direction = {-1, -1, -1};
  s.arm_mass = {0.080, 0.080};
  s.arm_mass_at = {0.040, 0.070};
  s.stiffness_max = 800;
  return s;
}

inline std::array<WoodenHapticsSpec, 3> mechanisms() { return {wooden_2015(), aluhaptics_v2(), polhem_v1()}; }

}  // namespace tandem::test
