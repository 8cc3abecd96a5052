#pragma once

#include "common/control/channel.h"

namespace tandem::control {

/// Baseline for comparison: the received position becomes the reference at once, at constant stiffness. The ledger only
/// observes.
class RawEnd final : public ChannelEnd {
 public:
  using ChannelEnd::ChannelEnd;
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Guarantees guarantees() const noexcept override { return {}; }
};

}  // namespace tandem::control
