#pragma once

#include "netsim/demo/run_numbers.h"
#include "netsim/demo/trace_data.h"

/// Numbers that the report of a run does not have, taken from its trace. Pure.
namespace tandem::netsim::demo {

/// The contact experiment: wall at x = 0, pressed along +x; phases as in the scenes.
inline constexpr double kHoldFrom = 8, kHoldTo = 11.5;      ///< the leader stands [s]
inline constexpr double kContactFrom = 5, kAlignFrom = 13;  ///< forces are judged; the trainee has aligned [s]
inline constexpr double kContactEnd = 20;                   ///< [s]
inline constexpr double kAlphaMovesAt = 11.5;               ///< free motion [s]
inline constexpr double kNearPose = 0.015;                  ///< depth up to which the pose is the working pose [m]

/// Rendered stiffness near the working pose [N/m]: the least-squares K of
///   commanded force of the leader = K (x_leader - x_slave) + b v_leader + c   [N]
/// over the samples of the approach in which the slave touches (more than 0.3 N) and the leader is at most kNearPose
/// deep. The term with the speed takes out what the springs' dampers add while he moves. NaN: no such samples.
[[nodiscard]] double rendered_stiffness(const TraceData& trace);

/// Commanded force / depth of the leader while he holds: what the paper divides, 10 N / 4 cm [N/m]. NaN: no contact.
[[nodiscard]] double held_stiffness(const TraceData& trace);

/// RMS along x of (force on the hand + force commanded to the slave), or of delivered force and the environment's [N],
/// and in percent of the slave's (the environment's) peak.
struct ForceError {
  double rms_n = kUnknown, percent = kUnknown;
};
[[nodiscard]] ForceError force_error_x(const TraceData& trace, const SeatTrace& seat, double from_s, double to_s,
                                       bool commanded);

/// Largest change of a hand's commanded force from one servo tick to the next, from the moment alpha moves until 0.1 s
/// after it has arrived [N]. From the workstations' own samples where there are any: over a network the server misses
/// some.
[[nodiscard]] double force_step(const TraceData& trace);

/// All that fits the task. The seed's contact is judged on commanded force, since no Touch can deliver it.
[[nodiscard]] TraceNumbers measure(const RunPlan& plan, const TraceData& trace);

}  // namespace tandem::netsim::demo
