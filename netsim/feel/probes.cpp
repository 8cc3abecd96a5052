#include "netsim/feel/probes.h"

#include <algorithm>
#include <cmath>

#include "netsim/feel/meters.h"

namespace tandem::netsim {

namespace {

constexpr double kSaturated = 0.99;  // of the largest force; the delivered one is quantised and turns with the pose

}  // namespace

void Exposure::add(const Exposure& other) noexcept {
  s += other.s;
  engaged_s += other.engaged_s;
  held_s += other.held_s;
  saturated_s += other.saturated_s;
  trips += other.trips;
  error_square += other.error_square;
  sent_up += other.sent_up;
  sent_down += other.sent_down;
  send_ticks += other.send_ticks;
}

Exposure exposure_of(const FeelTrace& trace, double from) {
  Exposure out;
  if (trace.hands.empty() || trace.rows() == 0) return out;
  const auto [first, end] = trace.window(from, trace.t.back() + 1);
  const FeelTrace::Hand& hand = trace.hands[0];
  const double dt = 1 / trace.tick_hz;
  for (std::size_t i = first; i < end; ++i) {
    out.s += dt;
    out.engaged_s += hand.engaged[i] ? dt : 0;
    out.held_s += trace.held[i] ? dt : 0;
    out.saturated_s += hand.f[i].norm() >= kSaturated * hand.force_max ? dt : 0;
    out.error_square += (hand.f_cmd[i] - hand.f[i]).squaredNorm() * dt;
  }
  if (end <= first) return out;
  out.trips = hand.trips[end - 1] - hand.trips[first];
  for (const FeelTrace::Hand& each : trace.hands) {
    if (each.sent_up.size() != trace.rows()) continue;
    out.sent_up += static_cast<double>(each.sent_up[end - 1] - each.sent_up[first]);
    out.sent_down += static_cast<double>(each.sent_down[end - 1] - each.sent_down[first]);
    out.send_ticks += static_cast<double>(end - 1 - first);
  }
  return out;
}

FeelTrace run_part(const FeelSetup& setup, const ProbeRun& run, std::uint64_t seed, ProbeResult& result) {
  FeelTrace trace = run_probe(setup, run, seed);
  result.lived_s += trace.rows() > 0 ? trace.t.back() : 0;
  if (result.trouble.empty()) result.trouble = trace.trouble;
  if (std::isnan(result.one_way_s) && trace.rows() > 0) result.one_way_s = trace.one_way_s;
  if (trace.hands.empty()) trace.hands.resize(run.hands.size());
  return trace;
}

const ProbeName& row_of(Probe probe) { return *std::ranges::find(kProbes, probe, &ProbeName::probe); }

IntendedPath press_path(double depth, double pressed) {
  return [=](double t) {
    const double approach = hal::sim::min_jerk(t - 1).value,
                 press = hal::sim::min_jerk((t - kPressTouch) / (pressed - kPressTouch)).value;
    return hal::Vec3(kPressFront * (approach - 1) + depth * press, 0, 0);
  };
}

hal::Vec3 kick_path(double t) {
  constexpr double kAway = 0.03, kMove = 0.3, kOut = 1;  // [m, s, s]
  return {kAway * (hal::sim::min_jerk((t - kOut) / kMove).value - hal::sim::min_jerk((t - kKickBack) / kMove).value), 0,
          0};
}

double limit_cycle(const FeelTrace& trace, const FeelTrace::Hand& hand, double from, double to) {
  return rms_above(trace.part(hand.f, from, to), kCycleBand, trace.tick_hz);
}

}  // namespace tandem::netsim
