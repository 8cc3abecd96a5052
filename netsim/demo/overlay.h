#pragma once

#include <span>
#include <string>
#include <vector>

#include "netsim/demo/captioned_figure.h"
#include "netsim/demo/run_numbers.h"
#include "netsim/demo/trace_data.h"

/// Curves of the three settings laid over each other: the paper's gains, Tandem's defaults, the bad network. Pure.
namespace tandem::netsim::demo {

/// The curves of one run, thinned, one for each panel of its task's overlay.
[[nodiscard]] OverlaySeries overlay_series(const RunPlan& plan, const TraceData& trace);

/// One figure for each task that has a run. Runs that were not made leave their curves out. The last panels show the
/// delay of each datagram on the bad network and, as marks along the lower edge, each lost one.
[[nodiscard]] std::vector<CaptionedFigure> overlay_figures(std::span<const RunResult> runs);

}  // namespace tandem::netsim::demo
