#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/base/format.h"
#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Gain: ratio of the tool's to the hand's motion, on circles of 3 mm, one frequency after the other in one run. Larger
/// circles saturate a motor of 3.3 N from 5 Hz on; smaller ones disappear in friction. Each circle grows within 0.5 s
/// and settles for a period or 1 s. It is measured for whole periods of 1.5 s or more, and fades within 0.5 s.
namespace tandem::netsim {
namespace {

constexpr double kRadius = 0.003, kEdge = 0.5, kBegin = 1.5;  // [m, s, s]
constexpr double kGainTurn = 2 * std::numbers::pi;

struct Dwell {
  double hz = 0, from = 0, measure = 0, fade = 0, end = 0;  ///< [Hz, s]
};

std::vector<Dwell> dwells() {
  std::vector<Dwell> out;
  double at = kBegin;
  for (const double hz : kGainHz) {
    Dwell d{.hz = hz, .from = at};
    d.measure = at + kEdge + std::max(1.0, 1 / hz);
    d.fade = d.measure + std::ceil(std::max(1.5, 2 / hz) * hz) / hz;
    d.end = at = d.fade + kEdge;
    out.push_back(d);
  }
  return out;
}

hal::Vec3 position(const std::vector<Dwell>& plan, double t) {
  for (const Dwell& d : plan) {
    if (t < d.from || t >= d.end) continue;
    const double r =
        kRadius * hal::sim::min_jerk((t - d.from) / kEdge).value * hal::sim::min_jerk((d.end - t) / kEdge).value;
    const double phase = kGainTurn * d.hz * (t - d.from);
    return {r * std::cos(phase), 0, r * std::sin(phase)};
  }
  return hal::Vec3::Zero();
}

}  // namespace

ProbeResult probe_gain(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const std::vector<Dwell> plan = dwells();
  const DrawnHand hand{setup.hands, seed, 0};
  const double length = plan.back().end;
  const ProbeRun run{.length = length,
                     .hands = {{firm(hand), hand.move([&](double t) { return position(plan, t); }, length)}}};
  const FeelTrace trace = run_part(setup, run, seed, result);
  double most = 0;
  for (const Dwell& d : plan) {
    const auto t = trace.part(trace.t, d.measure, d.fade);
    const auto amplitude = [&](const std::vector<hal::Vec3>& x) {
      return std::abs(harmonic(t, along_x(trace.part(x, d.measure, d.fade)), d.hz));
    };
    const double gain = amplitude(trace.tool) / amplitude(trace.hands[0].x);
    result.values[format("gain_%ghz", d.hz)] = gain;
    most = larger(most, gain);
  }
  result.values["gain_max"] = most;
  return result;
}

}  // namespace tandem::netsim
