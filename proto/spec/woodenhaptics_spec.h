#pragma once

#include <array>
#include <cstdint>
#include <optional>

/// A WoodenHaptics mechanism and its board after validation, SI units. Only proto/text/device_text.h creates it, from a
/// preset.
namespace tandem {

/// Protocol of the board: v1 sends 8-byte reports unsolicited, v2 exchanges 14-byte reports in lock-step, raw64 is v2
/// padded to 64 bytes.
enum class WoodenProtocol : std::uint8_t { kV1, kV2, kRaw64 };

/// Parameters of the mechanism. Motor A turns the base, B the shoulder, C the elbow (absolute angle: the motors of both
/// arms are mounted on the rotating base).
struct WoodenHapticsSpec {
  WoodenProtocol protocol = WoodenProtocol::kV2;
  std::array<double, 3> capstan{};                   ///< diameter of the motor's capstan [m]
  std::array<double, 3> body{};                      ///< diameter of the drum that it drives [m]
  std::array<double, 3> link{};                      ///< height of the shoulder, upper arm, forearm [m]
  std::array<double, 3> origin{};                    ///< of the workspace, in the manufacturer's base frame [m]
  std::array<double, 3> torque_constant{};           ///< of each motor [N m/A]
  double counts_per_turn = 2000;                     ///< of a motor's encoder, all edges
  std::array<std::int16_t, 3> calibration_counts{};  ///< of the motors' encoders in the calibration pose
  std::array<int, 3> encoder_direction{1, 1, 1};     ///< 1 or -1: counts grow with the angle, or fall
  std::array<int, 3> motor_direction{1, 1, 1};  ///< 1 or -1: positive current pushes towards larger angles, or smaller
  double firmware_full_scale = 3;               ///< current that the firmware assumes for full PWM [A]
  double amplifier_full_scale = 3;              ///< current that the amplifier produces at full PWM [A]
  double current_max = 2;                       ///< limit of each motor's real current [A]
  double current_continuous = 1;                ///< current that a motor sustains without time limit [A]
  double force_max = 5;                         ///< the manufacturer's limit at the tip [N]
  double radius = 0.1;                          ///< of the workspace about its origin [m]
  std::optional<double> stiffness_max;          ///< [N/m]
  std::optional<double> damping;                ///< physical, at the tip [N s/m]
  double latency = 0.001;            ///< delay of the force after the reading [s]: forces travel with the next exchange
  std::optional<double> tip_mass;    ///< apparent mass at the tip [kg]
  std::array<double, 2> arm_mass{};  ///< upper arm, forearm [kg]
  std::array<double, 2> arm_mass_at{};  ///< its centre of mass, from the preceding joint [m]
  bool gravity = false;                 ///< the motors compensate gravity of the arms
  bool stylus_on_encoder_d = false;     ///< the stylus button adds 10000 to encoder d
  bool force_checked = false;           ///< forces were checked against a known mass
};

}  // namespace tandem
