#include <cmath>
#include <numbers>

#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Free motion: the leader moves the tool, which leads a relaxed hand.
namespace tandem::netsim {
namespace {

constexpr double kSettle = 3;                                     // [s] before anything is measured
constexpr double kStepAt = 2, kStepFor = 0.15, kFreeStep = 0.02;  // [s, s, m]
constexpr double kStepEnd = 5.5;
constexpr double kRecordingMax = 20;  // [s], longest part of a recording that is played
constexpr double kTurn = 2 * std::numbers::pi;

struct Circle {
  const char* name;
  double hz, radius, end;  ///< [Hz, m, s]; whole periods between kSettle and end
};
constexpr Circle kCircles[] = {{"05hz", 0.5, 0.05, 11}, {"1hz", 1, 0.03, 9}};

ProbeRun both(const FeelSetup& setup, std::uint64_t seed, double length) {
  const DrawnHand follower{setup.hands, seed, 1};
  ProbeRun run;
  run.length = length;
  run.hands.resize(2);
  run.hands[1].hand = follower.with_impedance(HandModel::kRelaxed, 0, 2, 0.1);
  return run;
}

void put_errors(const FeelTrace& trace, double from, double to, const std::string& motion, FeelValues& v) {
  const auto [first, end] = trace.window(from, to);
  const auto part = [&](const std::vector<hal::Vec3>& all) { return Series{all}.subspan(first, end - first); };
  const auto lag = static_cast<std::size_t>(std::llround(trace.one_way_s * trace.tick_hz));
  v["leader_tool_" + motion + "_m"] = rms_difference(part(trace.hands[0].x), part(trace.tool));
  v["follower_tool_" + motion + "_m"] = rms_difference(part(trace.hands[1].x), part(trace.tool));
  v["transport_lag_" + motion + "_m"] = rms_lag(part(trace.hands[0].x), lag);
}

void put_follower(const FeelTrace& trace, const Circle& circle, FeelValues& v) {
  const auto [first, end] = trace.window(kSettle, circle.end);
  const Series force = Series{trace.hands[1].f}.subspan(first, end - first);
  v[std::string("follower_force_") + circle.name + "_n"] = rms(force);
  v[std::string("follower_step_") + circle.name + "_n_ms"] = largest_step_per_ms(force, trace.tick_hz);
}

/// Measures drag and apparent mass: the leader's force against velocity and acceleration of the hand, along x.
void put_drag(const FeelTrace& trace, const Circle& circle, FeelValues& v) {
  const auto [first, end] = trace.window(kSettle, circle.end);
  v[std::string("drag_") + circle.name + "_n"] = rms(Series{trace.hands[0].f}.subspan(first, end - first));
  std::vector<double> x, f;
  for (std::size_t i = first; i < end; ++i) {
    x.push_back(trace.hands[0].x[i].x());
    f.push_back(trace.hands[0].f[i].x());
  }
  const std::complex<double> speed = std::complex<double>(0, kTurn * circle.hz) *
                                     harmonic(std::span{trace.t}.subspan(first, end - first), x, circle.hz);
  const std::complex<double> impedance =
      -harmonic(std::span{trace.t}.subspan(first, end - first), f, circle.hz) / speed;
  v[std::string("drag_") + circle.name + "_n_s_m"] = impedance.real();
  v[std::string("apparent_mass_") + circle.name + "_kg"] = impedance.imag() / (kTurn * circle.hz);
}

void put_overshoot(const FeelTrace& trace, FeelValues& v) {
  const auto [first, end] = trace.window(kStepAt, kStepEnd);
  std::vector<double> hand, tool;
  for (std::size_t i = first; i < end; ++i) {
    hand.push_back(trace.hands[0].x[i].x());
    tool.push_back(trace.tool[i].x());
  }
  v["overshoot"] = overshoot(tool);
  v["overshoot_above_hand"] = overshoot_above(tool, hand);
}

}  // namespace

ProbeResult probe_free(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand leader{setup.hands, seed, 0};
  const auto go = [&](const IntendedPath& path, double length) {
    ProbeRun run = both(setup, seed, length);
    run.hands[0] = {leader.with_impedance(HandModel::kRecorded, kFirmK, kFirmB, kFirmM), leader.move(path, length)};
    FeelTrace trace = run_part(setup, run, seed, result);
    result.exposure.add(exposure_of(trace, 1));
    return trace;
  };
  for (const Circle& circle : kCircles) {
    const FeelTrace trace = go(
        [&](double t) {
          const double r = circle.radius * hal::sim::min_jerk(t).value;
          return hal::Vec3(r * std::cos(kTurn * circle.hz * t), 0, r * std::sin(kTurn * circle.hz * t));
        },
        circle.end);
    put_drag(trace, circle, result.values);
    put_errors(trace, kSettle, circle.end, circle.name, result.values);
    put_follower(trace, circle, result.values);
  }
  const FeelTrace step =
      go([](double t) { return hal::Vec3(kFreeStep * hal::sim::min_jerk((t - kStepAt) / kStepFor).value, 0, 0); },
         kStepEnd);
  put_overshoot(step, result.values);
  put_errors(step, kStepAt, kStepEnd, "step", result.values);

  double square = 0, lag_square = 0, follower_square = 0;
  for (const FeelSetup::Recording& recording : setup.recordings) {
    const double length = std::min(kRecordingMax, recording.motion->duration());
    ProbeRun run = both(setup, seed, length);
    run.hands[0] = {leader.with_impedance(HandModel::kRecorded, kFirmK, kFirmB, kFirmM), recording.motion};
    const FeelTrace trace = run_part(setup, run, seed, result);
    result.exposure.add(exposure_of(trace, 1));
    FeelValues v;
    put_errors(trace, std::min(kSettle, 0.5 * length), length, "recorded", v);
    square += std::pow(v["leader_tool_recorded_m"], 2);
    follower_square += std::pow(v["follower_tool_recorded_m"], 2);
    lag_square += std::pow(v["transport_lag_recorded_m"], 2);
  }
  if (!setup.recordings.empty()) {
    const auto count = static_cast<double>(setup.recordings.size());
    result.values["leader_tool_recorded_m"] = std::sqrt(square / count);
    result.values["follower_tool_recorded_m"] = std::sqrt(follower_square / count);
    result.values["transport_lag_recorded_m"] = std::sqrt(lag_square / count);
  }
  return result;
}

}  // namespace tandem::netsim
