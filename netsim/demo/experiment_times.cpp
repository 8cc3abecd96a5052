#include "netsim/demo/experiment_times.h"

namespace tandem::netsim::demo {

void mark_times(plot::Panel& panel, Task task, double duration, const TimeLabels& labels) {
  panel.x = plot::Range{0, duration};
  if (task == Task::kFreeMotion) {
    panel.bands = {{7, 8.5, labels.trainee_pushes}, {14, 15.5, labels.trainer_pushes}};
    panel.verticals = {{11.5, labels.alpha_moves}};
  } else {
    panel.verticals = {{3, labels.reaches_wall}, {13, labels.aligned}};
  }
}

}  // namespace tandem::netsim::demo
