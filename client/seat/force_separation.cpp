#include "client/seat/force_separation.h"

#include <stdexcept>

#include "hal/core/device_load.h"
#include "hal/core/port_map.h"

namespace tandem::client {

ForceSeparation::ForceSeparation(const SeatSetup& setup, const hal::DeviceCaps& caps)
    : joints_(caps.joints), dof_(setup.dof) {
  if (!setup.seat.force_separation) return;
  if (!caps.load)
    throw std::runtime_error("seat " + setup.seat.name +
                             ": force_separation needs a device whose weight and friction are calibrated, and this one "
                             "is not; use a simulated device with device { calibrate: true }, or a scene without it");
  load_ = caps.load;
}

void ForceSeparation::update(const hal::State& reading, const MotionScale& scale) noexcept {
  AxisArray tau = hal::friction_effort(*load_, reading, joints_);
  const AxisArray weight = hal::weight_effort(*load_, reading, joints_);
  for (std::size_t j = 0; j < joints_; ++j) tau[j] = -(kFrictionShare * tau[j] + weight[j]);
  const hal::Vec3 force = hal::solve_tip_force(reading.J, tau, joints_);
  for (std::size_t a = 0; a < dof_; ++a) force_[a] = force[static_cast<Eigen::Index>(a)];
  force_ = scale.effort_at_tool(force_);
}

}  // namespace tandem::client
