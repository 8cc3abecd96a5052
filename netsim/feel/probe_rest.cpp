#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Limit cycles: the force above 1 Hz on a hand at rest, from 5 s after a kick on. A hand moves 30 mm within 0.3 s and
/// back, then rests without tremor; a relaxed hand is pushed.
namespace tandem::netsim {
namespace {

struct Resting {
  const char* key;
  HandModel model;
  double k, b, m;  ///< [N/m, N s/m, kg]
};
constexpr Resting kHands[] = {
    {"limit_cycle_firm_n", HandModel::kRecorded, kFirmK, kFirmB, kFirmM},
    {"limit_cycle_resting_n", HandModel::kRecorded, 50, 5, 0.1},
    {"limit_cycle_soft_n", HandModel::kRecorded, 50, 1, 0.2},
    {"limit_cycle_relaxed_n", HandModel::kRelaxed, 0, 2, 0.1},
};

}  // namespace

ProbeResult probe_rest(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand hand{setup.hands, seed, 0};
  const DrawnHand steady{HandKind::kPlain, seed, 0};  // moves without tremor
  double most = 0;
  for (const Resting& r : kHands) {
    ProbeRun run{.length = kCycleEnd, .hands = {{hand.with_impedance(r.model, r.k, r.b, r.m)}}};
    if (r.model == HandModel::kRecorded) run.hands[0].motion = steady.move(kick_path, kCycleEnd);
    if (r.model == HandModel::kRelaxed) run.pushes = {{.hand = 0, .at = kKickBack, .force = {2, 0, 0}, .length = 0.1}};
    const FeelTrace trace = run_part(setup, run, seed, result);
    const double force = limit_cycle(trace, trace.hands[0]);
    result.values[r.key] = force;
    most = larger(most, force);
  }
  result.values["limit_cycle_n"] = most;
  return result;
}

}  // namespace tandem::netsim
