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

constexpr double kDepthMin = 0.003, kDepthMax = 0.020, kPressDeep = 0.050;                  // [m]
constexpr double kPressed = 8, kSlowly = 16, kSteady = 10, kBoneEnd = 20, kTissueEnd = 14;  // [s]
constexpr double kReserve = 0.85;                                                           // of the motor's force
constexpr double kSlopeLow = 0.15,
                 kSlopeHigh = 0.9;  // of the motor's force, or of the largest force if that is smaller

ProbeRun press(const FeelSetup& setup, std::uint64_t seed, double wall, double depth, double pressed, double length) {
  const DrawnHand hand{setup.hands, seed, 0};
  return {.length = length,
          .start_x = -kPressFront,
          .hands = {{firm(hand), hand.move(press_path(depth, pressed), length)}},
          .environment = wall_of(wall)};
}

/// Returns the forces that press on the hand or on the environment: those against x [N].
std::vector<double> pressing(Series forces) {
  std::vector<double> out = along_x(forces);
  for (double& f : out) f = -f;
  return out;
}

double stiffness(const FeelTrace& trace) {
  const std::vector<double> x = along_x(trace.part(trace.hands[0].x, kPressTouch, kSlowly)),
                            felt = pressing(trace.part(trace.hands[0].f, kPressTouch, kSlowly));
  if (felt.empty()) return mean(felt);
  const double limit = trace.hands[0].force_max, most = std::min(*std::ranges::max_element(felt), limit);
  const double high = kSlopeHigh * most, low = kSlopeLow * (most > 2 * kSlopeLow * limit ? limit : most);
  const auto end =
      static_cast<std::size_t>(std::ranges::find_if(felt, [&](double f) { return f > high; }) - felt.begin());
  return slope(std::span{x}.first(end), std::span{felt}.first(end), low, high);
}

}  // namespace

double press_depth(const FeelSetup& setup) {
  const SceneSpec& s = setup.scene;
  const double force = std::min(s.gate.force_max, s.seats[0].device.force_peak);
  return std::clamp(kReserve * force * (1 / kFirmK + 1 / s.coupling.k_c), kDepthMin, kDepthMax);
}

HeldPress held_press(const FeelTrace& trace, double from, double to) {
  const double felt = mean(pressing(trace.part(trace.hands[0].f, from, to)));
  const double tool = mean(pressing(trace.part(trace.f_env, from, to)));
  return {felt, std::abs(felt - tool), felt / mean(along_x(trace.part(trace.hands[0].x, from, to)))};
}

ProbeResult probe_press(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const double depth = press_depth(setup);
  const ProbeRun on_bone = press(setup, seed, kBone, depth, kPressed, kBoneEnd);
  ProbeRun undisturbed = on_bone;
  undisturbed.perfect_network = true;
  const FeelTrace bone = run_part(setup, on_bone, seed, result);
  const FeelTrace tissue = run_part(setup, press(setup, seed, kTissue, depth, kPressed, kTissueEnd), seed, result);
  const FeelTrace wanted = run_part(setup, undisturbed, seed, result);
  const HeldPress bone_held = held_press(bone, kSteady, kBoneEnd),
                  tissue_held = held_press(tissue, kSteady, kTissueEnd);
  FeelValues& v = result.values;
  v["stiffness_felt_n_m"] =
      stiffness(run_part(setup, press(setup, seed, kBone, kPressDeep, kSlowly, kSlowly), seed, result));
  v["stiffness_tissue_n_m"] =
      stiffness(run_part(setup, press(setup, seed, kTissue, kPressDeep, kSlowly, kSlowly), seed, result));
  v["stiffness_bone_held_n_m"] = bone_held.stiffness;
  v["stiffness_tissue_held_n_m"] = tissue_held.stiffness;
  v["force_got_n"] = bone_held.felt;
  v["force_wanted_n"] = held_press(wanted, kSteady, kBoneEnd).felt;
  v["force_share"] = v["force_got_n"] / v["force_wanted_n"];
  v["tool_felt_bone_n"] = bone_held.difference;
  v["tool_felt_tissue_n"] = tissue_held.difference;
  result.exposure.add(exposure_of(bone, 1));
  result.exposure.add(exposure_of(tissue, 1));
  return result;
}

}  // namespace tandem::netsim
