#include <cmath>

#include "common/base/format.h"
#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Release: a hand presses on a spring, then opens. About 1 N, as from gravity, still pulls the handle of a
/// frictionless device against the spring. The handle must come to rest; otherwise the law adds energy to the spring.
namespace tandem::netsim {
namespace {

constexpr double kPress = 0.004, kReleaseAt = 4, kPull = 1;  // [m, s, N]
// The device's damping, minus the effect of the sampled spring, lets the handle settle. On bone, at 0.93 of the
// stiffness that a Touch renders, the time constant is 9 s.
constexpr double kReleaseMeasure = 30, kReleaseEnd = 34;  // [s]
constexpr double kReleaseBand = 0.5;  // [Hz]; below it is the drift of the pose under gravity compensation
constexpr double kSettled = 1e-4;     // [m] RMS; an encoder step of a Touch is 5.5e-5

}  // namespace

ProbeResult probe_release(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand hand{setup.hands, seed, 0};
  double most = 0;
  for (const double k : kReleaseK) {
    ProbeRun run{.length = kReleaseEnd,
                 .hands = {{firm(hand, HandModel::kLettingGo)}},
                 .environment = wall_of(k),
                 .frictionless = true};
    HandSpec& opens = run.hands[0].hand;
    opens.release_at = kReleaseAt;
    opens.drags = {kPull * hand.factor(11, 0.7, 1.4), 0, 0};
    opens.trajectory.kind = Trajectory::Kind::kWaypoints;
    opens.trajectory.waypoints = {{1, {0, 0, 0}}, {3, {kPress, 0, 0}}};
    const FeelTrace trace = run_part(setup, run, seed, result);
    const double amplitude =
        rms_above(trace.part(trace.hands[0].x, kReleaseMeasure, kReleaseEnd), kReleaseBand, trace.tick_hz);
    result.values[format("released_%g_m", k)] = amplitude;
    most = larger(most, amplitude);
  }
  result.values["released_m"] = most;
  result.values["released_settles"] = std::isnan(most) ? most : most <= kSettled ? 1 : 0;
  return result;
}

}  // namespace tandem::netsim
