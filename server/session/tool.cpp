#include "server/session/tool.h"

#include <algorithm>
#include <cmath>

#include "common/setup/channel_factory.h"
#include "server/session/estimated_plane.h"

namespace tandem::server {

namespace {
constexpr double kBrake = 50;  // [N s/m] at the tip, while HELD
}

Tool::Tool(const SceneSpec& scene, std::size_t index, std::unique_ptr<hal::SteppedDevice> slave)
    : authority(scene.masters(), scene.alpha_slew, scene.channel.tank),
      spec_(&scene.tools[index]),
      dof_(scene.dof),
      slave_(std::move(slave)),
      received_contacts_({scene.dof, scene.channel.v_app, scene.coupling.k_c, 1.0 / scene.tick_hz}) {
  if (spec_->is_virtual) {
    body_.emplace(control::VirtualTool::Gains{spec_->m_s, spec_->b_s}, dof_, setup::contacts(spec_->environment),
                  setup::numerics(scene.numerics));
    rest_at({spec_->slave.start.x, spec_->slave.start.y, spec_->slave.start.z});
  } else if (spec_->remote && scene.channel.law == LawKind::kReplica) {
    body_.emplace(control::VirtualTool::Gains{spec_->m_s, spec_->b_s}, dof_, control::ContactSet{},
                  setup::numerics(scene.numerics));
    if (spec_->contacts == ContactsMode::kEstimated) source_ = std::make_unique<EstimatedPlane>(dof_);
  } else if (slave_) {
    map_ = hal::PortMap(scene.port, dof_, slave_->caps().joints);
    scale_ = map_.scale(slave_->state());
    rest_at(map_.position(slave_->state()));
  }
}

void Tool::rest_at(const AxisArray& x) noexcept {
  for (std::size_t a = 0; a < dof_; ++a) port_.x[a] = x[a];
  port_.v = port_.surface_force = {};
  if (!body_) {
    for (std::size_t a = 0; a < dof_; ++a) ipc_[a] = {x[a], 0, 0};
    return;
  }
  received_contacts_.clear();
  body_->set_received_contacts(received_contacts_.surfaces());
  body_->rest_at(x);
}

void Tool::update_contacts(ToolView view) noexcept {
  if (source_ == nullptr || !body_) return;
  view.axes = dof_;
  view.x = position();
  view.v = velocity();
  LocalContactList wanted;
  source_->find_contacts(view, wanted);
  contacts_.size = 0;
  for (const LocalContact& contact :
       std::span{wanted.item}.first(std::min<std::size_t>(wanted.size, kLocalContactsMax))) {
    const bool known =
        std::ranges::any_of(contacts_.all(), [&](const LocalContact& other) { return other.id == contact.id; });
    const bool rubs_in_vain = contact.mu > 0 && !body_->numerics().keeps_proof();  // only that step solves friction
    if (known || rubs_in_vain || !is_surface(contact, dof_) || !in_range(contact)) {
      ++contacts_refused_;
      continue;
    }
    contacts_.add(contact);
  }
  received_contacts_.update(contacts_.all());
  if (received_contacts_.step(view.x, nullptr)) body_->set_received_contacts(received_contacts_.surfaces());
}

void Tool::step_body(double dt, const control::EscHub::Efforts& seats, bool braked) noexcept {
  for (std::size_t a = 0; a < dof_; ++a) {
    pulls_[a] = seats[a];
    if (braked) pulls_[a].damper(kBrake, 0);
  }
  control::VirtualTool::Parts parts;
  if (body_->in_parts()) [[unlikely]] {
    parts = body_->step_in_parts(dt, pulls_);
    if (!parts.finite) ++not_finite_;
  } else if (!body_->step(dt, pulls_)) {
    ++not_finite_;
  }
  for (std::size_t a = 0; a < dof_; ++a) {
    const double v = body_->v(a);
    port_.moved[a] = body_->x(a) - port_.x[a];
    port_.x[a] = body_->x(a);
    port_.v[a] = v;
    port_.dissipated[a] = (spec_->b_s + pulls_[a].b + 0.5 * pulls_[a].k * dt) * v * v * dt;
    port_.surface_force[a] = body_->surface_force()[a];
  }
  if (body_->in_parts()) [[unlikely]]
    for (std::size_t a = 0; a < dof_; ++a)
      port_.dissipated[a] = body_->heat(parts, a, spec_->b_s + pulls_[a].b, pulls_[a].k, dt);
}

void Tool::step(double dt, const control::EscHub::Efforts& seats, bool braked) noexcept {
  if (body_) return step_body(dt, seats, braked);
  const AxisArray q = slave_ ? map_.position(slave_->state()) : AxisArray{};
  for (std::size_t a = 0; a < dof_; ++a) {
    control::ToolIpc& ipc = ipc_[a];
    control::Pull pull = seats[a];
    if (slave_) pull.spring(spec_->k_s * scale_[a], q[a]);
    if (braked) pull.damper(kBrake * scale_[a], 0);
    ipc.step({spec_->m_s * scale_[a], spec_->b_s * scale_[a]}, dt, pull, seats[a].k);
    if (!std::isfinite(ipc.x) || !std::isfinite(ipc.v)) {  // back to the last position, at rest; counted
      ipc = {port_.x[a], 0, 0};
      ++not_finite_;
    }
    port_.moved[a] = ipc.x - port_.x[a];
    port_.x[a] = ipc.x;
    port_.v[a] = ipc.v;
    port_.dissipated[a] = ipc.dissipated;
  }
  if (!slave_) return;
  const hal::State& s = slave_->state();
  for (std::size_t a = 0; a < dof_; ++a) {
    const double pull = spec_->k_s * scale_[a] * (ipc_[a].x - q[a]);
    slave_effort_[a] = std::isfinite(pull) ? pull : 0;  // a slave with an invalid position gets no force
  }
  command_.seq += 1;
  command_.expires = s.sampled_at + std::chrono::milliseconds(20);
  command_.kind = hal::CommandKind::kJointEffort;
  command_.effort = map_.joint_effort(s, slave_effort_);
}

void Tool::advance_slave(Duration dt) noexcept {
  if (slave_) slave_->advance(command_, dt);
}

hal::Vec3 Tool::slave_force_commanded() const noexcept {
  return slave_ ? map_.tip_force(slave_->state(), slave_effort_) : hal::Vec3::Zero();
}

}  // namespace tandem::server
