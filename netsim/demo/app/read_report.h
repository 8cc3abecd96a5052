#pragma once

#include <expected>
#include <string>

#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Reads the JSON report of `tandem-server run` or `tandem-netsim run` (server/report/report.h), with the seats trainer
/// and trainee. null and missing numbers become NaN; unknown keys are ignored.
/// @return the numbers, or why the text is no such report
[[nodiscard]] std::expected<ReportNumbers, std::string> read_report(const std::string& json);

/// Returns the late ticks in the report of `tandem-client join --json`; 0 if the report has no such number.
[[nodiscard]] double read_late_ticks(const std::string& json);

}  // namespace tandem::netsim::demo
