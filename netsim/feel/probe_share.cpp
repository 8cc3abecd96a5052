#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/format.h"
#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Shared authority: the force above 1 Hz on either of two hands that share a tool, from 5 s after a kick on. One hand
/// has 2 to 98 % of the authority; it moves 30 mm within 0.3 s and back. Then both rest without tremor. Both hands are
/// firm in one run and soft in the next.
namespace tandem::netsim {
namespace {

constexpr double kShareAway = 0.03, kShareMove = 0.3, kShareOut = 1, kShareBack = 2;  // [m, s, s, s]
constexpr double kShareMeasure = 7.5, kShareEnd = 12.5;                               // [s]
constexpr double kShareBand = 1;                                                      // [Hz]

}  // namespace

ProbeResult probe_share(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand steady{HandKind::kPlain, seed, 0};  // moves without tremor
  const auto kick = steady.move(
      [](double t) {
        return hal::Vec3(kShareAway * (hal::sim::min_jerk((t - kShareOut) / kShareMove).value -
                                       hal::sim::min_jerk((t - kShareBack) / kShareMove).value),
                         0, 0);
      },
      kShareEnd);
  const auto still = steady.move([](double) { return hal::Vec3(0, 0, 0); }, kShareEnd);
  double most = 0;
  for (const double share : kShares) {
    double worst = 0;
    for (const bool soft : {false, true}) {
      ProbeRun run;
      run.length = kShareEnd;
      run.share = share;
      for (std::size_t i = 0; i < 2; ++i) {
        const DrawnHand hand{setup.hands, seed, i};
        run.hands.push_back({soft ? hand.with_impedance(HandModel::kRecorded, 50, 1, 0.2)
                                  : hand.with_impedance(HandModel::kRecorded, kFirmK, kFirmB, kFirmM),
                             i == 0 ? kick : still});
      }
      const FeelTrace trace = run_part(setup, run, seed, result);
      const auto [first, end] = trace.window(kShareMeasure, kShareEnd);
      for (const FeelTrace::Hand& hand : trace.hands) {
        const double force = rms_above(Series{hand.f}.subspan(first, end - first), kShareBand, trace.tick_hz);
        worst = std::isnan(force) || std::isnan(worst) ? kNaN : std::max(worst, force);
      }
    }
    result.values[format("shared_cycle_%g_n", 100 * share)] = worst;
    most = std::isnan(worst) || std::isnan(most) ? kNaN : std::max(most, worst);
  }
  result.values["shared_cycle_n"] = most;
  return result;
}

}  // namespace tandem::netsim
