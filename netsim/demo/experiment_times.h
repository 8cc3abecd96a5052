#pragma once

#include "netsim/demo/run_numbers.h"
#include "netsim/plot/svg_plot.h"

namespace tandem::netsim::demo {

/// Labels of the moments of both experiments; empty: only the mark is drawn.
struct TimeLabels {
  const char* trainee_pushes = "";
  const char* trainer_pushes = "";
  const char* alpha_moves = "";
  const char* reaches_wall = "";
  const char* aligned = "";
};

/// Shows the whole session along the time axis of a panel and marks the moments of its experiment.
/// @param duration  length of the session [s]
void mark_times(plot::Panel& panel, Task task, double duration, const TimeLabels& labels);

}  // namespace tandem::netsim::demo
