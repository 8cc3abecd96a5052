#pragma once

#include "common/control/channel_energy_bounded.h"

namespace tandem::control {

/// Set-position modulation with an energy ledger (ARCHITECTURE.md, "Law `set_position`"; in the spirit of [Lee & Huang,
/// T-RO 26(2) 2010]). A received position is a target, and the reference moves as far towards it as the ledger pays.
/// The distance from x stays within the strongest motor's force divided by k: the reference yields to a hand that
/// pushes harder.
class SetPositionEnd final : public EnergyBoundedEnd {
 public:
  using EnergyBoundedEnd::EnergyBoundedEnd;
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Guarantees guarantees() const noexcept override { return {.ledger = true, .bounded_step = true}; }
};

}  // namespace tandem::control
