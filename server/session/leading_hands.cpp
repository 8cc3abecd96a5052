#include "server/session/leading_hands.h"

#include <algorithm>

namespace tandem::server {

namespace {
constexpr double kLeadingAuthorityMin = 1e-9;  // authority above which a hand leads
constexpr std::uint32_t kRecordInterval = 16;  // ticks between two steps, for laws that only record the leaders

/// @param number  of the master, from 1
/// @param tip     received tip position [m]
wire::Ghost ghost_of(const control::LeadingHand& hand, std::uint32_t number,
                     const std::array<double, 3>& tip) noexcept {
  wire::Ghost out{.leader = number};
  for (std::size_t a = 0; a < 3; ++a) {
    out.x[a] = static_cast<float>(hand.shown_x(a, tip[a]));
    out.v[a] = static_cast<float>(hand.shown_v(a));
  }
  return out;
}
}  // namespace

LeadingHands::LeadingHands(const SceneSpec& scene, double dt) noexcept
    : predicts_(scene.channel.law == LawKind::kReplica),
      masters_(scene.masters()),
      axes_(scene.port == PortSpace::kTip ? scene.dof : 0) {
  hands_.fill(control::LeadingHand(dt));
  for (std::size_t h = 0; h < masters_; ++h) motion_scale_[h] = scene.seats[h].motion_scale;
}

void LeadingHands::step(std::uint32_t tick, const std::array<bool, kSeatsMax>& present,
                        std::span<const SeatEndpoint> seats, std::span<const Tool> tools) noexcept {
  if (!predicts_ && tick % kRecordInterval != 0) return;
  for (std::size_t h = 0; h < masters_; ++h) {
    const auto leads = [&](const Tool& tool) { return tool.authority.alpha(h) > kLeadingAuthorityMin; };
    if (predicts_) {
      hands_[h].step(present[h] && std::ranges::any_of(tools, leads), seats[h].last_state().port, axes_,
                     seats[h].age());
    } else {
      hands_[h].set_present(present[h]);
    }
  }
  for (std::size_t i = 0; i < masters_; ++i) {
    const std::size_t leader = leader_of(i, tools[seats[i].coupled_tools().front()].authority);
    ghosts_[i] = {};
    if (leader >= masters_) continue;
    std::array<double, 3> tip = seats[leader].telemetry().x;
    for (double& x : tip) x *= motion_scale_[leader];
    ghosts_[i] = ghost_of(hands_[leader], static_cast<std::uint32_t>(leader + 1), tip);
  }
}

/// The present hand with the most authority over the tool that a seat follows, the first among equals. Returns
/// masters_ if no other hand has more authority than the seat itself.
std::size_t LeadingHands::leader_of(std::size_t i, const control::ToolAuthority& row) const noexcept {
  std::size_t leader = masters_;
  double most = std::max(kLeadingAuthorityMin, row.alpha(i));
  for (std::size_t h = 0; h < masters_; ++h)
    if (h != i && hands_[h].present() && row.alpha(h) > most) {
      leader = h;
      most = row.alpha(h);
    }
  return leader;
}

}  // namespace tandem::server
