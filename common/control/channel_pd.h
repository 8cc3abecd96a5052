#pragma once

#include "common/control/channel.h"

namespace tandem::control {

/// P+d control, scheduled by delay: the received position is the reference at once, and both ends add damping relative
/// to ground [Nuno, Ortega, Barabanov, Basanez, T-RO 24(3) 2008; Nuno et al., IJRR 28(7) 2009]. With equal stiffness k
/// and damping B at both ends and delays d_1 and d_2, the loop is passive if
///
///     4 B^2 > (d_1 + d_2)^2 k^2,        so B = kMargin k d with d = (d_1 + d_2) / 2
///
/// The schedule bounds k d, and with it B, by `schedule.k_delay`. The condition holds for delays that change slowly: a
/// held or reordered datagram breaks it, so this law promises no bound on energy. The ledger only observes.
class PdEnd final : public ChannelEnd {
 public:
  using ChannelEnd::ChannelEnd;
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Guarantees guarantees() const noexcept override { return {}; }

  static constexpr double kMargin = 1.1;  ///< damping over that of the condition
};

}  // namespace tandem::control
