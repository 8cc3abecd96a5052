#pragma once

#include "common/control/numerics.h"
#include "netsim/tradeoff/tool_task.h"

namespace tandem::netsim::tradeoff {

/// Largest stiffness that is tried [N/m].
inline constexpr double kStiffnessMost = 1e9;

/// Returns the largest stiffness of a spring to the ground, beside the hand's spring and damper, with which the tool's
/// steps do not grow [N/m]; kStiffnessMost if none was found, 0 if the steps grow without such a spring. Found by
/// bisection with a session's code, within 1 %.
[[nodiscard]] double stable_stiffness(const ToolTask& task, double tick_hz, const control::Numerics& numerics);

}  // namespace tandem::netsim::tradeoff
