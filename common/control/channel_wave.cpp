#include "common/control/channel_wave.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

void WaveEnd::engage(const AxisArray& x, double age) noexcept {
  EnergyBoundedEnd::engage(x, age);
  for (std::size_t a = 0; a < params_.dof; ++a) state_.k[a] = params_.schedule.k * params_.scale[a];
  out_ = {};
}

const EndState& WaveEnd::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);  // for the report; this law does not use it
  for (std::size_t a = 0; a < params_.dof; ++a) {
    EnergyLedger& ledger = ledger_[a];
    ledger.dissipate(in.dissipated[a]);
    ledger.receive(in.rx.e_in[a]);
    ledger.forfeit_above(params_.margin_max, 0);
    state_.absorbed[a] = state_.paid[a] = 0;
    const double k = state_.k[a] * in.weight, b = params_.impedance * params_.scale[a], x = in.x[a];
    const double per_square = b / (4 * in.dt);  // energy of a wave over its square
    const double distance = k * (state_.ref[a] - x);
    if (!std::isfinite(distance * distance)) continue;  // a near end that is not finite, or a square that overflows
    double arriving = in.rx.v[a] * in.dt;
    if (!std::isfinite(arriving)) arriving = 0;
    double cost = per_square * arriving * arriving;
    if (const double budget = std::max(0.0, ledger.margin() - 1e-9); cost > budget) {
      refused_ += cost - budget;
      arriving = std::copysign(std::sqrt(budget / per_square), arriving);
      cost = per_square * arriving * arriving;
    }
    if (!ledger.spend(cost)) arriving = cost = 0;
    state_.paid[a] = cost;
    // dr + k (r + dr - x) T / b = dy_in
    const double moved = (arriving - k * (state_.ref[a] - x) * in.dt / b) / (1 + k * in.dt / b);
    state_.ref[a] += moved;
    const double leaving = moved - k * (state_.ref[a] - x) * in.dt / b;
    state_.absorbed[a] = per_square * leaving * leaving;
    out_[a] = leaving / in.dt;
    const double step = approach_[a] * in.dt;
    // The goal is the reference of the other end: the two springs are in series.
    const double elongation = in.rx.f[a] / state_.k[a];
    const double goal = params_.side == Side::kClient ? in.rx.x[a] + elongation : in.rx.x[a] - elongation;
    const double wanted = std::clamp(goal, state_.ref[a] - step, state_.ref[a] + step);
    if (std::isfinite(wanted)) move_reference(a, wanted, x, in.weight);
    note_margin(ledger);
  }
  return state_;
}

void WaveEnd::replace_velocity(AxisArray& v) const noexcept {
  for (std::size_t a = 0; a < params_.dof; ++a) v[a] = out_[a];
}

}  // namespace tandem::control
