#pragma once

#include <span>

#include "netsim/score/interventions.h"
#include "netsim/score/metrics.h"
#include "netsim/score/parts.h"
#include "netsim/score/tracks.h"

/// Metrics of one hand in one part. Each function sets the metrics of its group that exist; the others stay NaN.
namespace tandem::netsim::score {

/// All that a part's metrics are computed from.
struct PartInput {
  const Lesson& lesson;
  const LessonGrid& grid;
  const SeatTrack& seat;
  const ToolTrack& tool;
  const Part& part;
  const ScoreOptions& options;
  std::span<const Intervention> interventions = {};  ///< at the tool
};

void score_motion(const PartInput& in, MetricValues& values);
void score_force(const PartInput& in, MetricValues& values);
void score_contact(const PartInput& in, MetricValues& values);
void score_tracking(const PartInput& in, MetricValues& values);
void score_sharing(const PartInput& in, MetricValues& values);
void score_passivity(const PartInput& in, MetricValues& values);
void score_link(const PartInput& in, MetricValues& values);

}  // namespace tandem::netsim::score
