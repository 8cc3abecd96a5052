#include <algorithm>

#include "server/session.h"

/// Which hand leads each seat, and where it is: for screens, records, and the pull of `assist`. Laws other than `replica` tell nobody, and keep where it was
/// in records.
namespace tandem::server {

namespace {
constexpr double kLeads = 1e-9;  // authority above which a hand leads
}

void Session::see_leaders() noexcept {
  const std::size_t axes = scene_->port == PortSpace::kTip ? scene_->dof : 0;
  for (std::size_t h = 0; h < masters_; ++h) {
    if (replica_) {
      leading_[h].step(present_[h] && leads(h), seats_[h].heard().port, axes, seats_[h].age());
    } else {
      leading_[h].stand(present_[h]);
    }
  }
  for (std::size_t i = 0; i < masters_; ++i) {
    const std::size_t leader = leader_of(i);
    ghost_[i] = leader < masters_ ? leading_[leader].ghost(static_cast<std::uint32_t>(leader + 1), seats_[leader].heard().telemetry.x) : wire::Ghost{};
  }
}

bool Session::leads(std::size_t master) const noexcept {
  return std::ranges::any_of(tools_, [&](const Tool& tool) { return tool.authority.alpha(master) > kLeads; });
}

/// The present hand with most authority over the tool that a seat follows, the first of equals; masters_ where no other has more than the seat itself.
std::size_t Session::leader_of(std::size_t i) const noexcept {
  const control::AuthorityRow& row = tools_[first_tool(i)].authority;
  std::size_t leader = masters_;
  double most = std::max(kLeads, row.alpha(i));
  for (std::size_t h = 0; h < masters_; ++h)
    if (h != i && leading_[h].present() && row.alpha(h) > most) {
      leader = h;
      most = row.alpha(h);
    }
  return leader;
}

}  // namespace tandem::server
