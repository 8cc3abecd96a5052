#include <algorithm>

#include "server/session/session.h"

/// Which hand leads each seat, and its motion: for display, records and the pull of `assist`. Laws other than
/// `replica` send it to no client; their records contain the received position.
namespace tandem::server {

namespace {
constexpr double kLeadingAuthorityMin = 1e-9;  // authority above which a hand leads
}

void Session::update_leaders() noexcept {
  const std::size_t axes = scene_->port == PortSpace::kTip ? scene_->dof : 0;
  for (std::size_t h = 0; h < masters_; ++h) {
    if (replica_) {
      leading_hands_[h].step(present_[h] && leads(h), seats_[h].last_state().port, axes, seats_[h].age());
    } else {
      leading_hands_[h].set_present(present_[h]);
    }
  }
  for (std::size_t i = 0; i < masters_; ++i) {
    const std::size_t leader = leader_of(i);
    ghosts_[i] = leader < masters_ ? leading_hands_[leader].ghost(static_cast<std::uint32_t>(leader + 1),
                                                                  seats_[leader].last_state().telemetry.x)
                                   : wire::Ghost{};
  }
}

bool Session::leads(std::size_t master) const noexcept {
  return std::ranges::any_of(tools_,
                             [&](const Tool& tool) { return tool.authority.alpha(master) > kLeadingAuthorityMin; });
}

/// The present hand with the most authority over the tool that a seat follows, the first among equals. Returns
/// masters_ if no other hand has more authority than the seat itself.
std::size_t Session::leader_of(std::size_t i) const noexcept {
  const control::ToolAuthority& row = tools_[first_tool(i)].authority;
  std::size_t leader = masters_;
  double most = std::max(kLeadingAuthorityMin, row.alpha(i));
  for (std::size_t h = 0; h < masters_; ++h)
    if (h != i && leading_hands_[h].present() && row.alpha(h) > most) {
      leader = h;
      most = row.alpha(h);
    }
  return leader;
}

}  // namespace tandem::server
