#include "netsim/system/channel_end_checker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tandem::netsim {
namespace {

/// Speed that a prediction may add [m/s]: a user accelerates by at most 0.35 m/s^2 over the longest prediction of 265
/// ms. A tool moves to a better prediction by at most 150 mm/s where a scene's approach speed is less.
constexpr double kFollowerSpeedGain = 0.35 * 0.265 + 0.15;
/// Speed by which a follower's tool may exceed the others while they accelerate [m/s].
constexpr double kFollowGainsSpeed = 0.04;

/// Returns the position that the server's end of a seat's spring is coupled to: the tool, or a slave's target.
AxisArray coupled_position(const ObservedSeat& seat, std::size_t tool) noexcept {
  const server::Tool& coupled = seat.session.tool(tool);
  AxisArray x = coupled.position();
  for (std::size_t a = 0; seat.slave() && a < seat.scene.dof; ++a)
    x[a] = coupled.port().slave_goal(a, seat.endpoint().end().state().k[a]);
  return x;
}

/// Returns hand minus tool where one seat moves the tool. Otherwise returns 0, and checks that need the offset are
/// skipped.
AxisArray offset_of(const ObservedSeat& seat) noexcept {
  AxisArray offset{};
  if (seat.master_of_law_replica() || (!seat.slave() && seat.scene.tools.size() != 1)) return offset;
  const AxisArray x = coupled_position(seat, seat.slave() ? seat.spec().tool : 0);
  for (std::size_t a = 0; a < seat.scene.dof; ++a) offset[a] = seat.endpoint().tx.port.x[a] - x[a];
  return offset;
}

}  // namespace

void ChannelEndChecker::check(const ObservedSeat& seat, const Sample& sample) {
  const control::EndState& state = sample.end.state();
  const control::Guarantees guarantees = sample.end.guarantees();
  const AxisArray x_before = std::exchange(x_, sample.x), ref_before = std::exchange(ref_, state.ref);
  const EnergyArray in_before = in_, received_before = received_;
  const AxisArray coupled = sample.coupled.value_or(x_before);
  const bool comparable = std::exchange(known_, true) && sample.steady;
  for (std::size_t a = 0; a < seat.scene.dof; ++a) {
    const control::EnergyLedger& ledger = sample.end.ledger(a);
    in_[a] = ledger.in_nj();
    received_[a] = ledger.received_nj();
    if (!ledger.holds()) seat.violated("ledger", !guarantees.ledger);
    if (!comparable) continue;
    const bool new_account = in_[a] == 0 && received_[a] == 0;  // a client took the seat
    if (!new_account && (in_[a] < in_before[a] || received_[a] < received_before[a]))
      seat.violated("energy_monotone", !guarantees.ledger);
    const double was = std::abs(ref_before[a] - coupled[a]), is = std::abs(ref_[a] - coupled[a]);
    const double step =
        (std::abs(sample.received.v[a]) + sample.gains_speed + seat.scene.channel.v_app / std::sqrt(sample.scale[a])) *
        seat.tick();
    const bool rested = ref_[a] == x_[a] || ref_[a] == x_before[a];  // engaged again, without elongation
    if (is > was && !rested && std::abs(ref_[a] - ref_before[a]) > step * (1 + 1e-9) + 1e-12)
      seat.violated("approach", !guarantees.bounded_step);
  }
  if (seat.ordinary_motion && comparable) {
    starvation_.check(seat, {sample.end, sample.scale, sample.received, x_, coupled, ref_before, sample.offset});
  } else {
    starvation_.skip();
  }
}

void SeatEndsChecker::check_server(const ObservedSeat& seat) {
  const server::SeatEndpoint& endpoint = seat.endpoint();
  const client::Seat* const core = seat.client.seat();
  const AxisArray scale = core != nullptr ? core->setup().axis_scale : AxisArray{1, 1, 1, 1, 1, 1, 1};
  const AxisArray offset = offset_of(seat);
  for (std::size_t k = 0; k < endpoint.ends(); ++k) {
    const std::size_t tool = seat.slave() ? seat.spec().tool : k;
    PortSample received = endpoint.last_sample(tool);
    for (std::size_t a = 0; a < seat.scene.dof; ++a) received.x[a] -= offset[a];  // as the tool receives it
    server_[k].check(seat, {.end = endpoint.end(tool),
                            .scale = scale,
                            .received = received,
                            .x = coupled_position(seat, tool),
                            .coupled = {},
                            .offset = offset,
                            .steady = core != nullptr,
                            .gains_speed = seat.master_of_law_replica() ? kFollowerSpeedGain : 0});
  }
}

void SeatEndsChecker::check_client(const ObservedSeat& seat) {
  const client::Seat& core = seat.core();
  const AxisArray offset = offset_of(seat);
  for (std::size_t k = 0; k < core.tools().size(); ++k) {
    AxisArray x = core.sent(k).x;
    const control::VirtualTool* const copy = core.coupling().tool_copy(k);
    const control::EndState& state = core.tools().end(k).state();
    for (std::size_t a = 0; a < seat.scene.dof; ++a) {
      if (copy != nullptr) {
        x[a] = copy->x(a);
      } else if (core.gate().active() && state.k[a] > 0) {
        x[a] += core.separation().force()[a] / state.k[a];  // force separation shifts the sample, not the end
      }
    }
    client_[k].check(seat, {.end = core.tools().end(k),
                            .scale = core.setup().axis_scale,
                            .received = core.tools().received(k).port,
                            .x = x,
                            .coupled = seat.slave() ? std::optional{x} : std::nullopt,
                            .offset = offset,
                            .steady = seat.was_active && core.gate().active(),
                            .gains_speed = seat.master_of_law_replica() ? kFollowGainsSpeed : 0});
  }
}

void SeatEndsChecker::skip_server() noexcept {
  for (ChannelEndChecker& end : server_) end.skip();
}

void SeatEndsChecker::skip_client() noexcept {
  for (ChannelEndChecker& end : client_) end.skip();
}

}  // namespace tandem::netsim
