#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/spec/spacemouse_spec.h"
#include "proto/spec/woodenhaptics_spec.h"

/// Contents of a user's device file after validation: every number is finite and in range. Only
/// proto/text/device_text.h creates them. Absent numbers are not known.
namespace tandem {

/// One reading of a Falcon with a known mass on the grip, held still at the same pose without and with the mass.
struct FalconMassReading {
  double mass = 0;                        ///< [kg]
  std::array<double, 3> up{};             ///< upward direction (against gravity), HAL frame, length 1
  std::array<double, 3> encoder{};        ///< counts, homed
  std::array<double, 3> motor_without{};  ///< counts, mean
  std::array<double, 3> motor_with{};     ///< counts, mean
  int line = 0;                           ///< line in the file, from 1; 0: not from a file
};

struct FalconFlags {
  std::uint8_t homing = 0x01, green = 0x02, blue = 0x04, red = 0x08;
};

struct FalconSpec {
  std::optional<std::array<double, 3>> counts_per_nm;  ///< per motor; neither this nor `readings`: not calibrated
  std::vector<FalconMassReading> readings;
  std::string measured;                    ///< measured by, date, method; never empty if one of the above is given
  std::optional<double> peak, continuous;  ///< [N] at the tip
  std::optional<double> mass, damping, stiffness;  ///< [kg, N s/m, N/m] at the tip
  double latency = 0.001;  ///< delay of the force after the reading [s]: forces travel with the next exchange
  std::optional<std::string> firmware_sha256;  ///< lower-case hex
  FalconFlags flags;
  int line = 0;  ///< line in the file, from 1; 0: not from a file
};

/// One device file: the parameters of each kind of device.
struct DeviceFileSpec {
  std::optional<FalconSpec> falcon;
  std::optional<WoodenHapticsSpec> woodenhaptics;
  std::optional<SpaceMouseSpec> spacemouse;
};

}  // namespace tandem
