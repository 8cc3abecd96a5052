#include "netsim/demo/app/joint_torques.h"

#include "hal/sim/touch_kinematics.h"

namespace tandem::netsim::demo {
namespace {

void fill(const Column3& q, const Column3& force, Column3& torque) {
  const std::size_t rows = q[0].size();
  for (Column& c : torque) c.resize(rows);
  for (std::size_t k = 0; k < rows; ++k) {
    const hal::sim::TouchPose pose(hal::Vec3{q[0][k], q[1][k], q[2][k]});
    const hal::Vec3 effort = pose.joint_effort(hal::Vec3{force[0][k], force[1][k], force[2][k]});
    for (std::size_t j = 0; j < 3; ++j) torque[j][k] = effort[static_cast<Eigen::Index>(j)];
  }
}

}  // namespace

void add_joint_torques(TraceData& trace) {
  fill(trace.trainer.q, trace.trainer.f_cmd, trace.trainer.torque);
  fill(trace.trainee.q, trace.trainee.f_cmd, trace.trainee.torque);
  fill(trace.tool.q, trace.tool.f_cmd, trace.tool.torque);
}

}  // namespace tandem::netsim::demo
