#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/setup/send_pace.h"
#include "proto/wire/wire_messages.h"

namespace tandem::server {

/// Decides which ticks of the server have a FORCE for a seat, for seats with `send` in their setup. Targets of an
/// engaged seat obey `control::SendPace`. Everything else that a FORCE carries must not wait: session state,
/// engagement, authority, notices, and surfaces. After a change of any of these, kRepeats ticks have a FORCE, so that a
/// lost datagram delays it by one tick only.
class ForcePace {
 public:
  static constexpr std::uint32_t kRepeats = 10;  ///< ticks

  /// @pre setup.send.is_on()
  explicit ForcePace(const SeatSetup& setup);

  /// Whether a FORCE is due at this tick.
  /// @param tick      number of the server's tick; may skip numbers
  /// @param force     the message that would be sent
  /// @param further   its parts for the tools beyond the first
  /// @param engaged   the client is engaged and heard; else every tick has a FORCE
  /// @param pull      port sample of the newest STATE; its force decides the tolerance of positions
  [[nodiscard]] bool due(std::uint32_t tick, const wire::ForceMessage& force, std::span<const wire::ToolForce> further,
                         bool engaged, const PortSample& pull) noexcept TANDEM_REALTIME;
  /// Records that this message was sent at this tick.
  void sent(std::uint32_t tick, const wire::ForceMessage& force,
            std::span<const wire::ToolForce> further) noexcept TANDEM_REALTIME;
  /// The next FORCE is the first of a new connection.
  void restart() noexcept { pace_.restart(); }

 private:
  /// Whether anything but the targets differs from the last message.
  [[nodiscard]] bool changed(const wire::ForceMessage& force,
                             std::span<const wire::ToolForce> further) const noexcept TANDEM_REALTIME;
  [[nodiscard]] bool noticeable(std::uint32_t tick, std::size_t tool, const wire::ToolForce& force,
                                double pull) const noexcept TANDEM_REALTIME;

  std::size_t dof_;
  bool copies_;             ///< the client simulates its tools, and ignores the targets of a tool that it leads alone
  bool assists_;            ///< the ghost pulls the hand
  control::SendPace pace_;  ///< one sample per tool, and the ghost
  wire::ForceMessage last_{};
  std::vector<wire::ToolForce> further_;  ///< of the last message
  std::uint32_t changed_ = 0;             ///< tick of the last change
};

}  // namespace tandem::server
