#pragma once

#include <string>

#include "client/diagnostics/device_diagnostics.h"
#include "hal/backends/backend.h"

namespace tandem::client {

/// Returns a description of an attached device before it is opened: its name, and one line each for library,
/// permission, firmware, rate, calibration, homing and gravity.
[[nodiscard]] std::string describe(const hal::Backend& backend, const hal::FoundDevice& device);

/// Returns one fact as such a line, with line feed.
[[nodiscard]] std::string fact_line(const hal::DeviceFact& fact);

/// Returns a finding about a device as one line with its mark, with line feed.
[[nodiscard]] std::string finding_line(const DeviceDiagnostics::Finding& finding);

}  // namespace tandem::client
