#include "common/base/format.h"
#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Shared authority: the force above 1 Hz on either of two hands that share a tool, from 5 s after a kick on. One hand
/// has 2 to 98 % of the authority; it moves 30 mm within 0.3 s and back. Then both rest without tremor. Both hands are
/// firm in one run and soft in the next.
namespace tandem::netsim {

ProbeResult probe_share(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand steady{HandKind::kPlain, seed, 0};  // moves without tremor
  const auto kick = steady.move(kick_path, kCycleEnd);
  const auto still = steady.move([](double) { return hal::Vec3(0, 0, 0); }, kCycleEnd);
  double most = 0;
  for (const double share : kShares) {
    double worst = 0;
    for (const bool soft : {false, true}) {
      ProbeRun run{.length = kCycleEnd, .share = share};
      for (std::size_t i = 0; i < 2; ++i) {
        const DrawnHand hand{setup.hands, seed, i};
        run.hands.push_back(
            {soft ? hand.with_impedance(HandModel::kRecorded, 50, 1, 0.2) : firm(hand), i == 0 ? kick : still});
      }
      const FeelTrace trace = run_part(setup, run, seed, result);
      for (const FeelTrace::Hand& hand : trace.hands) worst = larger(worst, limit_cycle(trace, hand));
    }
    result.values[format("shared_cycle_%g_n", 100 * share)] = worst;
    most = larger(most, worst);
  }
  result.values["shared_cycle_n"] = most;
  return result;
}

}  // namespace tandem::netsim
