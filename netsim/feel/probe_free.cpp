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

void put_errors(const FeelTrace& trace, double from, double to, const std::string& motion, FeelValues& v) {
  const Series leader = trace.part(trace.hands[0].x, from, to), tool = trace.part(trace.tool, from, to);
  const auto lag = static_cast<std::size_t>(std::llround(trace.one_way_s * trace.tick_hz));
  v["leader_tool_" + motion + "_m"] = rms_difference(leader, tool);
  v["follower_tool_" + motion + "_m"] = rms_difference(trace.part(trace.hands[1].x, from, to), tool);
  v["transport_lag_" + motion + "_m"] = rms_lag(leader, lag);
}

void put_follower(const FeelTrace& trace, const Circle& circle, FeelValues& v) {
  const Series force = trace.part(trace.hands[1].f, kSettle, circle.end);
  v[std::string("follower_force_") + circle.name + "_n"] = rms(force);
  v[std::string("follower_step_") + circle.name + "_n_ms"] = largest_step_per_ms(force, trace.tick_hz);
}

/// Measures drag and apparent mass: the leader's force against velocity and acceleration of the hand, along x.
void put_drag(const FeelTrace& trace, const Circle& circle, FeelValues& v) {
  const auto t = trace.part(trace.t, kSettle, circle.end);
  const Series x = trace.part(trace.hands[0].x, kSettle, circle.end),
               f = trace.part(trace.hands[0].f, kSettle, circle.end);
  v[std::string("drag_") + circle.name + "_n"] = rms(f);
  const std::complex<double> speed = std::complex<double>(0, kTurn * circle.hz) * harmonic(t, along_x(x), circle.hz);
  const std::complex<double> impedance = -harmonic(t, along_x(f), circle.hz) / speed;
  v[std::string("drag_") + circle.name + "_n_s_m"] = impedance.real();
  v[std::string("apparent_mass_") + circle.name + "_kg"] = impedance.imag() / (kTurn * circle.hz);
}

void put_overshoot(const FeelTrace& trace, FeelValues& v) {
  const std::vector<double> tool = along_x(trace.part(trace.tool, kStepAt, kStepEnd));
  v["overshoot"] = overshoot(tool);
  v["overshoot_above_hand"] = overshoot_above(tool, along_x(trace.part(trace.hands[0].x, kStepAt, kStepEnd)));
}

}  // namespace

ProbeResult probe_free(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand leader{setup.hands, seed, 0}, follower{setup.hands, seed, 1};
  const auto play = [&](std::shared_ptr<const hal::sim::RecordedMotion> motion, double length) {
    const ProbeRun run{.length = length, .hands = {{firm(leader), std::move(motion)}, {relaxed(follower)}}};
    FeelTrace trace = run_part(setup, run, seed, result);
    result.exposure.add(exposure_of(trace, 1));
    return trace;
  };
  const auto go = [&](const IntendedPath& path, double length) { return play(leader.move(path, length), length); };
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

  std::map<std::string, double> squares;
  for (const FeelSetup::Recording& recording : setup.recordings) {
    const double length = std::min(kRecordingMax, recording.motion->duration());
    const FeelTrace trace = play(recording.motion, length);
    FeelValues v;
    put_errors(trace, std::min(kSettle, 0.5 * length), length, "recorded", v);
    for (const auto& [key, error] : v) squares[key] += std::pow(error, 2);
  }
  for (const auto& [key, square] : squares)
    result.values[key] = std::sqrt(square / static_cast<double>(setup.recordings.size()));
  return result;
}

}  // namespace tandem::netsim
