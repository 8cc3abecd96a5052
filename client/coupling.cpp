#include "client/coupling.h"

#include "common/setup/channel_setup.h"

namespace tandem::client {

std::unique_ptr<Coupling> make_coupling(const SeatSetup& setup) {
  if (setup.channel.law == LawKind::kReplica && setup.seat.kind == SeatKind::kMaster) return std::make_unique<CopyCoupling>(setup);
  return std::make_unique<SpringCoupling>(setup);
}

SpringCoupling::SpringCoupling(const SeatSetup& setup) : dof_(setup.dof), master_(setup.seat.kind == SeatKind::kMaster) {
  for (std::size_t a = 0; a < dof_; ++a) {
    const double s = setup.axis_scale[a];
    gains_[a] = {setup.coupling.k_c * s, setup.coupling.b * s, setup.coupling.m_c * s};
  }
}

void SpringCoupling::rest(const AxisArray& q, const AxisArray*, double age, control::ChannelEnd& end) noexcept {
  for (std::size_t a = 0; a < dof_; ++a) ipc_[a].rest_at(q[a]);
  end.engage(q, age);
}

AxisArray SpringCoupling::step(const Input& in, control::ChannelEnd& end) noexcept {
  control::EndInput move;
  move.dt = in.dt;
  move.age = in.age;
  move.rx = *in.rx;
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

void SpringCoupling::tell(const AxisArray& q, const AxisArray& v, bool engaged, const control::ChannelEnd& end, PortSample& out) const noexcept {
  const control::EndState& state = end.state();
  for (std::size_t a = 0; a < dof_; ++a) {
    out.x[a] = master_ ? ipc_[a].x : q[a];
    out.v[a] = engaged && master_ ? ipc_[a].v : v[a];
    out.f[a] = state.k[a] * (out.x[a] - state.ref[a]);
  }
}

namespace {

control::ToolCopy::Params copy_params(const SeatSetup& setup) {
  control::ToolCopy::Params p;
  p.tool = {setup.m_s, setup.b_s};
  p.axes = setup.dof;
  p.contacts = setup::contacts(setup.environment);
  p.k_c = setup.coupling.k_c;
  p.b_rel = setup.channel.b_rel;
  p.v_app = setup.channel.v_app;
  p.offset_rests = setup.gate.ramp_in;
  p.force_max = setup.gate.force_max * share_of_force(setup.seat.role);
  p.dt = 1.0 / setup.tick_hz;
  p.assist.force = setup.seat.assist.force;
  p.assist.in_contact = setup.seat.assist.in_contact;
  return p;
}

}  // namespace

CopyCoupling::CopyCoupling(const SeatSetup& setup) : dof_(setup.dof), copy_(copy_params(setup)) {}

void CopyCoupling::rest(const AxisArray& q, const AxisArray* tool, double age, control::ChannelEnd& end) noexcept {
  copy_.rest_at(tool != nullptr ? *tool : q, q);
  end.engage(tool != nullptr ? *tool : q, age);
  effort_ = {};
}

AxisArray CopyCoupling::step(const Input& in, control::ChannelEnd& end) noexcept {
  control::EndInput move;
  move.dt = in.dt;
  move.age = in.age;
  move.authority = in.authority;
  move.slave_pull = in.slave_pull;
  move.rx = *in.rx;
  for (std::size_t a = 0; a < dof_; ++a) {
    move.x[a] = copy_.tool().x(a);
    move.dissipated[a] = copy_.dissipated(a);
    dissipated_ += move.dissipated[a];
  }
  end.move(move);
  if (in.ghost != nullptr && in.ghost->leader != 0 && copy_.assist().on()) {
    AxisArray x{}, v{};
    for (std::size_t a = 0; a < dof_; ++a) {
      v[a] = in.ghost->v[a];
      x[a] = control::Prediction::place_for_hand(in.ghost->x[a], v[a], in.age);
    }
    copy_.see_leader(x, v, in.slave_pull > 0);
  }
  return copy_.step(in.q, in.authority, end);
}

void CopyCoupling::delivered(const AxisArray& effort) noexcept {
  effort_ = effort;
  copy_.delivered(effort);
}

void CopyCoupling::tell(const AxisArray& q, const AxisArray& v, bool engaged, const control::ChannelEnd&, PortSample& out) const noexcept {
  for (std::size_t a = 0; a < dof_; ++a) {
    const control::HandMotion& anchor = copy_.anchor(a);
    out.x[a] = engaged ? anchor.x : q[a];
    out.v[a] = engaged ? anchor.v : v[a];
    out.a[a] = engaged ? anchor.a : 0;
    out.f[a] = engaged ? effort_[a] : 0;
  }
}

}  // namespace tandem::client
