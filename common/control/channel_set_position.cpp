#include "common/control/channel_set_position.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

const EndState& SetPositionEnd::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt),
                 in.dt);  // half a tick is sampling, which also exists without a network
  const double stiffness = schedule_.stiffness(), damping = schedule_.damping();
  // Force feed-forward is covered by the same energy bound: the ledger bounds every target, so targets may be mixed
  // freely.
  const double delay = schedule_.delay(), lead = schedule_.lead(in.age);
  const bool mix =
      params_.side == Side::kServer && params_.effort_half && delay >= GainSchedule::kShort && delay <= 0.25;
  const std::uint64_t most_kept = credit_nj(params_.margin_max);
  for (std::size_t a = 0; a < params_.dof; ++a) {
    EnergyLedger& ledger = ledger_[a];
    const std::uint64_t heat = ledger.dissipate(in.dissipated[a]);
    ledger.receive(in.rx.e_in[a]);
    state_.passed[a] = 0;
    if (ledger.margin_nj() > most_kept) {
      const auto most = static_cast<std::uint64_t>(unit_share(in.pass_on, 0) * static_cast<double>(heat));
      state_.passed[a] = 1e-9 * static_cast<double>(ledger.forfeit_above(params_.margin_max, most));
    }
    state_.absorbed[a] = 0;
    state_.paid[a] = 0;
    state_.b[a] = damping * params_.scale[a];
    change_stiffness(a, stiffness * params_.scale[a], in.x[a], in.weight);

    // After an outage the reference may be far away. It approaches at v_app, but motion itself is never clipped.
    const double step = (std::abs(in.rx.v[a]) + approach_[a]) * in.dt;
    const double ahead = in.rx.x[a] + lead * in.rx.v[a];
    const double target = mix ? 0.5 * ahead + 0.5 * (in.x[a] + in.rx.f[a] / state_.k[a]) : ahead;
    const double wanted = std::clamp(target, state_.ref[a] - step, state_.ref[a] + step);
    // An elongation beyond the strongest motor's force would only be stored and return as a kick. Yielding releases
    // energy.
    const double reach = effort_max_[a] / state_.k[a];
    const double clamped = std::clamp(wanted, in.x[a] - reach, in.x[a] + reach);
    if (std::isfinite(clamped)) move_reference(a, clamped, in.x[a], in.weight);
    note_margin(ledger);
  }
  return state_;
}

}  // namespace tandem::control
