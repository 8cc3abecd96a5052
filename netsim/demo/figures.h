#pragma once

#include <string>
#include <vector>

#include "netsim/demo/captioned_figure.h"
#include "netsim/demo/run_numbers.h"
#include "netsim/demo/trace_data.h"

/// The paper's figures 6 to 12, drawn from a trace. Pure functions.
namespace tandem::netsim::demo {

/// Returns the figures of a run.
/// Free motion: 6 path, 7 joint angles, 8 exchanged torques and alpha, 9 energy of the flow sources.
/// Contact: 10 path, 11 position and force along x, 12 energy of the flow sources.
[[nodiscard]] std::vector<CaptionedFigure> figures_of(const RunPlan& plan, const TraceData& trace);

/// Returns them as HTML: <figure> elements whose anchors begin with the run's name.
[[nodiscard]] std::string figures_html(const RunPlan& plan, const TraceData& trace);

}  // namespace tandem::netsim::demo
