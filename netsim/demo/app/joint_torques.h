#pragma once

#include "netsim/demo/trace_data.h"

namespace tandem::netsim::demo {

/// Fills in the torques of the paper's figure 8: T = J(q)^T f_cmd [N m] of both hands and the slave, with the
/// kinematics of the simulated Touch. Rows without a finite pose or force become NaN.
void add_joint_torques(TraceData& trace);

}  // namespace tandem::netsim::demo
