#pragma once

#include <expected>
#include <string_view>

#include "proto/spec/device_spec.h"
#include "proto/spec/input_error.h"

namespace tandem {

/// Parses a device file (proto/schema/device.proto in text format, or JSON if the name ends in `.json`).
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages
/// @return the devices, or every error found, in file order
[[nodiscard]] std::expected<DeviceFileSpec, InputErrors> parse_device_text(std::string_view text,
                                                                           std::string_view file_name);

}  // namespace tandem
