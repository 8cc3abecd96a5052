#include "server/session/session_invariant_checker.h"

#include <cmath>

namespace tandem::server {

std::string_view mfs_name(MfsMode mode) noexcept {
  switch (mode) {
    case MfsMode::kOpen:
      return "open";
    case MfsMode::kTank:
      return "tank";
    case MfsMode::kSeed:
      return "seed";
    case MfsMode::kSeedSigned:
      return "seed_signed";
  }
  return "";
}

void SessionInvariantChecker::check(const Session& session, Violations& out) {
  const SceneSpec& scene = session.scene();
  const double t = session.clock().time();
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    const Tool& tool = session.tool(j);
    double sum = 0;
    bool in_range = true;
    for (std::size_t i = 0; i < scene.masters(); ++i) {
      const double alpha = tool.authority.alpha(i);
      sum += alpha;
      in_range = in_range && alpha >= 0 && alpha <= 1;
    }
    const bool whole = tool.authority.held() ? sum == 0 : std::abs(sum - 1) <= 1e-12;
    if (!whole || !in_range) out.add("authority_sum", scene.tools[j].name, t, false);
    if (tool.not_finite() > 0) out.add("finite", scene.tools[j].name, t, false);
    for (std::size_t a = 0; a < scene.dof; ++a)
      if (!std::isfinite(tool.x(a))) out.add("finite", scene.tools[j].name, t, false);
  }
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const SeatEndpoint& seat = session.seat(i);
    for (std::size_t k = 0; k < seat.ends(); ++k)
      for (std::size_t a = 0; a < scene.dof; ++a)
        if (!seat.end(k).ledger(a).holds()) out.add("ledger", scene.seats[i].name, t, !seat.end(k).guarantees().ledger);
    if (seat.energy_fell()) out.add("energy_monotone", scene.seats[i].name, t, false);
  }
}

}  // namespace tandem::server
