#include "common/control/channel.h"

#include "common/control/channel_raw.h"
#include "common/control/channel_replica.h"
#include "common/control/channel_set_position.h"

namespace tandem::control {

ChannelEnd::ChannelEnd(const ChannelParams& params)
    : params_(params), schedule_(params.schedule), margin_min_(params.e0) {
  ledger_.fill(EnergyLedger{params.e0, params.eta});
}

void ChannelEnd::engage(const AxisArray& x, double age) noexcept {
  schedule_.settle(age);
  state_ = EndState{};
  state_.ref = x;
  for (std::size_t a = 0; a < params_.dof; ++a) state_.k[a] = schedule_.stiffness() * params_.scale[a];
}

void ChannelEnd::clamp_reference(const AxisArray&) noexcept {}

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

std::unique_ptr<ChannelEnd> make_replica(const ChannelParams& p) {
  if (p.side == Side::kClient) return std::make_unique<ReplicaReference>(p);
  return std::make_unique<PredictedHand>(p);
}

constexpr ChannelLaw kLaws[] = {
    {"replica", "every client simulates the tool; only what others do crosses the network, paid from an energy ledger",
     make_replica},
    {"set_position",
     "positions both ways, every move paid from an energy ledger; stiffness, damping and lead follow the delay",
     make<SetPositionEnd>},
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
