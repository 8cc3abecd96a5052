#include "common/control/channel_replica.h"

#include <algorithm>
#include <cmath>

#include "common/control/hand_motion.h"

namespace tandem::control {

namespace {
/// Damping between reference and copy where hands share authority, in addition to the relative damping, as a part of k
/// d.
constexpr double kSharedDamping = 0.5;
/// Additional prediction time of a following hand, as a part of the leading hand's sample age. The follower then
/// receives about the velocity that the leading hand has when the datagram reaches it. With kFurther, kFollowDamping,
/// kFollowerSpeedGain and the slower pole beyond 130 ms, a relaxed follower lags 9.9 mm at 100 ms (0.5 Hz, 20 hands).
/// Its force then steps by 0.146 N per ms at 200 ms. Without them the values are 10.3 mm and 0.161.
constexpr double kFurther = 0.4;
/// Damping of a follower's copy towards the velocity of the other hands, as a part of b_rel.
constexpr double kFollowDamping = 1.25;
/// Largest velocity of the others that counts [m/s or rad/s]; no hand is faster. A filter would remember a larger one.
constexpr double kHeardMax = 100;
}  // namespace

ReplicaReference::ReplicaReference(const ChannelParams& params) : EnergyBoundedEnd(params), k_x_(params.k_c) {}

double ReplicaReference::stiffness_for(double authority, double delay) const noexcept {
  const double shared = delay > 0 ? std::min(params_.k_c, params_.kappa / (2 * delay)) : params_.k_c;
  return shared + (params_.k_c - shared) * std::max(0.0, 1 - authority / kFollows);
}

void ReplicaReference::engage(const AxisArray& x, double age) noexcept {
  ChannelEnd::engage(x, age);
  k_x_ = stiffness_for(1, schedule_.delay());
  for (std::size_t a = 0; a < params_.dof; ++a) state_.k[a] = calm_v_[a] = 0;
}

const EndState& ReplicaReference::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);
  const double d = schedule_.delay(), own = unit_share(in.authority, 1), alone = 1 - own;
  const double wanted = stiffness_for(own, d);
  k_x_ += std::clamp(wanted - k_x_, -params_.schedule.k_fall * in.dt, params_.schedule.k_rise * in.dt);
  const bool follows = own < 1e-3;
  const double calm = follows ? Prediction::calm_part(in.dt, in.age) : 1;
  const double shared_damping = follows ? 0 : kSharedDamping * alone * k_x_ * d;
  const double slave = unit_share(in.slave_pull, 0) * params_.k_c;
  const double relative = (follows ? kFollowDamping : 1) * params_.b_rel;
  const double damping = alone * relative * k_x_ / params_.k_c + shared_damping + kSharedDamping * slave * d;
  for (std::size_t a = 0; a < params_.dof; ++a) {
    EnergyLedger& ledger = ledger_[a];
    ledger.dissipate(in.dissipated[a]);
    ledger.receive(in.rx.e_in[a]);
    static_cast<void>(ledger.forfeit_above(params_.margin_max, 0));
    state_.absorbed[a] = state_.paid[a] = state_.passed[a] = 0;
    state_.b[a] = damping * params_.scale[a];
    const double heard = std::isfinite(in.rx.v[a]) ? std::clamp(in.rx.v[a], -kHeardMax, kHeardMax) : 0;
    state_.rate[a] = heard;
    change_stiffness(a, (alone * k_x_ + slave) * params_.scale[a], in.x[a], 1);

    calm_v_[a] += calm * (heard - calm_v_[a]);
    const double target = follows ? Prediction::place_for_hand(in.rx.x[a], calm_v_[a], in.age) : in.rx.x[a];
    const double gains = follows ? kFollowerSpeedGain / std::sqrt(params_.scale[a]) : 0;
    const double step = (std::abs(heard) + approach_[a] + gains) * in.dt;
    const double reach =
        2 * effort_max_[a] / (slave > 0 ? (alone * k_x_ + slave) * params_.scale[a] : k_x_ * params_.scale[a]);
    const double clamped =
        std::clamp(std::clamp(target, state_.ref[a] - step, state_.ref[a] + step), in.x[a] - reach, in.x[a] + reach);
    if (std::isfinite(clamped)) move_reference(a, clamped, in.x[a], 1);
    ledger.refund(state_.absorbed[a]);  // this end may spend again the energy that a spring to the reference returns
    note_margin(ledger);
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

void PredictedHand::clamp_reference(const AxisArray& x) noexcept {
  for (std::size_t a = 0; a < params_.dof; ++a) {
    const double reach = params_.effort_max * std::sqrt(params_.scale[a]) / state_.k[a];
    const double clamped = std::clamp(state_.ref[a], x[a] - reach, x[a] + reach);
    if (std::isfinite(clamped)) state_.ref[a] = clamped;
    state_.b[a] = state_.rate[a] = state_.led[a] = 0;
  }
}

const EndState& PredictedHand::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);
  for (std::size_t a = 0; a < params_.dof; ++a) {
    const HandMotion heard{in.rx.x[a], in.rx.v[a], in.rx.a[a]};
    const double rate = Prediction::rate(heard, in.age);
    const double place = Prediction::place(heard, in.age), before = state_.ref[a];
    const bool back = (before - place) * heard.v > 0;  // the earlier prediction was farther ahead
    const double approach = (Prediction::kApproach + (back ? Prediction::kBackBy : 0)) / std::sqrt(params_.scale[a]);
    const double step = (std::max(std::abs(rate), std::abs(in.rx.v[a])) + approach) * in.dt;
    const double reach = params_.effort_max * std::sqrt(params_.scale[a]) / state_.k[a];
    const double near = std::clamp(place, before - step, before + step);
    const double clamped = std::clamp(near, in.x[a] - reach, in.x[a] + reach);
    if (std::isfinite(clamped)) state_.ref[a] = clamped;
    // The damper uses the velocity of the reference. The hand's filtered velocity lags, and a tool that receives a stop
    // late overshoots.
    state_.rate[a] = (state_.ref[a] - before) / in.dt;
    const double led = Prediction::rate(heard, (1 + kFurther) * in.age);
    state_.led[a] = std::isfinite(led) ? led : 0;
    state_.b[a] = params_.b_rel * params_.scale[a];
    ledger_[a].receive(in.rx.e_in[a]);
  }
  return state_;
}

}  // namespace tandem::control
