#include "hal/drivers/woodenhaptics/woodenhaptics_caps.h"

#include <algorithm>
#include <cmath>

#include "hal/drivers/woodenhaptics/board_report.h"
#include "hal/drivers/woodenhaptics/kinematics.h"
#include "hal/drivers/woodenhaptics/motors.h"

namespace tandem::hal::woodenhaptics {

DeviceCaps caps_of(const WoodenHapticsSpec& spec) {
  DeviceCaps caps;
  caps.joints = 3;
  caps.tip_axes = 3;
  caps.timing = spec.protocol == WoodenProtocol::kV1 ? Timing::kFreeRunning : Timing::kLockStep;
  caps.homing = Homing::kPresetPose;
  caps.gravity = spec.gravity ? GravityCompensation::kHost : GravityCompensation::kNone;
  caps.nominal_hz = 1000.0;
  caps.mass = spec.tip_mass;
  caps.damping = spec.damping;
  caps.latency = spec.latency;
  caps.stiffness = spec.stiffness_max;
  if (spec.protocol != WoodenProtocol::kRaw64) caps.watchdog = kBoardWatchdog;
  caps.signs_from_file = true;
  caps.force_calibrated = spec.force_checked;
  caps.workspace_min.fill(-spec.radius);
  caps.workspace_max.fill(spec.radius);
  caps.buttons = has_presets(spec.protocol) ? 2 : 0;

  const Kinematics kinematics(spec);
  const auto centre = kinematics.inverse(Vec3::Zero());
  if (!centre) return caps;
  const Eigen::Matrix3d j = kinematics.jacobian(*centre);
  const Vec3 per_effort = Motors(spec).current_per_effort();
  for (int axis = 0; axis < 3; ++axis) {
    double per_newton = 0.0;  // current of the motor that reaches its limit first
    for (int motor = 0; motor < 3; ++motor) {
      per_newton = std::max(per_newton, std::abs(per_effort[motor] * j(axis, motor)));
    }
    AxisLimit& limit = caps.axis[static_cast<std::size_t>(axis)];
    limit.peak = std::min(spec.force_max, spec.current_max / per_newton);
    limit.continuous = std::min(*limit.peak, spec.current_continuous / per_newton);
    limit.resolution = j.row(axis).transpose().cwiseProduct(kinematics.angle_per_count()).norm();
    limit.from = Provenance::kConfig;
  }
  return caps;
}

}  // namespace tandem::hal::woodenhaptics
