#include "netsim/system/effort_checker.h"

#include <algorithm>
#include <utility>

namespace tandem::netsim {
namespace {

// Limits of the force gate (ARCHITECTURE.md, invariants 3 to 5).
constexpr double kSlewActive = 1000, kSlewRampIn = 10;  // [N/s]
constexpr double kGateStepMax = 0.01;                   // [s], lateness that the slew limit makes up for
constexpr double kLifeTicks = 3, kLifeMin = 0.005, kLifeMax = 0.03,
                 kFade = 0.02;  // ticks, [s]: validity of a command, and the fade of its force after that

bool all_finite(const AxisArray& v, std::size_t dof) noexcept {
  return std::all_of(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(dof),
                     [](double e) { return std::isfinite(e); });
}

}  // namespace

void EffortChecker::check(const ObservedSeat& seat) {
  const client::Seat& core = seat.core();
  const std::size_t dof = seat.scene.dof;
  const Time now = seat.client.own_time(seat.client.last_run());
  const AxisArray before = std::exchange(effort_, core.effort());
  const Time before_at = std::exchange(run_at_, now);
  if (!all_finite(core.effort(), dof)) return seat.violated("effort_finite");
  if (!all_finite(core.sample().port.x, dof) || !all_finite(core.sample().port.v, dof)) seat.violated("sample_finite");
  const double force = seat.force();
  if (force > seat.force_share() * seat.scene.gate.force_max * (1 + 1e-9)) seat.violated("effort_limited");
  if (!core.gate().active() || force == 0) return;  // an immediate release is always allowed
  // After a pause longer than the validity of a command plus the device's fade, the motors have no force. The next
  // effort is then a step from zero, not from the effort that the program remembers.
  const double forgotten = std::clamp(kLifeTicks / seat.scene.tick_hz, kLifeMin, kLifeMax) + kFade;
  const bool first = before_at == Time{};
  const bool stood_still = !first && seconds(now - before_at) > forgotten;
  AxisArray change{};
  for (std::size_t a = 0; a < dof; ++a) change[a] = core.effort()[a] - (stood_still ? 0 : before[a]);
  const double dt = first ? 0 : std::clamp(seconds(now - before_at), 0.0, kGateStepMax);
  const double rate = core.gate().phase() == control::GatePhase::kRampIn ? kSlewRampIn : kSlewActive;
  if (tip_norm(change, core.setup().axis_scale, dof) > rate * dt * (1 + 1e-6) + 1e-9) seat.violated("effort_slew");
}

}  // namespace tandem::netsim
