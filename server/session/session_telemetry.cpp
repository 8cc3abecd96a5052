#include "server/session/session_telemetry.h"

#include <algorithm>
#include <cmath>

#include "proto/wire/wire_codec.h"

namespace tandem::server {

namespace {

double ms(Duration d) noexcept { return 1e3 * seconds(d); }

wire::WatchedSeatState seat_state(const Session& session, Time now, std::size_t i) noexcept {
  const SeatEndpoint& seat = session.seat(i);
  wire::WatchedSeatState out;
  out.taken = seat.taken();
  if (!seat.taken()) return out;
  const SeatRecord& record = session.record().seats[i];
  out.heard = seat.alive(now);
  out.stopped = seat.last_state().stop;
  out.engaged = record.engaged;
  out.gate = record.gate;
  if (!seat.sent_telemetry() || i >= session.scene().masters()) return out;
  // The record has the force that the tool feels: with a motion scale, another one than that on the hand.
  out.f = seat.telemetry().f_out;
  const auto sendable = [](double x) { return std::abs(x) <= wire::kPositionMaxM; };  // scaled by up to 4
  if (std::ranges::all_of(record.x, sendable)) out.x = record.x;
  return out;
}

wire::WatchedToolState tool_state(const Session& session, Time now, std::size_t j) noexcept {
  const Tool& tool = session.tool(j);
  const ToolRecord& record = session.record().tools[j];
  wire::WatchedToolState out;
  out.touching = session.touching(now, j);
  out.braked = record.held;
  if (tool.spec().remote && !session.seat(tool.spec().seat).sent_telemetry()) return out;
  out.x = record.x;
  out.f = record.f_env;
  out.depth = record.penetration;
  return out;
}

wire::WatchedAuthority authority_of(const Session& session, std::size_t j) noexcept {
  const Tool& tool = session.tool(j);
  wire::WatchedAuthority out;
  out.tool = static_cast<std::uint32_t>(j);
  if (tool.transfer.pending()) {
    out.transfer_ticks = tool.transfer.ticks_left();
    out.transfer_by = session.authority().origin(j);
  }
  for (std::size_t k = 0; k < session.scene().masters(); ++k) {
    out.wanted[k] = std::clamp(tool.transfer.scheduled()[k], 0.0, 1.0);
    out.applied[k] = std::clamp(tool.authority.alpha(k), 0.0, 1.0);  // a ramp may round to a little below 0
  }
  return out;
}

}  // namespace

/// A seat that was left keeps no link: its values would look like those of the present.
wire::WatchedLink link_of(const Session& session, Time now, std::size_t i) noexcept {
  const SeatEndpoint& seat = session.seat(i);
  wire::WatchedLink out;
  out.seat = static_cast<std::uint32_t>(i);
  if (!seat.taken() || !seat.ever_heard()) return out;
  const transport::SecureChannel& link = *seat.link();
  out.loss_up_percent = link.stats().loss_percent();
  out.gap_up_ms = ms(link.longest_gap(now));
  if (link.timing().rtt_samples() > 0) out.rtt_p50_ms = ms(link.timing().rtt_p50());
  if (!seat.sent_telemetry()) return out;
  const wire::Telemetry& said = seat.telemetry();
  out.loss_down_percent = said.down_loss_percent;
  out.gap_down_ms = said.down_longest_gap_ms;
  out.age_p99_ms = said.down_age_p99_ms;
  out.margin_min_j = said.margin_min_j;
  out.gate_trips = said.gate_trips;
  out.late_ticks = said.late_ticks;
  return out;
}

void fill_telemetry(const Session& session, Time now, std::uint32_t turn, wire::SessionTelemetry& out) noexcept {
  const SceneSpec& scene = session.scene();
  out.session_tick = session.clock().session_tick();
  out.state = session.state();
  out.shed_level = static_cast<std::uint32_t>(session.lifecycle().load_state().level);
  out.authority_version = session.authority().version();
  out.stops = session.stop_control().latch().stops();
  for (std::size_t i = 0; i < scene.seats.size(); ++i) out.seats[i] = seat_state(session, now, i);
  for (std::size_t j = 0; j < scene.tools.size(); ++j) out.tools[j] = tool_state(session, now, j);
  out.link = link_of(session, now, turn % scene.seats.size());
  out.authority = authority_of(session, turn % scene.tools.size());
}

}  // namespace tandem::server
