#pragma once

#include <vector>

#include "netsim/tradeoff/tool_task.h"

namespace tandem::netsim::tradeoff {

/// How the reference sees the hand.
enum class HandInput {
  kContinuous,  ///< as it moves: the truth
  kHeld,        ///< within a tick as at its end, as a session's tool does: differs by the integrator's error only
};

/// Number of reference steps per tick, at least; and per second, at least.
inline constexpr double kReferencePerTick = 64, kReferencePerSecond = 200'000;

/// Returns the samples of the task at every tick, from the first on. The reference is code of its own: classical
/// Runge-Kutta in long double with at least 64 steps per tick; one-sided surfaces are evaluated in every stage.
[[nodiscard]] std::vector<ToolSample> reference(const ToolTask& task, double tick_hz, HandInput input);

}  // namespace tandem::netsim::tradeoff
