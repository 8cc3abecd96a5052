#pragma once

#include "netsim/demo/run_numbers.h"
#include "netsim/demo/trace_data.h"

/// Measures numbers from a run's trace that the run's report does not contain. Pure functions.
namespace tandem::netsim::demo {

/// Contact experiment: the wall is at x = 0, pressed along +x; phases as in the scenes.
inline constexpr double kHoldFrom = 8, kHoldTo = 11.5;      ///< the leader holds still [s]
inline constexpr double kContactFrom = 5, kAlignFrom = 13;  ///< start of forces; trainee has aligned [s]
inline constexpr double kContactEnd = 20;                   ///< [s]
inline constexpr double kAlphaMovesAt = 11.5;               ///< in free motion [s]
inline constexpr double kNearPose = 0.015;                  ///< depth up to which the pose is the working pose [m]

/// Returns the rendered stiffness near the working pose [N/m]: the least-squares K of
///   commanded force of the leader = K (x_leader - x_slave) + b v_leader + c   [N]
/// over the samples of the approach with contact of the slave (more than 0.3 N) and a leader at most kNearPose deep.
/// The term with the speed removes the force of the springs' dampers during motion. NaN if there are no such samples.
[[nodiscard]] double rendered_stiffness(const TraceData& trace);

/// Returns commanded force / depth of the leader while the leader holds [N/m]. It is the quotient of the paper, 10 N /
/// 4 cm. NaN if there is no contact.
[[nodiscard]] double held_stiffness(const TraceData& trace);

/// Force error along x [N], RMS: force on the hand plus force commanded to the slave, or delivered force minus force of
/// the environment. `percent` is relative to the peak of the slave's (the environment's) force.
struct ForceError {
  double rms_n = kUnknown, percent = kUnknown;
};
[[nodiscard]] ForceError force_error_x(const TraceData& trace, const SeatTrace& seat, double from_s, double to_s,
                                       bool commanded);

/// Returns the largest change of a hand's commanded force from one servo tick to the next [N]. The interval starts when
/// alpha begins to move and ends 0.1 s after alpha has arrived. It uses the clients' own samples where they exist,
/// because a server misses some samples over a network.
[[nodiscard]] double force_step(const TraceData& trace);

/// Returns all numbers of the run's task. The contact run with the paper's gains is judged on commanded force, because
/// no Touch can deliver it.
[[nodiscard]] TraceNumbers measure(const RunPlan& plan, const TraceData& trace);

}  // namespace tandem::netsim::demo
