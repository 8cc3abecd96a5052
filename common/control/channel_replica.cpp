#include "common/control/channel_replica.h"

#include <algorithm>
#include <cmath>

#include "common/control/hand_motion.h"

namespace tandem::control {

namespace {
/// Damping between reference and copy beside the relative one, where hands share, as a part of k d.
constexpr double kSharedDamping = 0.5;
}  // namespace

ReplicaReference::ReplicaReference(const ChannelParams& params) : PaidEnd(params), k_x_(params.k_c) {}

double ReplicaReference::stiffness_for(double authority, double delay) const noexcept {
  const double shared = delay > 0 ? std::min(params_.k_c, kKappa / (2 * delay)) : params_.k_c;
  return shared + (params_.k_c - shared) * std::max(0.0, 1 - authority / kFollows);
}

void ReplicaReference::engage(const AxisArray& x, double age) noexcept {
  ChannelEnd::engage(x, age);
  k_x_ = stiffness_for(1, schedule_.delay());
  for (std::size_t a = 0; a < params_.dof; ++a) state_.k[a] = calm_v_[a] = 0;
}

const EndState& ReplicaReference::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);
  const double d = schedule_.delay(), alone = 1 - std::clamp(in.authority, 0.0, 1.0);
  const double wanted = stiffness_for(in.authority, d);
  k_x_ += std::clamp(wanted - k_x_, -params_.schedule.k_fall * in.dt, params_.schedule.k_rise * in.dt);
  const bool follows = in.authority < 1e-3;
  const double calm = follows ? Prediction::calm_part(in.dt) : 1;
  const double shared_damping = follows ? 0 : kSharedDamping * alone * k_x_ * d;
  const double slave = std::clamp(in.slave_pull, 0.0, 1.0) * params_.k_c;
  const double damping = alone * params_.b_rel * k_x_ / params_.k_c + shared_damping + kSharedDamping * slave * d;
  for (std::size_t a = 0; a < params_.dof; ++a) {
    EnergyLedger& ledger = ledger_[a];
    ledger.dissipate(in.dissipated[a]);
    ledger.receive(in.rx.e_in[a]);
    static_cast<void>(ledger.give_up_above(params_.margin_max, 0));
    state_.absorbed[a] = state_.paid[a] = state_.passed[a] = 0;
    state_.b[a] = damping * params_.scale[a];
    state_.rate[a] = in.rx.v[a];
    change_stiffness(a, (alone * k_x_ + slave) * params_.scale[a], in.x[a], 1);

    calm_v_[a] += calm * (in.rx.v[a] - calm_v_[a]);
    const double target = follows ? Prediction::place_for_hand(in.rx.x[a], calm_v_[a], in.age) : in.rx.x[a];
    const double step = (std::abs(in.rx.v[a]) + approach_[a]) * in.dt;
    const double reach = 2 * strongest_[a] / (slave > 0 ? (alone * k_x_ + slave) * params_.scale[a] : k_x_ * params_.scale[a]);
    const double leashed = std::clamp(std::clamp(target, state_.ref[a] - step, state_.ref[a] + step), in.x[a] - reach, in.x[a] + reach);
    if (std::isfinite(leashed)) move_reference(a, leashed, in.x[a], 1);
    ledger.take_back(state_.absorbed[a]);  // what a spring to the reference gives back is this end's to spend again
    margin_min_ = std::min(margin_min_, ledger.margin());
  }
  return state_;
}

PredictedHand::PredictedHand(const ChannelParams& params) : ChannelEnd(params) {
  for (std::size_t a = 0; a < params_.dof; ++a) state_.k[a] = params_.k_c * params_.scale[a];
}

void PredictedHand::engage(const AxisArray& x, double age) noexcept {
  ChannelEnd::engage(x, age);
  for (std::size_t a = 0; a < params_.dof; ++a) state_.k[a] = params_.k_c * params_.scale[a];
}

void PredictedHand::give_way(const AxisArray& x) noexcept {
  for (std::size_t a = 0; a < params_.dof; ++a) {
    const double reach = params_.effort_max * std::sqrt(params_.scale[a]) / state_.k[a];
    const double leashed = std::clamp(state_.ref[a], x[a] - reach, x[a] + reach);
    if (std::isfinite(leashed)) state_.ref[a] = leashed;
    state_.b[a] = state_.rate[a] = 0;
  }
}

const EndState& PredictedHand::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);
  for (std::size_t a = 0; a < params_.dof; ++a) {
    const HandMotion heard{in.rx.x[a], in.rx.v[a], in.rx.a[a]};
    const double rate = Prediction::rate(heard, in.age);
    const double step = (std::max(std::abs(rate), std::abs(in.rx.v[a])) + Prediction::kApproach / std::sqrt(params_.scale[a])) * in.dt;
    const double reach = params_.effort_max * std::sqrt(params_.scale[a]) / state_.k[a];
    const double near = std::clamp(Prediction::place(heard, in.age), state_.ref[a] - step, state_.ref[a] + step);
    const double leashed = std::clamp(near, in.x[a] - reach, in.x[a] + reach);
    if (std::isfinite(leashed)) state_.ref[a] = leashed;
    state_.rate[a] = std::isfinite(rate) ? rate : 0;
    state_.b[a] = params_.b_rel * params_.scale[a];
    ledger_[a].receive(in.rx.e_in[a]);
  }
  return state_;
}

}  // namespace tandem::control
