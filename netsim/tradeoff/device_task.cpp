#include "netsim/tradeoff/device_task.h"

#include <algorithm>
#include <cmath>

#include "common/setup/channel_factory.h"
#include "hal/sim/plant_step.h"

namespace tandem::netsim::tradeoff {
namespace {

using namespace hal::sim;
using hal::Vec3;
using Real = long double;

constexpr double kStepsPerTick = 64, kStepsPerSecond = 100'000;

template <class S>
Vec3 to_vec(const std::array<S, 3>& p) noexcept {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

Vec3 start_joints(const DeviceTask& task, double from) noexcept {
  Vec3 tip = to_vec(hand_at(task.path, from).x);
  if (task.device.model == DeviceModel::kLinear) return tip;
  return touch_inverse(tip).value_or(*touch_inverse(Vec3::Zero()));
}

/// Effort with which the motors balance the weight.
Vec3 balance(const DeviceTask& task, const Vec3& q) noexcept {
  const SimDeviceSpec& device = task.device;
  const bool balanced = device.model == DeviceModel::kTouch && device.gravity && device.gravity_compensation;
  return balanced ? TouchPlant::gravity(TouchPose(q)) : Vec3::Zero();
}

/// The hand over a period of `length` [s] that begins at `t` [s].
HandPull pull_at(const DeviceTask& task, Real t, Real length) noexcept {
  const HandPoint<Real> middle = hand_at(task.path, t + length / 2);
  HandPull pull;
  pull.k = task.k;
  pull.b = task.b;
  pull.x = to_vec(middle.x);
  pull.v = to_vec(middle.v);
  return pull;
}

ToolSample sample_at(const DeviceTask& task, const Vec3& q, const Vec3& dq, double t) noexcept {
  const Vec3 hand = to_vec(hand_at(task.path, t).x);
  Vec3 tip(q[0], 0, 0), velocity(dq[0], 0, 0);
  double energy = 0.5 * (task.device.mass + task.device.load) * dq[0] * dq[0];
  if (task.device.model == DeviceModel::kTouch) {
    TouchPlant meter(task.device, {}, q);
    meter.set(q, dq);
    tip = meter.tip();
    velocity = meter.tip_velocity();
    energy = meter.kinetic_energy() + meter.potential_energy();
  }
  ToolSample out;
  const auto axes = static_cast<std::size_t>(task.device.model == DeviceModel::kTouch ? 3 : 1);
  for (std::size_t a = 0; a < axes; ++a) {
    const int i = static_cast<int>(a);
    out.x[a] = tip[i];
    out.v[a] = velocity[i];
    out.force[a] = task.k * (tip[i] - hand[i]);
    energy += 0.5 * task.k * (tip[i] - hand[i]) * (tip[i] - hand[i]);
  }
  for (std::size_t c = 0; c < task.path.contacts.size(); ++c) {
    const double d = std::max(0.0, task.path.contacts[c].penetration(out.x));
    energy += (0.5 * task.path.contacts[c].k + 0.25 * task.path.contacts[c].k3 * d * d) * d * d;
  }
  out.energy = energy;
  return out;
}

template <class Dynamics>
std::vector<ToolSample> reference_of(const DeviceTask& task, const Dynamics& dynamics, double tick_hz) {
  constexpr int kN = Dynamics::kJoints;
  using Vector = Eigen::Matrix<Real, kN, 1>;
  const auto ticks = static_cast<std::size_t>(std::floor(ToolTask::kDuration * tick_hz));
  const auto parts = static_cast<std::size_t>(std::max(kStepsPerTick, std::ceil(kStepsPerSecond / tick_hz)));
  const Real h = 1 / (Real(tick_hz) * Real(parts));
  control::Motion<Real, kN> motion;
  motion.x = start_joints(task, 0).template head<kN>().template cast<Real>();
  const auto in_space = [](const Vector& v) {
    Vec3 out = Vec3::Zero();
    out.template head<kN>() = v.template cast<double>();
    return out;
  };
  std::vector<ToolSample> out;
  out.reserve(ticks);
  for (std::size_t k = 0; k < ticks; ++k) {
    for (std::size_t i = 0; i < parts; ++i) {
      const Real t = (Real(k) * Real(parts) + Real(i)) * h;
      const PlantDrive drive{
          .tau = balance(task, in_space(motion.x)), .hand = pull_at(task, t, h), .length = static_cast<double>(h)};
      const auto at = [&](const Vector& q, const Vector& v, Real when) {
        return dynamics.template forces<Real>(q, v, drive, when);
      };
      motion = stepped<Real, kN>(control::Integrator::kRk4, at, motion, Real(0), h);
    }
    out.push_back(sample_at(task, in_space(motion.x), in_space(motion.v), static_cast<double>(k + 1) / tick_hz));
  }
  return out;
}

}  // namespace

DeviceTask device_task(const SceneSpec& scene) {
  DeviceTask task;
  const ToolSpec& tool = scene.tools[0];
  if (!tool.is_virtual && !tool.remote) {
    task.path = tool_task(scene);
    task.device = tool.slave;
    task.environment = tool.environment;
    task.k = tool.k_s;
    task.b = 2 * std::sqrt(tool.k_s * tool.m_s);
  } else {
    task.path = tool_task(scene);
    task.path.contacts = {};
    task.device = scene.seats[0].device;
  }
  task.device.numerics.reset();
  return task;
}

ModelTier tier_of(const SimDeviceSpec& device) noexcept {
  if (device.model == DeviceModel::kLinear) return ModelTier::kPoint;
  return device.gravity || device.friction > 0 ? ModelTier::kFullArm : ModelTier::kArm;
}

DeviceRun::DeviceRun(const DeviceTask& task, double tick_hz, const std::optional<NumericsSpec>& numerics, double from)
    : task_(task),
      tick_hz_(tick_hz),
      plant_(TouchPlant(task.device, task.environment, start_joints(task, from))),
      ticks_(static_cast<std::size_t>(from * tick_hz)) {
  const Vec3 q0 = start_joints(task, from);
  if (task.device.model == DeviceModel::kTouch) {
    if (numerics) plant_ = IntegratedPlant<TouchDynamics>({task.device, task.environment}, *numerics, q0);
  } else if (numerics) {
    plant_ = IntegratedPlant<LinearDynamics>({task.device, task.environment, q0}, *numerics, LinearDynamics::Q(q0[0]));
  } else {
    plant_ = LinearPlant(task.device, task.environment, q0);
  }
}

void DeviceRun::prepare() noexcept {
  const double dt = 1 / tick_hz_;
  hand_ = pull_at(task_, static_cast<double>(ticks_) * dt, dt);
  tau_ = std::visit([&](const auto& plant) { return balance(task_, plant.q()); }, plant_);
  ++ticks_;
}

void DeviceRun::advance() noexcept {
  std::visit([&](auto& plant) { plant.advance(tau_, hand_, 1 / tick_hz_); }, plant_);
}

ToolSample DeviceRun::sample() const noexcept {
  return std::visit(
      [&](const auto& plant) {
        return sample_at(task_, plant.q(), plant.dq(), static_cast<double>(ticks_) / tick_hz_);
      },
      plant_);
}

std::vector<ToolSample> device_reference(const DeviceTask& task, double tick_hz) {
  if (task.device.model == DeviceModel::kTouch)
    return reference_of(task, TouchDynamics(task.device, task.environment), tick_hz);
  return reference_of(task, LinearDynamics(task.device, task.environment, start_joints(task, 0)), tick_hz);
}

}  // namespace tandem::netsim::tradeoff
