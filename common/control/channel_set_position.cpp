#include "common/control/channel_set_position.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

SetPositionEnd::SetPositionEnd(const ChannelParams& params) : ChannelEnd(params) {
  for (std::size_t a = 0; a < params_.dof; ++a) {
    approach_[a] = params_.v_app / std::sqrt(params_.scale[a]);
    strongest_[a] = params_.effort_max * std::sqrt(params_.scale[a]);
  }
}

void SetPositionEnd::give_way(const AxisArray& x) noexcept {
  for (std::size_t a = 0; a < params_.dof; ++a) {
    const double reach = strongest_[a] / state_.k[a];
    const double leashed = std::clamp(state_.ref[a], x[a] - reach, x[a] + reach);
    if (std::isfinite(leashed)) state_.ref[a] = leashed;
    state_.absorbed[a] = state_.paid[a] = state_.passed[a] = 0;
  }
}

const EndState& SetPositionEnd::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);  // half a tick is sampling, there without a network too
  const double stiffness = schedule_.stiffness(), damping = schedule_.damping();
  for (std::size_t a = 0; a < params_.dof; ++a) {
    EnergyLedger& ledger = ledger_[a];
    const std::uint64_t heat = ledger.dissipate(in.dissipated[a]);
    ledger.receive(in.rx.e_in[a]);
    const auto most = static_cast<std::uint64_t>(in.pass_on * static_cast<double>(heat));
    state_.passed[a] = 1e-9 * static_cast<double>(ledger.give_up_above(params_.margin_max, most));
    state_.absorbed[a] = 0;
    state_.paid[a] = 0;
    state_.b[a] = damping * params_.scale[a];
    change_stiffness(a, stiffness * params_.scale[a], in.x[a], in.weight);

    // After an outage the reference may lie far away: it comes home at v_app, but motion itself is never clipped.
    const double step = (std::abs(in.rx.v[a]) + approach_[a]) * in.dt;
    const double t = target(in, a, state_.k[a]);
    const double wanted = std::clamp(t, state_.ref[a] - step, state_.ref[a] + step);
    // An elongation beyond the strongest motor would only be stored and come back as a kick; giving way frees energy.
    const double reach = strongest_[a] / state_.k[a];
    const double leashed = std::clamp(wanted, in.x[a] - reach, in.x[a] + reach);
    if (std::isfinite(leashed)) move_reference(a, leashed, in.x[a], in.weight);
    margin_min_ = std::min(margin_min_, ledger.margin());
  }
  return state_;
}

void SetPositionEnd::change_stiffness(std::size_t a, double k, double x, double weight) noexcept {
  const double e = state_.ref[a] - x;
  const double half_square = 0.5 * weight * e * e;
  const double dE = (k - state_.k[a]) * half_square;
  if (dE <= 0) {
    state_.absorbed[a] -= dE;
  } else if (ledger_[a].spend(dE)) {
    state_.paid[a] += dE;
  } else {
    return;  // too dear now: k stays, and rises later
  }
  state_.k[a] = k;
}

void SetPositionEnd::move_reference(std::size_t a, double wanted, double x, double weight) noexcept {
  const double stiffness = 0.5 * state_.k[a] * weight;
  const double before = state_.ref[a] - x;
  const double after = wanted - x;
  const double dE = stiffness * (after * after - before * before);
  if (!std::isfinite(dE)) return;  // a position that is no number, or whose square is none
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
  // Not affordable: the farthest elongation the whole margin buys, on the side of the target. One nanojoule is kept back so
  // that rounding can never overdraw.
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
