#include "common/control/channel.h"

#include <algorithm>
#include <cmath>

#include "common/control/channel_pd.h"
#include "common/control/channel_raw.h"
#include "common/control/channel_replica.h"
#include "common/control/channel_set_position.h"
#include "common/control/channel_tdpa.h"
#include "common/control/channel_wave.h"

namespace tandem::control {

ChannelEnd::ChannelEnd(const ChannelParams& params)
    : params_(params), schedule_(params.schedule), margin_min_nj_(credit_nj(params.e0)) {
  ledger_.fill(EnergyLedger{params.e0, params.eta});
}

void ChannelEnd::engage(const AxisArray& x, double age) noexcept {
  schedule_.settle(age);
  state_ = EndState{};
  state_.ref = x;
  for (std::size_t a = 0; a < params_.dof; ++a) state_.k[a] = schedule_.stiffness() * params_.scale[a];
}

void ChannelEnd::clamp_reference(const AxisArray&) noexcept {}

void ChannelEnd::replace_velocity(AxisArray&) const noexcept {}

void ChannelEnd::follow_unpaid(const EndInput& in, std::size_t a, double k) noexcept {
  EnergyLedger& ledger = ledger_[a];
  ledger.dissipate(in.dissipated[a]);
  ledger.receive(in.rx.e_in[a]);
  const double before = state_.ref[a] - in.x[a];
  const double wanted = std::isfinite(in.rx.x[a]) ? in.rx.x[a] : state_.ref[a];
  const double after = wanted - in.x[a];
  const double dE = 0.5 * in.weight * (k * after * after - state_.k[a] * before * before);
  state_.absorbed[a] = state_.paid[a] = 0;
  if (!std::isfinite(dE)) return;  // a near end that is not finite, or a square that overflows
  state_.k[a] = k;
  state_.ref[a] = wanted;
  state_.absorbed[a] = dE < 0 ? -dE : 0;
  state_.paid[a] = dE > 0 ? dE : 0;
  if (dE > 0) ledger.spend_unchecked(dE);
  note_margin(ledger);
}

EnergyArray ChannelEnd::e_out() const noexcept {
  EnergyArray e{};
  for (std::size_t a = 0; a < params_.dof; ++a) e[a] = ledger_[a].out_nj();
  return e;
}

namespace {

template <class Law>
std::unique_ptr<ChannelEnd> make(const ChannelParams& p) {
  return std::make_unique<Law>(p);
}

template <class Client, class Server>
std::unique_ptr<ChannelEnd> make_pair(const ChannelParams& p) {
  if (p.side == Side::kClient) return std::make_unique<Client>(p);
  return std::make_unique<Server>(p);
}

constexpr ChannelLaw kLaws[] = {
    {"replica", "every client simulates the tool; only what others do crosses the network, paid from an energy ledger",
     make_pair<ReplicaReference, PredictedHand>},
    {"set_position",
     "positions both ways, every move paid from an energy ledger; stiffness, damping and lead follow the delay",
     make<SetPositionEnd>},
    {"tdpa",
     "two-port time-domain passivity: force down, position up, with passivity controllers and drift compensation",
     make_pair<TdpaForceEnd, TdpaPositionEnd>},
    {"wave",
     "wave variables of constant impedance, with position correction; a wave acts only as far as it is paid for",
     make<WaveEnd>},
    {"pd", "positions both ways, stiffness and damping follow the delay (P+d); passive for slowly varying delays only",
     make<PdEnd>},
    {"raw", "positions both ways, constant stiffness, no passivity: for comparison only", make<RawEnd>},
};

}  // namespace

std::span<const ChannelLaw> channel_laws() noexcept { return kLaws; }

std::unique_ptr<ChannelEnd> make_channel_end(std::string_view law, const ChannelParams& params) {
  for (const ChannelLaw& l : kLaws)
    if (l.name == law) return l.make(params);
  return nullptr;
}

}  // namespace tandem::control
