#include "hal/sim/sim_calibration.h"

#include <chrono>
#include <cmath>
#include <numbers>

#include "hal/core/load_calibration.h"
#include "hal/core/port_map.h"

namespace tandem::hal::sim {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(1);
constexpr double kSettle = 1;                           // time until the weight is held and samples count [s]
constexpr double kStiffness = 300, kDamping = 2;        // of the spring that moves the tip [N/m], [N s/m]
constexpr double kIntegral = 600;                       // of the distance: the spring then carries no weight [N/(m s)]
constexpr std::array<double, 3> kTurns{1.0, 0.8, 1.3};  // frequencies of the axes, relative

}  // namespace

Result<DeviceLoad> calibrate_load(const SimSetup& setup, const SlowMotion& motion) {
  SimSetup alone = setup;
  alone.hand = {};
  alone.motion = nullptr;
  alone.environment = {};
  alone.device.calibrate = alone.device.gravity_compensation = alone.device.friction_feedforward = false;
  auto made = SimDevice::make(alone);
  if (!made) return std::unexpected(made.error());
  SimDevice& device = **made;
  const std::size_t joints = device.caps().joints;
  const PortMap map(PortSpace::kTip, device.caps().tip_axes, joints);
  const Vec3 start = device.state().x;
  const double dt = seconds(kTick), peak = setup.device.force_peak;
  LoadCalibration calibration(joints);
  Vec3 held = Vec3::Zero();
  Command command{.kind = CommandKind::kJointEffort};
  for (double t = 0; t < kSettle + motion.length; t += dt) {
    const State& s = device.state();
    AxisArray force{};
    for (std::size_t a = 0; a < device.caps().tip_axes; ++a) {
      const auto e = static_cast<Eigen::Index>(a);
      const double w = 2 * std::numbers::pi * motion.frequency * kTurns[a], swing = std::min(1.0, t / kSettle);
      const double gap = start[e] + swing * motion.amplitude * std::sin(w * t) - s.x[e];
      held[e] = std::clamp(held[e] + kIntegral * gap * dt, -peak, peak);
      force[a] = kStiffness * gap + kDamping * (swing * motion.amplitude * w * std::cos(w * t) - s.dx[e]) + held[e];
    }
    command.seq += 1;
    command.expires = s.sampled_at + 10 * kTick;
    command.effort = map.joint_effort(s, force);
    device.advance(command, kTick);
    if (t > kSettle) calibration.add(device.state());
  }
  auto load = calibration.result();
  if (load) return *load;
  return std::unexpected(DeviceError{
      Errc::kLimit, "simulated device: calibration of its weight failed: " + load.error() +
                        "; a force_peak_n above weight, load and friction together lets the motors move it"});
}

}  // namespace tandem::hal::sim
