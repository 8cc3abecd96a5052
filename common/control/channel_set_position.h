#pragma once

#include "common/control/channel_paid.h"

namespace tandem::control {

/// Set-position modulation with an energy ledger (design notes, control 4; in the spirit of [Lee & Huang, T-RO 26(2) 2010]). A received
/// position is a target; the reference moves as far towards it as the ledger pays. It never stays farther from x than the strongest
/// motor's force over k: it gives way to a hand that pushes harder.
class SetPositionEnd final : public PaidEnd {
 public:
  using PaidEnd::PaidEnd;
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Promises promises() const noexcept override { return {.ledger = true, .bounded_step = true}; }
};

}  // namespace tandem::control
