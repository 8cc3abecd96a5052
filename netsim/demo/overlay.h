#pragma once

#include <span>
#include <string>
#include <vector>

#include "netsim/demo/captioned_figure.h"
#include "netsim/demo/run_numbers.h"
#include "netsim/demo/trace_data.h"

/// Curves of the three settings in one drawing: the paper's gains, Tandem's defaults, the bad network. Pure functions.
namespace tandem::netsim::demo {

/// Returns the reduced curves of one run, one for each panel of its task's overlay.
[[nodiscard]] OverlaySeries overlay_series(const RunPlan& plan, const TraceData& trace);

/// Returns one figure for each task that has a run; missing runs have no curves. The last panels show the delay of each
/// datagram on the bad network and mark each lost datagram along the lower edge.
[[nodiscard]] std::vector<CaptionedFigure> overlay_figures(std::span<const RunResult> runs);

}  // namespace tandem::netsim::demo
