#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/device.h"
#include "hal/falcon/falcon_boot.h"
#include "hal/falcon/falcon_force.h"
#include "proto/device_spec.h"
#include "proto/presets_embedded.h"

namespace tandem::hal {

/// What a person knows of their devices: a text file (proto/device.proto). Error: every mistake, with file and line.
[[nodiscard]] Result<DeviceFileSpec> load_device_file(const std::string& file);
/// The same of text that was read from `name` already. Error: every mistake, with its line.
[[nodiscard]] Result<DeviceFileSpec> understand_device_file(std::string_view text, std::string_view name);
/// What such a file says of a Falcon. Error: also that it says nothing of one, or that its readings contradict each other.
[[nodiscard]] Result<FalconSpec> load_falcon_file(const std::string& file);
/// A file that reads well and is of another kind of device.
[[nodiscard]] DeviceError says_nothing_of(const std::string& file, const std::string& kind);
/// The same of a preset built into the program.
[[nodiscard]] Result<DeviceFileSpec> read_shipped(const ShippedPreset& preset);
/// A firmware image of the user's own. Error: why it cannot be read; whether it is one, check_firmware tells.
[[nodiscard]] Result<FalconFirmware> load_firmware(const std::string& file);

}  // namespace tandem::hal
