#include "client/seat/coupling.h"

#include "common/setup/channel_factory.h"

namespace tandem::client {

std::unique_ptr<Coupling> make_coupling(const SeatSetup& setup) {
  if (setup.channel.law == LawKind::kReplica && setup.seat.kind == SeatKind::kMaster)
    return std::make_unique<CopyCoupling>(setup);
  return std::make_unique<SpringCoupling>(setup);
}

SpringCoupling::SpringCoupling(const SeatSetup& setup)
    : dof_(setup.dof), master_(setup.seat.kind == SeatKind::kMaster) {
  const double at_tool = 1 / (setup.seat.motion_scale * setup.seat.motion_scale);
  for (std::size_t a = 0; a < dof_; ++a) {
    const double s = setup.axis_scale[a] * at_tool;
    gains_[a] = {setup.coupling.k_c * s, setup.coupling.b * s, setup.coupling.m_c * s};
  }
}

void SpringCoupling::reset(const Input& in, bool) noexcept {
  for (std::size_t a = 0; a < dof_; ++a) ipc_[a].rest_at(in.q[a]);
  in.tools[0].end->engage(in.q, in.age);
}

AxisArray SpringCoupling::step(const Input& in) noexcept {
  control::ChannelEnd& end = *in.tools[0].end;
  control::EndInput move;
  move.dt = in.dt;
  move.age = in.age;
  move.rx = in.tools[0].received->port;
  for (std::size_t a = 0; a < dof_; ++a) {
    move.x[a] = master_ ? ipc_[a].x : in.q[a];
    move.dissipated[a] = master_ ? ipc_[a].dissipated : 0;
  }
  const control::EndState& state = end.move(move);

  AxisArray wanted{};
  for (std::size_t a = 0; a < dof_; ++a) {
    end.credit(a, state.absorbed[a]);
    if (master_) {
      ipc_[a].step(gains_[a], in.dt, in.q[a], state.ref[a], state.k[a], state.b[a]);
      dissipated_ += ipc_[a].dissipated;
      wanted[a] = ipc_[a].device_effort(gains_[a], in.q[a]);
    } else {
      wanted[a] = state.k[a] * (state.ref[a] - in.q[a]) - state.b[a] * in.v[a];
    }
  }
  return wanted;
}

void SpringCoupling::fill_sample(std::size_t, const Input& in, bool engaged, PortSample& out) const noexcept {
  const control::EndState& state = in.tools[0].end->state();
  for (std::size_t a = 0; a < dof_; ++a) {
    out.x[a] = master_ ? ipc_[a].x : in.q[a];
    if (engaged && in.device_force != nullptr && state.k[a] > 0) out.x[a] -= (*in.device_force)[a] / state.k[a];
    out.v[a] = engaged && master_ ? ipc_[a].v : in.v[a];
    out.f[a] = state.k[a] * (out.x[a] - state.ref[a]);
  }
  if (engaged) in.tools[0].end->replace_velocity(out.v);
}

namespace {

control::ToolCopy::Params copy_params(const SeatSetup& setup, const control::VirtualTool::Gains& gains,
                                      const EnvironmentSpec& environment) {
  const double scale = setup.seat.motion_scale;
  return {.tool = gains,
          .axes = setup.dof,
          .contacts = setup::contacts(environment),
          .k_c = setup.coupling.k_c / (scale * scale),
          .b_rel = setup.channel.b_rel,
          .v_app = setup.channel.v_app,
          .offset_hold = setup.gate.ramp_in,
          .force_max = setup.gate.force_max * share_of_force(setup.seat.role) / scale,
          .of_several = !setup.further.empty(),
          .dt = 1.0 / setup.tick_hz,
          .numerics = setup::numerics(setup.numerics),
          .assist = {.force = setup.seat.assist.force / scale, .in_contact = setup.seat.assist.in_contact}};
}

}  // namespace

CopyCoupling::CopyCoupling(const SeatSetup& setup)
    : dof_(setup.dof), k_c_(setup.coupling.k_c / (setup.seat.motion_scale * setup.seat.motion_scale)) {
  copies_.reserve(1 + setup.further.size());
  copies_.push_back({.tool = control::ToolCopy(copy_params(setup, {setup.m_s, setup.b_s}, setup.environment)),
                     .weight = setup.weight});
  for (const CoupledTool& tool : setup.further)
    copies_.push_back(
        {.tool = control::ToolCopy(copy_params(setup, {tool.m_s, tool.b_s}, tool.environment)), .weight = tool.weight});
}

void CopyCoupling::reset(const Input& in, bool heard) noexcept {
  for (std::size_t k = 0; k < copies_.size(); ++k) {
    const AxisArray& tool = heard ? in.tools[k].received->port.f : in.q;
    copies_[k].tool.rest_at(tool, in.q);
    in.tools[k].end->engage(tool, in.age);
    copies_[k].effort = {};
  }
  share_ = 0;
}

const AxisArray& CopyCoupling::wanted_of(Copy& copy, const Tool& tool, const Input& in) noexcept {
  control::EndInput move;
  move.dt = in.dt;
  move.age = in.age;
  move.authority = tool.received->alpha;
  move.slave_pull = tool.received->slave_pull;
  move.rx = tool.received->port;
  for (std::size_t a = 0; a < dof_; ++a) {
    move.x[a] = copy.tool.tool().x(a);
    move.dissipated[a] = copy.tool.dissipated(a);
    dissipated_ += copy.weight * move.dissipated[a];
  }
  tool.end->move(move);
  if (&copy == &copies_[0] && in.ghost != nullptr && in.ghost->leader != 0 && copy.tool.assist().on()) {
    AxisArray x{}, v{};
    for (std::size_t a = 0; a < dof_; ++a) {
      v[a] = in.ghost->v[a];
      x[a] = control::Prediction::place_for_hand(in.ghost->x[a], v[a], in.age);
    }
    copy.tool.set_leader(x, v, tool.received->slave_pull > 0);
  }
  return copy.tool.step(in.q, move.authority, *tool.end);
}

AxisArray CopyCoupling::step(const Input& in) noexcept {
  if (copies_.size() == 1) return wanted_of(copies_[0], in.tools[0], in);
  wanted_ = {};
  for (std::size_t k = 0; k < copies_.size(); ++k) {
    Copy& copy = copies_[k];
    const AxisArray& wanted = wanted_of(copy, in.tools[k], in);
    for (std::size_t a = 0; a < dof_; ++a) {
      copy.wanted[a] = wanted[a];
      wanted_[a] += copy.weight * wanted[a];
    }
  }
  return wanted_;
}

void CopyCoupling::set_delivered(const AxisArray& effort) noexcept {
  if (copies_.size() == 1) {
    copies_[0].effort = effort;
    return copies_[0].tool.delivered(effort);
  }
  share_ = control::ToolCopy::share_of(effort, wanted_, dof_).value_or(share_);
  for (Copy& copy : copies_) {
    for (std::size_t a = 0; a < dof_; ++a) copy.effort[a] = share_ * copy.wanted[a];
    copy.tool.delivered(copy.effort);
  }
}

void CopyCoupling::yield(const AxisArray& part) noexcept {
  for (Copy& copy : copies_) copy.tool.yield(part);
}

void CopyCoupling::fill_sample(std::size_t k, const Input& in, bool engaged, PortSample& out) const noexcept {
  for (std::size_t a = 0; a < dof_; ++a) {
    const control::HandMotion& anchor = copies_[k].tool.anchor(a);
    out.x[a] = engaged ? anchor.x : in.q[a];
    if (engaged && in.device_force != nullptr) out.x[a] -= (*in.device_force)[a] / k_c_;
    out.v[a] = engaged ? anchor.v : in.v[a];
    out.a[a] = engaged ? anchor.a : 0;
    out.f[a] = engaged ? copies_[k].effort[a] : 0;
  }
}

}  // namespace tandem::client
