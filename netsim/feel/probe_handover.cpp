#include <algorithm>

#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Authority transfer: two hands press on bone at the same position. At 7 s all authority moves from one to the other,
/// as fast as the scene allows. Neither hand moves, so no force should change.
namespace tandem::netsim {
namespace {

constexpr double kHandoverDepth = 0.006;                                          // [m]
constexpr double kHandoverPressed = 4, kHandoverHandOver = 7, kHandoverEnd = 11;  // [s]

}  // namespace

ProbeResult probe_handover(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand steady{HandKind::kPlain, seed, 0};  // 0.3 mm of intention noise alone cause 0.1 N
  const auto motion = steady.move(press_path(kHandoverDepth, kHandoverPressed), kHandoverEnd);
  ProbeRun run{.length = kHandoverEnd,
               .start_x = -kPressFront,
               .environment = wall_of(kBone),
               .hand_over_at = kHandoverHandOver};
  for (std::size_t i = 0; i < 2; ++i) run.hands.push_back({firm(DrawnHand{setup.hands, seed, i}), motion});
  const FeelTrace trace = run_part(setup, run, seed, result);
  double bump = 0, step = 0, step_before = 0;
  for (const FeelTrace::Hand& hand : trace.hands) {
    const Series quiet = trace.part(hand.f, kHandoverHandOver - 1, kHandoverHandOver),
                 during = trace.part(hand.f, kHandoverHandOver, kHandoverEnd);
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
