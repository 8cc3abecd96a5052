#include "client/app/seat_status_recorder.h"

#include <algorithm>
#include <cmath>

namespace tandem::client {
namespace {

constexpr double kPresentSilence = 0.5;  // [s] silence up to which the server counts as present

double sum_j(const EnergyArray& nj) {
  double sum = 0;
  for (const auto e : nj) sum += static_cast<double>(e) * 1e-9;
  return sum;
}

double norm(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Returns the distance between the port position sent and the tool position received last [m], over up to 3 axes.
double distance_to_tool(const Seat& seat) noexcept {
  double square = 0;
  for (std::size_t a = 0; a < std::min<std::size_t>(seat.setup().dof, 3); ++a) {
    const double d = seat.force().port.x[a] - seat.sample().port.x[a];
    square += d * d;
  }
  return std::sqrt(square);
}

DatagramCounts sum(DatagramCounts counts, const transport::SecureChannelStats& link) noexcept {
  counts.sent += link.sent;
  counts.accepted += link.accepted;
  counts.late += link.late;
  for (const auto dropped : link.dropped) counts.refused += dropped;
  return counts;
}

}  // namespace

void SeatStatusRecorder::on_reconnect(Time now, const Seat& seat) noexcept {
  earlier_ = sum(earlier_, seat.link().stats());
  connected_ = now;
  ++status_.reconnects;
}

void SeatStatusRecorder::on_tick(Time now, const Seat& seat) noexcept {
  if (!connected_) connected_ = now;
  transfer_.update(seat.force());
  status_.force_peak_n = std::max(status_.force_peak_n, norm(seat.sample().telemetry.f_out));
}

const ClientStatus& SeatStatusRecorder::update(Time now, const Seat& seat) noexcept {
  const wire::ForceMessage& force = seat.force();
  const wire::StateMessage& sample = seat.sample();
  const wire::Telemetry& t = sample.telemetry;
  const transport::LinkTiming& timing = seat.link().timing();
  ClientStatus& s = status_;
  s.session = force.session;
  s.gate = sample.gate;
  s.heard = timing.heard();
  s.closed = seat.closed();
  s.close_reason = seat.close_reason();
  s.stops = force.stops;
  s.missing = force.missing;
  s.silence_s = seconds(timing.heard() ? timing.unanswered_for(now) : now - *connected_);
  // Without a running session the last value stays, e.g. after a server restart. So it does while the server is silent
  // or has ended: the session may have ended with it.
  if (const auto time = seat.clock().server_time(now); time && !s.closed && s.silence_s <= kPresentSilence)
    s.session_time = *time;
  s.alpha = seat.tools().authority();
  s.authority_version = force.authority_version;
  s.touching = force.touching;
  s.local_stop = seat.requests().locally_stopped();
  s.distance_m.reset();
  if (seat.setup().port == PortSpace::kTip && timing.heard()) s.distance_m = distance_to_tool(seat);
  const auto offset = offset_from_leader(seat, now);
  s.offset_from_leader_m = offset ? std::optional{offset->norm()} : std::nullopt;
  if (s.gate == wire::GateState::kActive && s.session == wire::SessionState::kRunning && !s.closed)
    s.engaged.add(s.alpha, s.offset_from_leader_m);
  s.transfer = transfer_.status();
  s.force_n = norm(t.f_out);
  s.x = t.x;
  s.link = {.rtt_ms = 1e3 * seconds(timing.rtt()),
            .rtt_p50_ms = 1e3 * seconds(timing.rtt_p50()),
            .rtt_p99_ms = 1e3 * seconds(timing.rtt_p99()),
            .down_loss_percent = t.down_loss_percent,
            .down_longest_gap_ms = t.down_longest_gap_ms,
            .down_age_p99_ms = t.down_age_p99_ms,
            .datagrams = sum(earlier_, seat.link().stats())};
  s.energy = {.in_j = sum_j(sample.port.e_in),
              .out_j = sum_j(t.e_out),
              .dissipated_j = t.dissipated_j,
              .refused_j = t.refused_j,
              .delivered_j = t.delivered_j,
              .margin_min_j = t.margin_min_j,
              .given_after_loss_max_j = seat.gate().tank().given_max()};
  s.gate_trips = sample.telemetry.gate_trips;
  const control::OvertemperatureGuard& guard = seat.guards().overtemperature();
  s.motors = {
      .hot = guard.hot(), .latched = guard.latched(), .hot_trips = guard.trips_total(), .heat_max = s.motors.heat_max};
  const std::optional<double>& heat = seat.device().reading().heat;
  if (heat && !(s.motors.heat_max >= heat)) s.motors.heat_max = heat;
  return s;
}

}  // namespace tandem::client
