#pragma once

#include "netsim/system/simulation.h"
#include "server/report/report.h"

namespace tandem::netsim {

/// Returns the link statistics of every seat in both directions, as both ends counted them.
[[nodiscard]] std::vector<server::LinkReport> link_reports(const Simulation& simulation);

/// Returns the report of a finished simulation. The caller sets `trace_hash` and `cpu_s`.
[[nodiscard]] server::RunReport simulation_report(const Simulation& simulation, const server::ReportBuilder& builder,
                                                  std::uint64_t seed);

}  // namespace tandem::netsim
