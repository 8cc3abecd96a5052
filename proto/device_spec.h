#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/spacemouse_spec.h"
#include "proto/woodenhaptics_spec.h"

/// What people's files say about their own devices, after validation: every number is finite and in range. Made by
/// proto/device_text.h only. Absent numbers are not known.
namespace tandem {

/// A known mass on the grip of a Falcon, held still at the same pose without and with it.
struct FalconMassReading {
  double mass = 0;                              ///< [kg]
  std::array<double, 3> up{};                   ///< against gravity, HAL frame, length 1
  std::array<double, 3> encoder{};              ///< counts, homed
  std::array<double, 3> motor_without{};        ///< counts, mean
  std::array<double, 3> motor_with{};           ///< counts, mean
  int line = 0;                                 ///< of its file, from 1; 0: of no file
};

struct FalconFlags {
  std::uint8_t homing = 0x01, green = 0x02, blue = 0x04, red = 0x08;
};

struct FalconSpec {
  std::optional<std::array<double, 3>> counts_per_nm;  ///< per motor; or `readings`, or neither: not calibrated
  std::vector<FalconMassReading> readings;
  std::string measured;                                ///< by whom, when, how; never empty if there are numbers above
  std::optional<double> peak, continuous;              ///< [N] at the tip
  std::optional<double> mass, damping, stiffness;      ///< [kg, N s/m, N/m] at the tip
  double latency = 0.001;                              ///< of force after reading [s]: forces travel with the next exchange
  std::optional<std::string> firmware_sha256;          ///< lower-case hex
  FalconFlags flags;
  int line = 0;                                        ///< of its file, from 1; 0: of no file
};

/// One file: what it says of each kind of device.
struct DeviceFileSpec {
  std::optional<FalconSpec> falcon;
  std::optional<WoodenHapticsSpec> woodenhaptics;
  std::optional<SpaceMouseSpec> spacemouse;
};

}  // namespace tandem
