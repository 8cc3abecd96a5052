#pragma once

#include <expected>
#include <string>

#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Reads the JSON report of `tandem-server run` or `tandem-netsim run` (server/report.h), with the seats trainer and
/// trainee. null and absent numbers become NaN; keys the demo does not know are passed over.
/// @return the numbers, or why the text is no such report
[[nodiscard]] std::expected<ReportNumbers, std::string> read_report(const std::string& json);

/// Late ticks in the report of `tandem-client join --json`; 0 if it does not say.
[[nodiscard]] double read_late_ticks(const std::string& json);

}  // namespace tandem::netsim::demo
