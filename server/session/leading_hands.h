#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/control/leading_hand.h"
#include "proto/spec/scene_spec.h"
#include "server/session/seat_endpoint.h"
#include "server/session/tool.h"

namespace tandem::server {

/// The hand that leads each master's seat, and that hand's motion: for display, records and the pull of `assist`. Laws
/// other than `replica` send it to no client; their records contain the received position.
class LeadingHands {
 public:
  /// @param dt  tick [s]
  LeadingHands(const SceneSpec& scene, double dt) noexcept;

  /// False if no hand can lead another: there is nothing to update then.
  [[nodiscard]] bool any() const noexcept { return masters_ > 1; }
  /// Updates hands and leaders; under laws that only record them, every 16th tick only.
  /// @param present  seats whose springs may act on tools
  void step(std::uint32_t tick, const std::array<bool, kSeatsMax>& present, std::span<const SeatEndpoint> seats,
            std::span<const Tool> tools) noexcept TANDEM_REALTIME;

  /// The hand that leads this seat, as of the last step; its `leader` is 0 if there is none. @pre a master's seat
  [[nodiscard]] const wire::Ghost& ghost(std::size_t master) const noexcept { return ghosts_[master]; }
  /// A master's hand, as of the last step.
  [[nodiscard]] const control::LeadingHand& operator[](std::size_t master) const noexcept { return hands_[master]; }

 private:
  [[nodiscard]] std::size_t leader_of(std::size_t seat, const control::ToolAuthority& row) const noexcept;

  bool predicts_;  ///< law `replica`
  std::size_t masters_, axes_;
  std::array<double, kMastersMax> motion_scale_{};  ///< of each hand
  std::array<control::LeadingHand, kMastersMax> hands_{};
  std::array<wire::Ghost, kMastersMax> ghosts_{};
};

}  // namespace tandem::server
