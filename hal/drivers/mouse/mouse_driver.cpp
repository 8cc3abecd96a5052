#include "hal/drivers/mouse/mouse_driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tandem::hal {

namespace {
constexpr double kGapMax = 0.05;  // [s] longest time step; a thread that slept longer does not catch up
}

MouseDriver::MouseDriver(std::string key, std::unique_ptr<MousePipe> pipe, Clock& clock, const Params& params)
    : id_{"mouse", std::move(key)}, pipe_(std::move(pipe)), clock_(&clock), params_(params) {
  caps_.joints = caps_.tip_axes = 3;
  caps_.prismatic = true;
  caps_.buttons = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    caps_.axis[i].resolution = params_.metres_per_count;
    caps_.axis[i].from = Provenance::kConfig;
    caps_.workspace_min[i] = -kReach;
    caps_.workspace_max[i] = kReach;
  }
}

Result<> MouseDriver::bring_up(BringUp& watcher) {
  if (const auto old = pipe_->read(); !old)  // discards earlier motion
    return std::unexpected(DeviceError{old.error(), "mouse " + id_.key + " was unplugged; plug it in again"});
  wanted_ = target_ = x_ = v_ = Vec3::Zero();
  before_ = clock_->now();
  watcher.progress("ready", 1);
  return {};
}

std::expected<Exchange, Errc> MouseDriver::exchange(const ServoCommand& command, State& state) noexcept {
  const auto moved = pipe_->read();
  if (!moved) return std::unexpected(moved.error());
  const double forward = params_.metres_per_count * moved->forward, wheel = kPerDetent * moved->wheel;
  const bool vertical = params_.plane == Plane::kVertical;
  wanted_ += Vec3(params_.metres_per_count * moved->right, vertical ? wheel : forward, vertical ? forward : wheel);
  wanted_ = wanted_.cwiseMax(-kReach).cwiseMin(kReach);
  const Time now = clock_->now();
  follow(std::clamp(seconds(now - before_), 0.0, kGapMax));
  before_ = now;

  ++state.seq;
  state.echo_command = command.seq;
  state.sampled_at = now;
  state.x = x_;
  state.dx = v_;
  state.J.setZero();
  state.tau_out = {};
  state.f_out.setZero();
  for (int i = 0; i < 3; ++i) {
    state.q[static_cast<std::size_t>(i)] = x_[i];
    state.dq[static_cast<std::size_t>(i)] = v_[i];
    state.J(i, i) = 1;
  }
  state.buttons = moved->buttons;
  state.homed = true;
  state.saturated = false;
  return Exchange::kFresh;
}

/// Solves x'' = (target - x) / T^2 - 2 x' / T exactly for a target constant during `dt`: stable for every step, no
/// overshoot.
void MouseDriver::follow(double dt) noexcept {
  const double step = kSpeedMax * dt;
  target_ += (wanted_ - target_).cwiseMax(-step).cwiseMin(step);
  const double w = 1 / kFollow, decay = std::exp(-w * dt);
  const Vec3 away = x_ - target_;
  const Vec3 slope = v_ + w * away;
  x_ = target_ + decay * (away + dt * slope);
  v_ = decay * (v_ - w * dt * slope);
}

}  // namespace tandem::hal
