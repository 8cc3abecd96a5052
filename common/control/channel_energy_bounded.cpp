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

void EnergyBoundedEnd::change_stiffness(std::size_t a, double k, double x, double weight) noexcept {
  const double e = state_.ref[a] - x;
  const double half_square = 0.5 * weight * e * e;
  const double dE = (k - state_.k[a]) * half_square;
  if (dE <= 0) {
    state_.absorbed[a] -= dE;
  } else if (ledger_[a].spend(dE)) {
    state_.paid[a] += dE;
  } else {
    return;  // not affordable now: k stays, and rises later
  }
  state_.k[a] = k;
}

void EnergyBoundedEnd::move_reference(std::size_t a, double wanted, double x, double weight) noexcept {
  const double stiffness = 0.5 * state_.k[a] * weight;
  const double before = state_.ref[a] - x;
  const double after = wanted - x;
  const double dE = stiffness * (after * after - before * before);
  if (!std::isfinite(dE)) return;  // a position that is not finite, or whose square overflows
  if (dE <= 0) {
    state_.absorbed[a] -= dE;
    state_.ref[a] = wanted;
    return;
  }
  if (ledger_[a].spend(dE)) {
    state_.paid[a] += dE;
    state_.ref[a] = wanted;
    return;
  }
  // Not affordable: the largest elongation that the whole margin pays, on the side of the target. One nanojoule is kept
  // back so that rounding can never overdraw.
  const double budget = std::max(0.0, ledger_[a].margin() - 1e-9);
  const double reach = stiffness > 0 ? std::sqrt(before * before + budget / stiffness) : 0;
  const double e = std::min(reach, std::abs(after));
  const double cost = std::max(0.0, stiffness * (e * e - before * before));
  refused_ += dE - cost;
  if (!ledger_[a].spend(cost)) return;
  state_.paid[a] += cost;
  state_.ref[a] = x + std::copysign(e, after);
}

}  // namespace tandem::control
