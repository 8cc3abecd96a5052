#include "server/session_record.h"

#include <algorithm>

namespace tandem::server {

void take_record(const Session& session, TickRecord& record) noexcept {
  const SceneSpec& scene = session.scene();
  const std::size_t masters = scene.masters();
  record.tick = session.session_tick();
  record.running = session.state() == wire::SessionState::kRunning || session.state() == wire::SessionState::kHeld;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const wire::StateMessage& m = session.seat(i).heard();
    SeatRecord& r = record.seats[i];
    r.alpha = session.seat(i).tx.alpha;
    if (i < masters) {
      r.alpha = 0;
      for (std::size_t j = 0; j < scene.tools.size() && r.alpha == 0; ++j)
        if (scene.follow[i][j] > 0) r.alpha = session.tool(j).authority.alpha(i);
    }
    r.q = m.telemetry.q;
    r.x = m.telemetry.x;
    r.f_cmd = m.telemetry.f_cmd;
    r.f_out = m.telemetry.f_out;
    r.e_in = m.port.e_in;
    r.e_out = m.telemetry.e_out;
    r.dissipated_j = m.telemetry.dissipated_j;
    r.refused_j = m.telemetry.refused_j;
    r.margin_min_j = m.telemetry.margin_min_j;
    r.delivered_j = m.telemetry.delivered_j;
    r.gate = m.gate;
    r.engaged = m.engaged;
    r.sample_tick = m.seat_tick;
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    const Tool& tool = session.tool(j);
    ToolRecord& r = record.tools[j];
    for (std::size_t a = 0; a < std::min<std::size_t>(3, scene.dof); ++a) r.x_tool[a] = tool.x(a);
    if (tool.slave() != nullptr) {
      const hal::State& s = tool.slave()->state();
      const hal::Vec3 f = tool.slave_force_commanded();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto e = static_cast<Eigen::Index>(k);
        r.x[k] = s.x[e];
        r.f_env[k] = s.f_env[e];
        r.f_cmd[k] = f[e];
      }
      r.q = s.q;
      r.penetration = s.penetration;
      r.sample_tick = session.session_tick();
    } else {
      const wire::Telemetry& t = session.seat(tool.spec().seat).heard().telemetry;
      r.q = t.q;
      r.x = t.x;
      r.f_env = t.f_env;
      r.f_cmd = t.f_cmd;
      r.penetration = t.penetration_m;
      r.sample_tick = session.seat(tool.spec().seat).heard().seat_tick;
    }
    r.held = tool.authority.held();
    r.mfs_j = tool.sources.granted();
    r.e_p_j = 0;
    for (std::size_t a = 0; a < scene.dof; ++a) {
      r.e_p_j += tool.sources.energy_p(a);
      if (a < 3) r.e_p_axis_j[a] = tool.sources.energy_p(a);
    }
  }
}

}  // namespace tandem::server
