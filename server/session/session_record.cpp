#include "server/session/session_record.h"

#include <algorithm>
#include <limits>

namespace tandem::server {

void record_seat(const wire::StateMessage& said, const wire::Telemetry& telemetry, PortSpace port, double scale,
                 SeatRecord& r) noexcept {
  r.q = telemetry.q;
  r.x = telemetry.x;
  r.f_cmd = telemetry.f_cmd;
  r.f_out = telemetry.f_out;
  for (std::size_t k = 0; scale != 1 && k < 3; ++k) {
    r.x[k] *= scale;
    r.f_cmd[k] /= scale;
    r.f_out[k] /= scale;
  }
  // The port's values are already those of the tool.
  for (std::size_t k = 0; k < 3; ++k)
    r.v[k] = port == PortSpace::kTip ? said.port.v[k] : std::numeric_limits<double>::quiet_NaN();
  r.e_in = said.port.e_in;
  r.e_out = telemetry.e_out;
  r.dissipated_j = telemetry.dissipated_j;
  r.refused_j = telemetry.refused_j;
  r.margin_min_j = telemetry.margin_min_j;
  r.delivered_j = telemetry.delivered_j;
  r.gate = said.gate;
  r.engaged = said.engaged;
  r.sample_tick = said.seat_tick;
}

void record_slave(const wire::Telemetry& said, ToolRecord& r) noexcept {
  r.q = said.q;
  r.x = said.x;
  r.f_env = said.f_env;
  r.f_cmd = said.f_cmd;
  r.penetration = said.penetration_m;
}

void slave_motion(const Session& session, std::size_t j, std::array<double, 3>& x, std::array<double, 3>& f_env,
                  double& penetration) noexcept {
  const Tool& tool = session.tool(j);
  if (tool.slave() != nullptr) {
    const hal::State& s = tool.slave()->state();
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = s.x[static_cast<Eigen::Index>(k)];
      f_env[k] = s.f_env[static_cast<Eigen::Index>(k)];
    }
    penetration = s.penetration;
  } else if (const control::VirtualTool* const body = tool.body(); body != nullptr && !tool.spec().remote) {
    const std::size_t axes = session.scene().dof;
    for (std::size_t a = 0; a < 3; ++a) x[a] = a < axes ? tool.x(a) : 0;
    f_env = body->surface_force();
    penetration = body->penetration();
  } else {
    const wire::Telemetry& said = session.seat(tool.spec().seat).telemetry();
    x = said.x;
    f_env = said.f_env;
    penetration = said.penetration_m;
  }
}

void record_tick(const Session& session, const LeadingHands& leading, TickRecord& record) noexcept {
  const SceneSpec& scene = session.scene();
  const std::size_t masters = scene.masters();
  record.tick = session.clock().session_tick();
  record.time_ns = session.clock().elapsed().count();
  const wire::SessionState state = session.state();
  const bool stopped = state == wire::SessionState::kPaused || state == wire::SessionState::kStopped ||
                       state == wire::SessionState::kOverloaded;
  record.running = state == wire::SessionState::kRunning || state == wire::SessionState::kHeld ||
                   (stopped && session.clock().begun() && !session.lifecycle().clock_stopped());
  record.unleased = !session.lifecycle().may_act();
  record.stopped_ticks = session.clock().stopped_ticks();
  record.dropped_ticks = session.clock().dropped_ticks();
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    SeatRecord& r = record.seats[i];
    r.alpha = session.seat(i).tx.alpha;
    if (i < masters) {
      const wire::Ghost& ghost = leading.ghost(i);
      r.leader = ghost.leader;
      for (std::size_t k = 0; k < 3; ++k) r.ghost[k] = ghost.x[k];
      r.alpha = session.hub().authority(i);
    }
    record_seat(session.seat(i).last_state(), session.seat(i).telemetry(), scene.port, scene.seats[i].motion_scale, r);
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    const Tool& tool = session.tool(j);
    ToolRecord& r = record.tools[j];
    for (std::size_t a = 0; a < std::min<std::size_t>(3, scene.dof); ++a) r.x_tool[a] = tool.x(a);
    slave_motion(session, j, r.x, r.f_env, r.penetration);
    if (tool.slave() != nullptr) {
      const hal::Vec3 f = tool.slave_force_commanded();
      for (std::size_t k = 0; k < 3; ++k) r.f_cmd[k] = f[static_cast<Eigen::Index>(k)];
      r.q = tool.slave()->state().q;
      r.sample_tick = session.clock().session_tick();
    } else if (tool.body() != nullptr && !tool.spec().remote) {
      for (std::size_t k = 0; k < 3; ++k) r.f_cmd[k] = -r.f_env[k];
      r.sample_tick = session.clock().session_tick();
    } else {
      record_slave(session.seat(tool.spec().seat).telemetry(), r);
      r.sample_tick = session.seat(tool.spec().seat).last_state().seat_tick;
    }
    r.held = tool.authority.held();
    for (std::size_t i = 0; i < masters; ++i) r.alpha[i] = tool.authority.alpha(i);
    const control::FlowSources& sources = session.hub().sources(j);
    r.mfs_j = sources.granted();
    r.e_p_j = 0;
    for (std::size_t a = 0; a < scene.dof; ++a) {
      r.e_p_j += sources.energy_p(a);
      if (a < 3) r.e_p_axis_j[a] = sources.energy_p(a);
    }
  }
}

}  // namespace tandem::server
