#include <algorithm>
#include <span>

#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Slow press: the hand starts 10 mm in front of the wall and touches it at 2 s.
/// - For the stiffness it moves 50 mm deep within 14 s, so that a law of 45 N/m also gives forces well above friction.
/// Only rows before the motor's limit count.
/// - For the force it presses within 6 s and holds. The depth is 3 to 20 mm: as deep as this coupling and these motors
/// can render without saturation.
namespace tandem::netsim {
namespace {

constexpr double kFront = 0.010, kDepthMin = 0.003, kDepthMax = 0.020, kPressDeep = 0.050;              // [m]
constexpr double kTouch = 2, kPressed = 8, kSlowly = 16, kSteady = 10, kBoneEnd = 20, kTissueEnd = 14;  // [s]
constexpr double kReserve = 0.85;  // of the motor's force
constexpr double kSlopeLow = 0.15,
                 kSlopeHigh = 0.9;  // of the motor's force, or of the largest force if that is smaller

double depth_of(const FeelSetup& setup) {
  const SceneSpec& s = setup.scene;
  const double force = std::min(s.gate.force_max, s.seats[0].device.force_peak);
  return std::clamp(kReserve * force * (1 / kFirmK + 1 / s.coupling.k_c), kDepthMin, kDepthMax);
}

ProbeRun press(const FeelSetup& setup, std::uint64_t seed, double wall, double depth, double pressed, double length) {
  const DrawnHand hand{setup.hands, seed, 0};
  const auto path = [=](double t) {
    const double approach = hal::sim::min_jerk(t - 1).value,
                 press = hal::sim::min_jerk((t - kTouch) / (pressed - kTouch)).value;
    return hal::Vec3(kFront * (approach - 1) + depth * press, 0, 0);
  };
  ProbeRun run;
  run.length = length;
  run.start_x = -kFront;
  run.hands = {{hand.with_impedance(HandModel::kRecorded, kFirmK, kFirmB, kFirmM), hand.move(path, length)}};
  run.environment = wall_of(wall);
  return run;
}

/// Along x: position of the hand [m], force on the hand [N], force on the environment [N].
struct Pressed {
  std::vector<double> x, felt, tool;
};
Pressed along_x(const FeelTrace& trace, double from, double to) {
  const auto [first, end] = trace.window(from, to);
  Pressed out;
  for (std::size_t i = first; i < end; ++i) {
    out.x.push_back(trace.hands[0].x[i].x());
    out.felt.push_back(-trace.hands[0].f[i].x());
    out.tool.push_back(-trace.f_env[i].x());
  }
  return out;
}

double stiffness(const FeelTrace& trace) {
  Pressed p = along_x(trace, kTouch, kSlowly);
  if (p.felt.empty()) return mean(p.felt);
  const double limit = trace.hands[0].force_max, most = std::min(*std::ranges::max_element(p.felt), limit);
  const double high = kSlopeHigh * most, low = kSlopeLow * (most > 2 * kSlopeLow * limit ? limit : most);
  const auto end =
      static_cast<std::size_t>(std::ranges::find_if(p.felt, [&](double f) { return f > high; }) - p.felt.begin());
  return slope(std::span{p.x}.first(end), std::span{p.felt}.first(end), low, high);
}

/// Means while the hand holds still.
struct Held {
  double felt = 0, difference = 0;  ///< [N]
  double stiffness = 0;             ///< force on the hand over its depth [N/m]
};
Held held(const FeelTrace& trace, double end) {
  const Pressed p = along_x(trace, kSteady, end);
  return {mean(p.felt), std::abs(mean(p.felt) - mean(p.tool)), mean(p.felt) / mean(p.x)};
}

}  // namespace

ProbeResult probe_press(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const double depth = depth_of(setup);
  const ProbeRun on_bone = press(setup, seed, kBone, depth, kPressed, kBoneEnd);
  ProbeRun undisturbed = on_bone;
  undisturbed.perfect_network = true;
  const FeelTrace bone = run_part(setup, on_bone, seed, result);
  const FeelTrace tissue = run_part(setup, press(setup, seed, kTissue, depth, kPressed, kTissueEnd), seed, result);
  const FeelTrace wanted = run_part(setup, undisturbed, seed, result);
  const Held bone_held = held(bone, kBoneEnd), tissue_held = held(tissue, kTissueEnd);
  FeelValues& v = result.values;
  v["stiffness_felt_n_m"] =
      stiffness(run_part(setup, press(setup, seed, kBone, kPressDeep, kSlowly, kSlowly), seed, result));
  v["stiffness_tissue_n_m"] =
      stiffness(run_part(setup, press(setup, seed, kTissue, kPressDeep, kSlowly, kSlowly), seed, result));
  v["stiffness_bone_held_n_m"] = bone_held.stiffness;
  v["stiffness_tissue_held_n_m"] = tissue_held.stiffness;
  v["force_got_n"] = bone_held.felt;
  v["force_wanted_n"] = held(wanted, kBoneEnd).felt;
  v["force_share"] = v["force_got_n"] / v["force_wanted_n"];
  v["tool_felt_bone_n"] = bone_held.difference;
  v["tool_felt_tissue_n"] = tissue_held.difference;
  result.exposure.add(exposure_of(bone, 1));
  result.exposure.add(exposure_of(tissue, 1));
  return result;
}

}  // namespace tandem::netsim
