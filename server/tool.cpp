#include "server/tool.h"

#include <cmath>

#include "common/setup/channel_setup.h"

namespace tandem::server {

namespace {
constexpr double kBrake = 50;  // [N s/m] at the tip, while HELD
}

Tool::Tool(const SceneSpec& scene, std::size_t index, std::unique_ptr<hal::SteppedDevice> slave)
    : authority(scene.masters(), scene.alpha_slew, scene.channel.tank),
      sources(setup::flow_source_mode(scene.channel.mfs), scene.channel.tank),
      spec_(&scene.tools[index]),
      dof_(scene.dof),
      slave_(std::move(slave)) {
  if (slave_) {
    map_ = hal::PortMap(scene.port, dof_, slave_->caps().joints);
    scale_ = map_.scale(slave_->state());
    rest_at(map_.position(slave_->state()));
  }
}

void Tool::rest_at(const AxisArray& x) noexcept {
  for (std::size_t a = 0; a < dof_; ++a) ipc_[a] = {x[a], 0, 0};
}

void Tool::step(double dt, const std::array<control::ToolIpc::Pull, kAxesMax>& seats, const AxisArray& damping,
                bool braked) noexcept {
  const AxisArray q = slave_ ? map_.position(slave_->state()) : AxisArray{};
  for (std::size_t a = 0; a < dof_; ++a) {
    const control::ToolIpc before = ipc_[a];
    control::ToolIpc::Pull pull = seats[a];
    if (slave_) pull.add(spec_->k_s * scale_[a], q[a]);
    ipc_[a].step({spec_->m_s * scale_[a], spec_->b_s * scale_[a]}, dt, pull, seats[a].k,
                 damping[a] + (braked ? kBrake * scale_[a] : 0.0));
    if (!std::isfinite(ipc_[a].x) || !std::isfinite(ipc_[a].v)) {  // one tick back, at rest; counted
      ipc_[a] = {before.x, 0, 0};
      ++not_finite_;
    }
    moved_[a] = ipc_[a].x - before.x;
    dissipated_[a] = ipc_[a].dissipated;
  }
  if (!slave_) return;
  const hal::State& s = slave_->state();
  for (std::size_t a = 0; a < dof_; ++a) {
    const double pull = spec_->k_s * scale_[a] * (ipc_[a].x - q[a]);
    slave_effort_[a] = std::isfinite(pull) ? pull : 0;  // a slave that does not know where it is gets no force
  }
  command_.seq += 1;
  command_.expires = s.sampled_at + std::chrono::milliseconds(20);
  command_.kind = hal::CommandKind::kJointEffort;
  command_.effort = map_.joint_effort(s, slave_effort_);
}

void Tool::advance_slave(Duration dt) noexcept {
  if (slave_) slave_->advance(command_, dt);
}

AxisArray Tool::position() const noexcept {
  AxisArray x{};
  for (std::size_t a = 0; a < dof_; ++a) x[a] = ipc_[a].x;
  return x;
}

AxisArray Tool::velocity() const noexcept {
  AxisArray v{};
  for (std::size_t a = 0; a < dof_; ++a) v[a] = ipc_[a].v;
  return v;
}

hal::Vec3 Tool::slave_force_commanded() const noexcept {
  return slave_ ? map_.tip_force(slave_->state(), slave_effort_) : hal::Vec3::Zero();
}

}  // namespace tandem::server
