#include "netsim/system/authority_checker.h"

#include <algorithm>
#include <cmath>

#include "netsim/system/role_checker.h"

namespace tandem::netsim {
namespace {

// Limits of authority (security 2.4). The checker has its own copy: a checker that read them from the server would
// follow the server's errors.
constexpr double kLossSlew = 10;      // [1/s] when a seat with authority is lost
constexpr double kStoppedMax = 0.22;  // [s] for which a stopped hand may keep authority
constexpr double kFeltMax = 0.2;      // [N/ms] that a step of authority may cause at a hand
constexpr double kFeltSlewMax = 10;   // [1/s] of authority; above it, users feel the shares of the stiffest springs

}  // namespace

AuthorityChecker::AuthorityChecker(const SceneSpec& scene) : scene_(&scene), tools_(scene.tools.size()) {}

void AuthorityChecker::check(std::uint32_t lived, const server::Session& session, const AxisArray& scale,
                             server::Violations& violations) {
  for (std::size_t i = 0; i < scene_->masters(); ++i)
    stopped_s_[i] =
        session.seat(i).taken() && session.seat(i).last_state().stop ? stopped_s_[i] + lived / scene_->tick_hz : 0;
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const control::ToolAuthority& authority = session.tool(j).authority;
    const std::string& name = scene_->tools[j].name;
    if (disengages_all(session.state()) && lived > 0 && !authority.held())
      violations.add("stop_holds_tools", name, session.clock().time(), false);
    check_seats(j, lived, session, violations);
    if (lived == 1 && !authority.held() &&
        felt_share(session) * tip_norm(force_step(j, session), scale, scene_->dof) > kFeltMax * 1e3 / scene_->tick_hz)
      violations.add("authority_felt", name, session.clock().time(), false);
    for (std::size_t i = 0; i < scene_->masters(); ++i) tools_[j].alpha[i] = authority.alpha(i);
    tools_[j].braked = authority.held();
  }
}

void AuthorityChecker::check_seats(std::size_t tool, std::uint32_t lived, const server::Session& session,
                                   server::Violations& violations) const {
  const control::ToolAuthority& authority = session.tool(tool).authority;
  const Tool& before = tools_[tool];
  const double step = std::max(scene_->alpha_slew, kLossSlew) * lived / scene_->tick_hz + 1e-9;
  for (std::size_t i = 0; i < scene_->masters(); ++i) {
    const auto reject_if = [&](bool violated, std::string_view invariant) {
      if (violated) violations.add(invariant, scene_->seats[i].name, session.clock().time(), false);
    };
    const double alpha = authority.alpha(i);
    const server::SeatEndpoint& seat = session.seat(i);
    const bool refused = seat.last_state().stop || seat.misbehaviour().quarantined(session.clock().last_tick());
    const Role role = scene_->seats[i].role;
    reject_if(refused && lived == 1 && !before.braked && alpha > before.alpha[i] + 1e-9, "refused_gains_weight");
    reject_if(alpha > 0 && stopped_s_[i] > kStoppedMax, "stop_takes_weight");
    reject_if(alpha > 0 && (role == Role::kEvaluator || role == Role::kObserver), "authority_role");
    reject_if(!authority.held() && !before.braked && std::abs(alpha - before.alpha[i]) > step, "authority_slew");
  }
}

/// Returns whether this seat's spring pulls at another tool too. Then the motor's force limit does not bound its
/// elongation.
bool AuthorityChecker::pulls_elsewhere(std::size_t seat, std::size_t tool,
                                       const server::Session& session) const noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j)
    if (j != tool && (session.tool(j).authority.alpha(seat) > 0 || scene_->follow[seat][j] > 0)) return true;
  return false;
}

/// Returns the force that the most sensitive hand feels, as a share of the tool's force.
double AuthorityChecker::felt_share(const server::Session& session) const noexcept {
  double most = 0;
  for (std::size_t i = 0; i < scene_->masters(); ++i)
    if (session.participants().present()[i]) most = std::max(most, scene_->seats[i].motion_scale);
  return most;
}

/// Returns the force step [N at the port] of a change of authority: every spring at the tool then pulls with another
/// share of its force. In this tick, no motor can pass more of that step to a hand. Tool and hand are separated by a
/// mass and a spring. Returns 0 where the step has no limit: the scene allows faster changes, or a spring pulls at
/// several tools.
AxisArray AuthorityChecker::force_step(std::size_t j, const server::Session& session) const noexcept {
  AxisArray change{};
  if (scene_->alpha_slew > kFeltSlewMax) return change;
  const server::Tool& tool = session.tool(j);
  for (std::size_t i = 0; i < scene_->masters(); ++i) {
    const double by = tool.authority.alpha(i) - tools_[j].alpha[i];
    if (by == 0) continue;
    if (scene_->channel.law != LawKind::kReplica && pulls_elsewhere(i, j, session)) return {};
    const control::EndState& spring = session.seat(i).end(j).state();
    for (std::size_t a = 0; a < scene_->dof; ++a)
      change[a] += by * spring.k[a] * (spring.ref[a] - (tool.x(a) - tool.port().moved[a]));
  }
  return change;
}

}  // namespace tandem::netsim
