#include <algorithm>

#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Authority transfer: two hands press on bone at the same position. At 7 s all authority moves from one to the other,
/// as fast as the scene allows. Neither hand moves, so no force should change.
namespace tandem::netsim {
namespace {

constexpr double kHandoverFront = 0.010, kHandoverDepth = 0.006;                   // [m]
constexpr double kHandoverTouch = 2, kHandoverPressed = 4, kHandoverHandOver = 7;  // [s]
constexpr double kHandoverEnd = 11;

}  // namespace

ProbeResult probe_handover(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand steady{HandKind::kPlain, seed, 0};  // 0.3 mm of intention noise alone cause 0.1 N
  const auto path = [](double t) {
    const double approach = hal::sim::min_jerk(t - 1).value,
                 press = hal::sim::min_jerk((t - kHandoverTouch) / (kHandoverPressed - kHandoverTouch)).value;
    return hal::Vec3(kHandoverFront * (approach - 1) + kHandoverDepth * press, 0, 0);
  };
  ProbeRun run;
  run.length = kHandoverEnd;
  run.start_x = -kHandoverFront;
  run.environment = wall_of(kBone);
  run.hand_over_at = kHandoverHandOver;
  for (std::size_t i = 0; i < 2; ++i) {
    const DrawnHand hand{setup.hands, seed, i};
    run.hands.push_back(
        {hand.with_impedance(HandModel::kRecorded, kFirmK, kFirmB, kFirmM), steady.move(path, kHandoverEnd)});
  }
  const FeelTrace trace = run_part(setup, run, seed, result);
  const auto [before, at] = trace.window(kHandoverHandOver - 1, kHandoverHandOver);
  const auto [from, end] = trace.window(kHandoverHandOver, kHandoverEnd);
  double bump = 0, step = 0, step_before = 0;
  for (const FeelTrace::Hand& hand : trace.hands) {
    const Series quiet = Series{hand.f}.subspan(before, at - before), during = Series{hand.f}.subspan(from, end - from);
    bump = std::max(bump, largest_distance(during, mean(quiet)));
    step = std::max(step, largest_step_per_ms(during, trace.tick_hz));
    step_before = std::max(step_before, largest_step_per_ms(quiet, trace.tick_hz));
  }
  const bool ran = trace.rows() > 0;
  const double none = mean(std::span<const double>{});
  result.values["handover_bump_n"] = ran ? bump : none;
  result.values["handover_step_n_ms"] = ran ? step : none;
  result.values["handover_step_before_n_ms"] = ran ? step_before : none;
  return result;
}

}  // namespace tandem::netsim
