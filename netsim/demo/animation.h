#pragma once

#include <span>
#include <string>

#include "netsim/demo/run_numbers.h"
#include "netsim/demo/trace_data.h"

/// Animation of the hands, the slave and the wall, with a slider over session time: a canvas and a script in the page.
namespace tandem::netsim::demo {

/// Returns the frames of a run at MotionFrames::kRate. An unknown value repeats the previous one.
[[nodiscard]] MotionFrames motion_frames(const TraceData& trace);

/// Returns the section of the page. If scripts are disabled, it shows a message; the rest of the page is unaffected.
[[nodiscard]] std::string animation_html(std::span<const RunResult> runs);

}  // namespace tandem::netsim::demo
