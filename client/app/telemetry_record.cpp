#include "client/app/telemetry_record.h"

#include <cmath>

namespace tandem::client {
namespace {

constexpr server::Triple kUnknown{wire::kUnknown, wire::kUnknown, wire::kUnknown};

/// First tool that a master follows.
std::size_t tool_of(const SceneSpec& scene, std::size_t seat) {
  for (std::size_t j = 0; j < scene.tools.size(); ++j)
    if (scene.follow[seat][j] > 0) return j;
  return 0;
}

}  // namespace

server::TickRecord record_of(const SceneSpec& scene, const SessionWatch& watch) {
  const wire::SessionTelemetry& t = *watch.newest();
  server::TickRecord record;
  record.tick = t.session_tick;
  record.time_ns = std::llround(1e9 * t.session_tick / scene.tick_hz);
  record.running = t.state == wire::SessionState::kRunning || t.state == wire::SessionState::kHeld;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    server::SeatRecord& seat = record.seats[i];
    const wire::WatchedSeatState& seen = t.seats[i];
    const wire::WatchedLink& link = watch.link_of(i);
    seat.alpha = i < scene.masters() ? watch.authority_over(tool_of(scene, i)).applied[i] : 0;
    seat.q.fill(wire::kUnknown);
    seat.x = seen.x;
    seat.v = kUnknown;
    seat.f_cmd = kUnknown;
    seat.f_out = seen.f;
    seat.dissipated_j = seat.refused_j = seat.delivered_j = wire::kUnknown;
    seat.margin_min_j = link.margin_min_j;
    seat.ghost = kUnknown;
    seat.gate = seen.gate;
    seat.engaged = seen.engaged;
    seat.sample_tick = t.session_tick;
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    server::ToolRecord& tool = record.tools[j];
    const wire::WatchedToolState& seen = t.tools[j];
    tool.q.fill(wire::kUnknown);
    tool.x = tool.x_tool = seen.x;
    tool.f_cmd = kUnknown;
    tool.f_env = seen.f;
    tool.penetration = seen.depth;
    tool.held = seen.braked;
    tool.mfs_j = tool.e_p_j = wire::kUnknown;
    tool.e_p_axis_j = kUnknown;
    tool.sample_tick = t.session_tick;
    tool.alpha = watch.authority_over(j).applied;
  }
  return record;
}

}  // namespace tandem::client
