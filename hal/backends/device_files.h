#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/core/device.h"
#include "hal/drivers/falcon/falcon_boot.h"
#include "hal/drivers/falcon/falcon_force.h"
#include "proto/spec/device_spec.h"
#include "proto/text/presets_embedded.h"

namespace tandem::hal {

/// Loads a device file: a text file with a user's data about a device (proto/schema/device.proto). Error: every
/// mistake, with file and line.
[[nodiscard]] Result<DeviceFileSpec> load_device_file(const std::string& file);
/// Parses the text of a device file; `name` is used in messages. Error: every mistake, with its line.
[[nodiscard]] Result<DeviceFileSpec> parse_device_file(std::string_view text, std::string_view name);
/// Loads the Falcon data of a device file. Error also: the file has no Falcon data, or its readings contradict each
/// other.
[[nodiscard]] Result<FalconSpec> load_falcon_file(const std::string& file);
/// Returns the error for a valid file of another kind of device.
[[nodiscard]] DeviceError wrong_device_kind(const std::string& file, const std::string& kind);
/// Parses a preset built into the program.
[[nodiscard]] Result<DeviceFileSpec> parse_shipped_preset(const EmbeddedFile& preset);
/// Reads a firmware image. Error: why it cannot be read; check_firmware validates its content.
[[nodiscard]] Result<FalconFirmware> load_firmware(const std::string& file);

}  // namespace tandem::hal
