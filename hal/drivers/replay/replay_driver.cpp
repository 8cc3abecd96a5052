#include "hal/drivers/replay/replay_driver.h"

#include <utility>

namespace tandem::hal {

ReplayDriver::ReplayDriver(std::string name, std::shared_ptr<const sim::RecordedMotion> motion, Clock& clock)
    : id_{"replay", std::move(name)}, motion_(std::move(motion)), clock_(&clock) {
  caps_.joints = caps_.tip_axes = 3;
  caps_.prismatic = true;
  caps_.simulated = true;
  caps_.workspace_min.fill(-kReach);
  caps_.workspace_max.fill(kReach);
}

Result<> ReplayDriver::bring_up(BringUp& watcher) {
  watcher.progress("ready", 1);
  playing_ = false;
  cursor_ = {};
  return {};
}

std::expected<Exchange, Errc> ReplayDriver::exchange(const ServoCommand& command, State& state) noexcept {
  const Time now = clock_->now();
  if (!playing_) began_ = now;
  playing_ = playing_ || command.seq != 0;
  const sim::MotionPoint at = motion_->at(seconds(now - began_), cursor_);
  ++state.seq;
  state.echo_command = command.seq;
  state.sampled_at = now;
  state.x = at.x;
  state.dx = playing_ ? at.v : Vec3::Zero();
  state.J.setZero();
  state.tau_out = {};
  state.f_out.setZero();
  for (int i = 0; i < 3; ++i) {
    state.q[static_cast<std::size_t>(i)] = state.x[i];
    state.dq[static_cast<std::size_t>(i)] = state.dx[i];
    state.J(i, i) = 1;
  }
  state.homed = true;
  state.saturated = false;
  return Exchange::kFresh;
}

}  // namespace tandem::hal
