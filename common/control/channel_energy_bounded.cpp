#include "common/control/channel_energy_bounded.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

EnergyBoundedEnd::EnergyBoundedEnd(const ChannelParams& params) : ChannelEnd(params) {
  for (std::size_t a = 0; a < params_.dof; ++a) {
    approach_[a] = params_.v_app / std::sqrt(params_.scale[a]);
    effort_max_[a] = params_.effort_max * std::sqrt(params_.scale[a]);
  }
}

void EnergyBoundedEnd::clamp_reference(const AxisArray& x) noexcept {
  for (std::size_t a = 0; a < params_.dof; ++a) {
    const double reach = effort_max_[a] / state_.k[a];
    const double clamped = std::clamp(state_.ref[a], x[a] - reach, x[a] + reach);
    if (std::isfinite(clamped)) state_.ref[a] = clamped;
    state_.absorbed[a] = state_.paid[a] = state_.passed[a] = 0;
  }
}

void EnergyBoundedEnd::move_affordable_part(std::size_t a, double wanted, double x, double half_stiffness) noexcept {
  const double before = state_.ref[a] - x;
  const double after = wanted - x;
  const double dE = half_stiffness * (after * after - before * before);
  // On the side of the target. One nanojoule is kept back, so that rounding can never overdraw.
  const double budget = std::max(0.0, ledger_[a].margin() - 1e-9);
  const double reach = half_stiffness > 0 ? std::sqrt(before * before + budget / half_stiffness) : 0;
  const double e = std::min(reach, std::abs(after));
  const double cost = std::max(0.0, half_stiffness * (e * e - before * before));
  refused_ += dE - cost;
  if (!ledger_[a].spend(cost)) return;
  state_.paid[a] += cost;
  state_.ref[a] = x + std::copysign(e, after);
}

}  // namespace tandem::control
