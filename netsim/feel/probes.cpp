#include "netsim/feel/probes.h"

#include <cmath>

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
  if (end > first) out.trips = hand.trips[end - 1] - hand.trips[first];
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

ProbeResult run_probe(Probe probe, const FeelSetup& setup, std::uint64_t seed) {
  switch (probe) {
    case Probe::kPress:
      return probe_press(setup, seed);
    case Probe::kFree:
      return probe_free(setup, seed);
    case Probe::kGain:
      return probe_gain(setup, seed);
    case Probe::kRest:
      return probe_rest(setup, seed);
    case Probe::kRelease:
      return probe_release(setup, seed);
    case Probe::kHandOver:
      return probe_handover(setup, seed);
    case Probe::kShare:
      return probe_share(setup, seed);
    case Probe::kFollow:
      return probe_follow(setup, seed);
  }
  return {};
}

}  // namespace tandem::netsim
