#include "common/control/channel_tdpa.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

void TdpaForceEnd::engage(const AxisArray& x, double age) noexcept {
  EnergyBoundedEnd::engage(x, age);
  last_x_ = x;
}

void TdpaForceEnd::clamp_reference(const AxisArray& x) noexcept {
  EnergyBoundedEnd::clamp_reference(x);
  last_x_ = x;
}

const EndState& TdpaForceEnd::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);  // half a tick is sampling
  const double damping = std::min(schedule_.stiffness() * schedule_.delay(), kDampingMax);
  for (std::size_t a = 0; a < params_.dof; ++a) {
    EnergyLedger& ledger = ledger_[a];
    const double k = params_.schedule.k * params_.scale[a], x = in.x[a], moved = x - last_x_[a];
    if (!std::isfinite(k * moved * moved)) {  // a near end that is not finite, or a square that overflows
      state_.absorbed[a] = state_.paid[a] = 0;
      continue;
    }
    last_x_[a] = x;
    const double work = k * (state_.ref[a] - x) * moved;
    state_.absorbed[a] = std::max(0.0, -work);
    state_.paid[a] = std::max(0.0, work);
    if (work > 0) ledger.spend_unchecked(work);  // within the margin, see the class
    // The step's loss in the spring, 1/2 k dx^2, is no heat here: the work is counted with the force at the step's end.
    ledger.dissipate(in.dissipated[a] - 0.5 * k * moved * moved);
    ledger.receive(in.rx.e_in[a]);
    ledger.forfeit_above(params_.margin_max, 0);
    state_.k[a] = k;
    const double margin = ledger.margin();
    const double reach = std::min(2 * std::sqrt(std::max(0.0, margin - 1e-9) / k), effort_max_[a] / k);
    const double wanted = -in.rx.f[a] / k + moved;  // at the end of a step like the last the force is the received one
    state_.ref[a] = std::isfinite(wanted) ? x + std::clamp(wanted, -reach, reach) : x;
    refused_ += std::isfinite(wanted) ? 0.25 * k * std::max(0.0, wanted * wanted - reach * reach) : 0;
    const double missing = std::max(0.0, 0.5 * params_.e0 - margin);
    const double controller = moved * moved > 0 ? missing * in.dt / (moved * moved) : 0;
    const double limited = std::min(controller, kDampingMax * params_.scale[a]);
    state_.b[a] = std::max(limited, damping * params_.scale[a]);
    note_margin(ledger);
  }
  return state_;
}

void TdpaPositionEnd::engage(const AxisArray& x, double age) noexcept {
  EnergyBoundedEnd::engage(x, age);
  for (std::size_t a = 0; a < params_.dof; ++a) state_.k[a] = params_.schedule.k * params_.scale[a];
  following_ = false;
}

const EndState& TdpaPositionEnd::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);  // half a tick is sampling
  if (!following_) last_rx_ = in.rx.x;
  following_ = true;
  for (std::size_t a = 0; a < params_.dof; ++a) {
    EnergyLedger& ledger = ledger_[a];
    ledger.dissipate(in.dissipated[a]);
    ledger.receive(in.rx.e_in[a]);
    ledger.forfeit_above(params_.margin_max, 0);
    state_.absorbed[a] = state_.paid[a] = 0;
    change_stiffness(a, schedule_.stiffness() * params_.scale[a], in.x[a], in.weight);
    const double drift = approach_[a] * in.dt, step = std::abs(in.rx.v[a]) * in.dt;
    const double received = std::clamp(in.rx.x[a] - last_rx_[a], -step, step);
    if (std::isfinite(received)) move_reference(a, state_.ref[a] + received, in.x[a], in.weight);
    last_rx_[a] = in.rx.x[a];
    const double home = std::clamp(in.rx.x[a], state_.ref[a] - drift, state_.ref[a] + drift);
    if (std::isfinite(home)) move_reference(a, home, in.x[a], in.weight);
    note_margin(ledger);
  }
  return state_;
}

}  // namespace tandem::control
