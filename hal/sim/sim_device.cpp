#include "hal/sim/sim_device.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "hal/core/device_load.h"
#include "hal/core/port_map.h"
#include "hal/sim/integrated_plant.h"
#include "hal/sim/sim_calibration.h"

namespace tandem::hal::sim {
namespace {

/// Largest joint position of such a device [rad] or [m].
constexpr double kJointMax = 100;
/// Cut-off of the velocity estimate. One encoder count per tick (0.4 rad/s) must not cause visible ripple in derived
/// forces.
constexpr double kVelocityCutoff = 40.0;  // [Hz]
/// Below this the estimate is set to zero: an endless decay would end in denormal numbers, which slow down all
/// arithmetic.
constexpr double kRateMin = 1e-12;  // [rad/s]
/// Friction feed-forward: share of the friction, and the tip speed over which its sign is smoothed.
/// The speed is above the ripple of the estimated velocity. The share below 1 keeps friction and feed-forward together
/// dissipative.
constexpr double kFeedforwardShare = 0.9;
/// The same for measured friction: with an estimate that errs by a fifth, at most the friction itself.
constexpr double kMeasuredShare = 0.8;
constexpr double kFeedforwardSpeed = 0.015;  // [m/s]
constexpr double kLinearEncoder = 5.5e-5;    // [m]
constexpr double kTouchResolution = 5.5e-5;  // [m] at the tip, datasheet
constexpr double kTouchStiffness = 400.0;    // [N/m]
constexpr Duration kPeriodMax = std::chrono::seconds(1);

/// Plants of rarely used kinds are held by pointer.
template <class Held>
auto& body(Held& held) noexcept {
  if constexpr (requires { *held; }) {
    return *held;
  } else {
    return held;
  }
}

DeviceError limit(std::string message) { return {Errc::kLimit, std::move(message)}; }

Result<> check_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return std::unexpected(limit(std::string("simulated device: ") + name + " = " + std::to_string(value) + ", allowed " +
                               std::to_string(low) + " to " + std::to_string(high)));
}

Result<> check(const SimSetup& s) {
  const auto& d = s.device;
  const auto& h = s.hand;
  const struct {
    const char* name;
    double value, low, high;
  } ranges[] = {
      {"friction [N]", d.friction, 0.0, 1e6},
      {"damping [N s/m]", d.damping, 0.0, 1e6},
      {"force_peak [N]", d.force_peak, 0.0, 1e3},
      {"encoder [rad or m]", d.encoder, 0.0, 0.1},
      {"mass [kg]", d.model == DeviceModel::kLinear ? d.mass : 0.1, 1e-4, 1e4},
      {"load [kg]", d.load, 0.0, 1e3},
      {"start.x [m]", d.start.x, -1.0, 1.0},
      {"start.y [m]", d.start.y, -1.0, 1.0},
      {"start.z [m]", d.start.z, -1.0, 1.0},
      {"hand.k [N/m]", h.k, 0.0, 1e9},
      {"hand.b [N s/m]", h.b, 0.0, 1e6},
      {"hand.m [kg]", h.m, 0.0, 1e3},
  };
  for (const auto& r : ranges) {
    if (auto ok = check_range(r.name, r.value, r.low, r.high); !ok) return ok;
  }
  if (h.model == HandModel::kRecorded && !s.motion) {
    return std::unexpected(DeviceError{Errc::kNotFound, "a RECORDED hand needs a recording (motion=FILE.csv)"});
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<SimDevice>> SimDevice::make(const SimSetup& setup) {
  if (auto ok = check(setup); !ok) return std::unexpected(ok.error());
  auto device = make_uncalibrated(setup);
  if (!device || !setup.device.calibrate) return device;
  const auto load = calibrate_load(setup);
  if (!load) return std::unexpected(load.error());
  (*device)->set_load(*load);
  return device;
}

Result<std::unique_ptr<SimDevice>> SimDevice::make_uncalibrated(const SimSetup& setup) {
  Vec3 start = to_vec3(setup.device.start);
  if (setup.joints) {  // a reading of such a device may be a count beyond a stop; stops are soft, so it is accepted
    for (std::size_t i = 0; i < 3; ++i)
      if (!(std::abs((*setup.joints)[i]) <= kJointMax))
        return std::unexpected(limit("simulated device: no device of this kind has such joints"));
    const Vec3 q{(*setup.joints)[0], (*setup.joints)[1], (*setup.joints)[2]};
    if (setup.device.model == DeviceModel::kLinear) {
      start[0] = q[0];
    } else {
      return std::unique_ptr<SimDevice>(new SimDevice(setup, touch_plant(setup, q), start));
    }
  }
  if (setup.device.model == DeviceModel::kLinear) {
    return std::unique_ptr<SimDevice>(new SimDevice(setup, linear_plant(setup, start), start));
  }
  const auto q0 = touch_inverse(start);
  if (!q0 || !TouchPlant::within_stops(*q0)) {
    return std::unexpected(limit("simulated Touch: start (" + std::to_string(start[0]) + ", " +
                                 std::to_string(start[1]) + ", " + std::to_string(start[2]) +
                                 ") m is out of reach; stay within 60 mm of the origin"));
  }
  return std::unique_ptr<SimDevice>(new SimDevice(setup, touch_plant(setup, *q0), start));
}

SimDevice::Plant SimDevice::touch_plant(const SimSetup& setup, const Vec3& q0) {
  if (const auto& numerics = setup.device.numerics)
    return std::make_unique<IntegratedPlant<TouchDynamics>>(TouchDynamics(setup.device, setup.environment), *numerics,
                                                            q0);
  return TouchPlant(setup.device, setup.environment, q0);
}

SimDevice::Plant SimDevice::linear_plant(const SimSetup& setup, const Vec3& start) {
  if (const auto& numerics = setup.device.numerics)
    return std::make_unique<IntegratedPlant<LinearDynamics>>(LinearDynamics(setup.device, setup.environment, start),
                                                             *numerics, LinearDynamics::Q(start[0]));
  return LinearPlant(setup.device, setup.environment, start);
}

SimDevice::~SimDevice() = default;

SimDevice::SimDevice(const SimSetup& setup, Plant plant, const Vec3& start)
    : spec_(setup.device), plant_(std::move(plant)), hand_(setup.hand, start, setup.motion) {
  // If the scene does not set the encoder step, its default is in radians; a one-axis device has its own, in metres.
  if (spec_.model == DeviceModel::kLinear && spec_.encoder == SimDeviceSpec{}.encoder) spec_.encoder = kLinearEncoder;
  make_caps();
  state_.sampled_at = setup.start;
  read_truth();
  measure(0.0);
}

void SimDevice::set_load(const DeviceLoad& load) noexcept {
  load_ = caps_.load = load;
  if (caps_.gravity != GravityCompensation::kNone) caps_.load->weight = {};
  for (double& friction : caps_.load->friction)
    if (spec_.friction_feedforward) friction *= 1 - kMeasuredShare;
}

void SimDevice::make_caps() {
  const bool touch = spec_.model == DeviceModel::kTouch;
  caps_.joints = touch ? TouchPlant::kJoints : LinearPlant::kJoints;
  caps_.tip_axes = caps_.joints;
  caps_.prismatic = !touch;
  caps_.simulated = true;
  caps_.timing = Timing::kFreeRunning;
  caps_.gravity =
      touch && spec_.gravity && spec_.gravity_compensation ? GravityCompensation::kHost : GravityCompensation::kNone;
  caps_.damping = spec_.damping;
  caps_.latency = 0;  // a command acts from the instant of the reading on
  if (touch) {
    // Mean over the directions: a push of 1 N moves the tip by the mean of diag(J M^-1 J^T).
    if (const auto q = touch_inverse(Vec3::Zero())) {
      const TouchPose pose(*q);
      const Eigen::Matrix3d j = pose.jacobian();
      caps_.mass = 3.0 / (j * TouchPlant::inertia(pose).inverse() * j.transpose()).trace();
    }
    caps_.stiffness = kTouchStiffness;
  } else {
    caps_.mass = spec_.mass;
  }
  for (std::size_t i = 0; i < caps_.tip_axes; ++i) {
    auto& axis = caps_.axis[i];
    axis.peak = axis.continuous = spec_.force_peak;
    if (spec_.encoder > 0.0)
      axis.resolution = touch ? kTouchResolution * spec_.encoder / SimDeviceSpec{}.encoder : spec_.encoder;
    axis.from = Provenance::kModel;
  }
}

void SimDevice::read_truth() noexcept {
  std::visit(
      [this](const auto& held) {
        const auto& plant = body(held);
        const Vec3 &q = plant.q(), &dq = plant.dq();
        for (std::size_t i = 0; i < caps_.joints; ++i) {
          ground_truth_.q[i] = q[static_cast<int>(i)];
          ground_truth_.dq[i] = dq[static_cast<int>(i)];
        }
        ground_truth_.x = plant.tip();
        ground_truth_.dx = plant.tip_velocity();
        ground_truth_.penetration = plant.penetration();
      },
      plant_);
}

void SimDevice::measure(double dt) noexcept {
  if (dt != filter_dt_) {
    filter_dt_ = dt;
    filter_ = 1.0 - std::exp(-2.0 * std::numbers::pi * kVelocityCutoff * dt);
  }
  for (std::size_t i = 0; i < caps_.joints; ++i) {
    if (spec_.encoder > 0.0) {
      const double q = spec_.encoder * std::round(ground_truth_.q[i] / spec_.encoder);
      if (dt > 0.0) state_.dq[i] += filter_ * ((q - state_.q[i]) / dt - state_.dq[i]);
      if (std::abs(state_.dq[i]) < kRateMin) state_.dq[i] = 0.0;
      state_.q[i] = q;
    } else {
      state_.q[i] = ground_truth_.q[i];
      state_.dq[i] = ground_truth_.dq[i];
    }
  }
  derive_pose();
}

void SimDevice::derive_pose() noexcept {
  if (caps_.prismatic) {
    state_.x = ground_truth_.x;
    state_.x[0] = state_.q[0];
    state_.dx[0] = state_.dq[0];
    state_.J(0, 0) = 1.0;
    return;
  }
  pose_ = TouchPose({state_.q[0], state_.q[1], state_.q[2]});
  state_.x = pose_.tip();
  state_.dx = pose_.tip_velocity({state_.dq[0], state_.dq[1], state_.dq[2]});
  state_.J.leftCols<3>() = pose_.jacobian();
}

SimDevice::Effort SimDevice::limited_effort(const Command& command) noexcept {
  state_.saturated = false;
  Effort out;
  if (command.kind == CommandKind::kNone) return out;
  bool any = false;
  for (std::size_t i = 0; i < caps_.joints; ++i) {
    const double tau = command.effort[i];
    if (!std::isfinite(tau)) {
      ++counts_.rejected;
      return {};
    }
    // Larger numbers exceed every motor. Limiting them first keeps their squares finite.
    constexpr double kBeyond = 1e6;
    out.tau[i] = std::clamp(tau, -kBeyond, kBeyond);
    any = any || tau != 0.0;
  }
  if (!any) return out;
  out.force = solve_tip_force(state_.J, out.tau, caps_.joints);
  const double force = out.force.norm();
  if (force > spec_.force_peak) {
    const double share = spec_.force_peak / force;
    for (double& tau : out.tau) tau *= share;
    out.force *= share;
    state_.saturated = true;
    ++counts_.saturated;
  }
  return out;
}

Vec3 SimDevice::compensation() const noexcept {
  Vec3 tau = Vec3::Zero();
  const bool touch = !caps_.prismatic;
  if (touch && spec_.gravity && spec_.gravity_compensation) {
    tau = TouchPlant::gravity(pose_);
    if (load_) {
      const AxisArray measured = weight_effort(*load_, state_, caps_.joints);
      tau = Vec3(measured[0], measured[1], measured[2]);
    }
  }
  if (spec_.friction_feedforward && load_) {
    const AxisArray measured = friction_effort(*load_, state_, caps_.joints);
    return tau + kMeasuredShare * Vec3(measured[0], measured[1], measured[2]);
  }
  if (spec_.friction_feedforward && spec_.friction > 0.0) {
    const Vec3 lever = touch ? TouchPlant::working_levers() : Vec3(1.0, 0.0, 0.0);
    for (std::size_t i = 0; i < caps_.joints; ++i) {
      const double l = lever[static_cast<int>(i)];
      const double v = l * state_.dq[i];
      tau[static_cast<int>(i)] +=
          kFeedforwardShare * spec_.friction * l * v / std::sqrt(v * v + kFeedforwardSpeed * kFeedforwardSpeed);
    }
  }
  return tau;
}

void SimDevice::move(const Vec3& tau, HandPull pull, double middle, double length, double period) noexcept {
  if (!(length > 0.0)) return;
  pull.x += (middle - 0.5 * period) * pull.v;
  std::visit(
      [&](auto& held) {
        auto& plant = body(held);
        plant.advance(tau, pull, length);
        ground_truth_.f_environment += length / period * plant.environment_force();
        ground_truth_.f_hand += length / period * plant.hand_force();
      },
      plant_);
}

void SimDevice::advance(const Command& command, Duration dt) noexcept {
  dt = std::min(dt, kPeriodMax);
  if (dt <= Duration::zero()) return;
  const double period = seconds(dt);

  const Effort effort = limited_effort(command);
  Duration alive = dt;
  if (command.kind != CommandKind::kNone && command.expires < state_.sampled_at + dt) {
    alive = command.expires > state_.sampled_at ? command.expires - state_.sampled_at : Duration::zero();
    ++counts_.expired;
  }
  state_.echo_command = alive > Duration::zero() ? command.seq : 0;

  const Vec3 host = compensation();
  HandPull pull = hand_.advance(ground_truth_.x, period);
  if (push_left_ > 0) {
    pull.force += push_;
    push_left_ -= period;
  }
  const double acting = seconds(alive);
  ground_truth_.f_environment.setZero();
  ground_truth_.f_hand.setZero();
  move(host + Vec3(effort.tau[0], effort.tau[1], effort.tau[2]), pull, 0.5 * acting, acting, period);
  move(host, pull, 0.5 * (acting + period), period - acting, period);

  const double share = acting / period;
  for (std::size_t i = 0; i < caps_.joints; ++i) state_.tau_out[i] = share * effort.tau[i];
  state_.f_out = share * effort.force;
  read_truth();
  state_.f_env = ground_truth_.f_environment;
  state_.penetration = ground_truth_.penetration;
  measure(period);
  state_.sampled_at += dt;
  ++state_.seq;
  ++counts_.ticks;
  state_.buttons = buttons_.load(std::memory_order_relaxed);
}

}  // namespace tandem::hal::sim
