#pragma once

#include <expected>
#include <string_view>

#include "proto/device_spec.h"
#include "proto/input_error.h"

namespace tandem {

/// Reads what a person knows of their devices (proto/device.proto in text format, or JSON if the name ends in `.json`).
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages
/// @return the devices, or every mistake found, in file order
[[nodiscard]] std::expected<DeviceFileSpec, InputErrors> parse_device_text(std::string_view text,
                                                                           std::string_view file_name);

}  // namespace tandem
