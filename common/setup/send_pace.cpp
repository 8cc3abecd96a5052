#include "common/setup/send_pace.h"

#include <algorithm>
#include <cmath>

namespace tandem::setup {

namespace {
/// Part of the initial energy of a ledger that the other end may not know about yet. A follower that is guided with 1 N
/// at 0.1 m/s gains it in about 50 ms.
constexpr double kEnergyPart = 0.1;
constexpr double kRounding = 1e-9;  // of a quotient that is meant to be an integer

double ticks_between(const SeatSetup& setup) noexcept {
  return setup.send.rate > 0 ? std::max(1.0, std::ceil(setup.tick_hz / setup.send.rate - kRounding)) : 1;
}
double heartbeat_ticks(const SeatSetup& setup) noexcept {
  const double between = ticks_between(setup);
  return setup.send.dead_band ? std::max(between, std::floor(setup.send.heartbeat * setup.tick_hz + kRounding))
                              : between;
}
}  // namespace

control::SendPace::Params send_pace(const SeatSetup& setup, control::Side sender) noexcept {
  const bool replica = setup.channel.law == LawKind::kReplica;
  const double s = setup.seat.motion_scale;  // x_tool = s x_hand, F_tool = F_hand / s
  control::SendPace::Params p;
  p.dof = setup.dof;
  p.dt = 1 / setup.tick_hz;
  p.interval = static_cast<std::uint32_t>(ticks_between(setup));
  p.heartbeat = static_cast<std::uint32_t>(heartbeat_ticks(setup));
  p.order = setup.send.prediction_order;
  p.dead_band = setup.send.dead_band.has_value();
  const DeadBandSpec band = setup.send.dead_band.value_or(DeadBandSpec{});
  p.weber = band.weber;
  p.velocity_floor = band.velocity_floor * s;
  p.force_floor = band.force_floor / s;
  p.stiffness = (replica ? setup.coupling.k_c : setup.channel.k) / (s * s);
  p.energy = static_cast<std::uint64_t>(1e9 * kEnergyPart * std::max(0.0, setup.channel.e0));
  // Under law `replica` only a tank of the flow sources uses the forces of hands.
  p.force_acts = !replica || (sender == control::Side::kClient && setup.channel.mfs != MfsMode::kOpen);
  p.force_is_place = replica && sender == control::Side::kServer;
  return p;
}

control::HeldSample held_sample(const SeatSetup& setup) noexcept {
  if (!setup.send.is_on()) return control::HeldSample{};
  return control::HeldSample{heartbeat_ticks(setup) / setup.tick_hz, setup.send.prediction_order};
}

}  // namespace tandem::setup
