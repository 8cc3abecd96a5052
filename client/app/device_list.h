#pragma once

#include <string>

#include "hal/io/backend.h"

namespace tandem::client {

/// What a person wants to know of a device that is attached, before it is opened: how it is named, and a line each for library,
/// permission, firmware, rate, calibration, homing and gravity.
[[nodiscard]] std::string describe(const hal::Backend& backend, const hal::FoundDevice& device);

/// One fact as such a line, with its line feed.
[[nodiscard]] std::string fact_line(const hal::DeviceFact& fact);

}  // namespace tandem::client
