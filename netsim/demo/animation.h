#pragma once

#include <span>
#include <string>

#include "netsim/demo/run_numbers.h"
#include "netsim/demo/trace_data.h"

/// The hands, the slave and the wall in motion, with a slider over session time: a canvas and a script inside the page.
namespace tandem::netsim::demo {

/// Frames of a run at MotionFrames::kRate. A value that is unknown repeats the one before.
[[nodiscard]] MotionFrames motion_frames(const TraceData& trace);

/// The section of the page. Without script the page says so and shows the rest.
[[nodiscard]] std::string animation_html(std::span<const RunResult> runs);

}  // namespace tandem::netsim::demo
