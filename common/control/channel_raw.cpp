#include "common/control/channel_raw.h"

#include <algorithm>

namespace tandem::control {

const EndState& RawEnd::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);  // for the report; this law does not use it
  for (std::size_t a = 0; a < params_.dof; ++a) {
    EnergyLedger& ledger = ledger_[a];
    ledger.dissipate(in.dissipated[a]);
    ledger.receive(in.rx.e_in[a]);
    const double k = params_.schedule.k * params_.scale[a];
    const double before = state_.ref[a] - in.x[a];
    const double after = in.rx.x[a] - in.x[a];
    const double dE = 0.5 * k * in.weight * (after * after - before * before);
    state_.k[a] = k;
    state_.b[a] = 0;
    state_.ref[a] = in.rx.x[a];
    state_.absorbed[a] = dE < 0 ? -dE : 0;
    state_.paid[a] = dE > 0 ? dE : 0;
    if (dE > 0) ledger.spend_unchecked(dE);
    margin_min_ = std::min(margin_min_, ledger.margin());
  }
  return state_;
}

}  // namespace tandem::control
