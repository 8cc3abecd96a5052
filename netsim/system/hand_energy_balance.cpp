#include "netsim/system/hand_energy_balance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tandem::netsim {

namespace {

constexpr double kWhole = 0.99;  // share of the wanted force at which the ramp is over

/// Returns the energy that an account paid, minus the energy that it took back [nJ].
std::int64_t net_spent(const control::ChannelEnd& end) noexcept {
  std::uint64_t sum = 0;  // modulo 2^64; differences stay correct
  for (std::size_t a = 0; a < end.dof(); ++a) {
    const control::EnergyLedger& ledger = end.ledger(a);
    sum += ledger.out_nj() + ledger.received_nj() - ledger.bound_nj();
  }
  return static_cast<std::int64_t>(sum);
}

/// Returns the energy [J] of a spring with stiffness `k_c` that wants a force of this square [N^2]. The norm of its
/// force is limited to `motor_max`.
double stored_in_spring(double wanted2, double k_c, double motor_max) noexcept {
  if (wanted2 <= motor_max * motor_max) return 0.5 * wanted2 / k_c;
  return motor_max * (std::sqrt(wanted2) - 0.5 * motor_max) / k_c;
}

}  // namespace

double HandEnergyBalance::excess(const Sample& sample) noexcept {
  const client::Seat& seat = *sample.seat;
  if (seat.coupling().tool_copy() == nullptr) return 0;
  const SeatSetup& setup = seat.setup();
  const wire::Telemetry& t = seat.sample().telemetry;
  const double k_c = setup.coupling.k_c, scale = setup.seat.motion_scale;  // both of the hand
  if (sample.program_restarted) known_ = active_ = false;

  double wanted2 = 0, given2 = 0, moved2 = 0;
  for (std::size_t a = 0; a < setup.dof; ++a) {
    wanted2 += t.f_cmd[a] * t.f_cmd[a];
    given2 += seat.effort()[a] * seat.effort()[a];
    moved2 += (t.x[a] - q_[a]) * (t.x[a] - q_[a]);
  }
  const bool whole = std::sqrt(given2) >= kWhole * std::min(sample.motor_max, std::sqrt(wanted2));
  const bool several = seat.tools().size() > 1,
             clipped = wanted2 > kWhole * kWhole * sample.motor_max * sample.motor_max;
  const bool active = seat.gate().phase() == control::GatePhase::kActive && (active_ || whole) && !(several && clipped);
  double stored = several ? 0 : stored_in_spring(wanted2, k_c, sample.motor_max);
  for (std::size_t k = 0; k < seat.tools().size(); ++k) {
    const control::VirtualTool& copy = *seat.coupling().tool_copy(k);
    const control::ChannelEnd& end = seat.tools().end(k);
    const double weight = k == 0 ? setup.weight : setup.further[k - 1].weight;
    const std::int64_t spent = net_spent(end), before = std::exchange(spent_nj_[k], spent);
    if (known_ && active && active_ && !sample.account_restarted)
      paid_ += weight * 1e-9 * static_cast<double>(spent - before);
    double copy_v2 = 0, to_others = 0, force2 = 0;
    for (std::size_t a = 0; a < end.dof(); ++a) {
      const double e = end.state().ref[a] - copy.x(a), f = seat.sent(k).f[a];
      copy_v2 += copy.v(a) * copy.v(a);
      to_others += 0.5 * end.state().k[a] * e * e;
      force2 += f * f;
    }
    if (several) stored += weight * 0.5 * force2 * scale * scale / k_c;
    stored += weight * (0.5 * copy.gains().m * copy_v2 + to_others + copy.surface_energy());
    if (active && active_) heat_lost_ += weight * (1 - setup.channel.eta) * copy.gains().b * copy_v2 / setup.tick_hz;
  }
  if (known_ && active_) {
    given_ += sample.motor_work - sample.unaccountable_work;
    sampled_ += 0.5 * k_c * moved2;
  }
  if (active && !active_) begun_ += stored;
  known_ = true;
  active_ = active;
  q_ = t.x;
  if (!active) return 0;
  return given_ + stored + heat_lost_ - paid_ - sampled_ - begun_;
}

}  // namespace tandem::netsim
