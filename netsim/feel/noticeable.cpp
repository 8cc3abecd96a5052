#include "netsim/feel/noticeable.h"

#include <cmath>
#include <limits>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

double mean_of(const std::map<std::string, FeelNumber>& numbers, const char* key) {
  const auto it = numbers.find(key);
  return it == numbers.end() ? std::numeric_limits<double>::quiet_NaN() : it->second.mean;
}

std::string steps_text(double steps) {
  if (steps < 0.05) return "no step";
  return format(steps < 9.95 ? "%.1f steps" : "%.0f steps", steps);
}

}  // namespace

double noticeable_steps(double a, double b, double weber) noexcept {
  if (!(a > 0) || !(b > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(std::log(a / b)) / std::log1p(weber);
}

std::vector<std::pair<std::string, double>> noticeable_numbers(const SceneSpec& scene,
                                                               const std::map<std::string, FeelNumber>& numbers,
                                                               double one_way_s) {
  const double bone = mean_of(numbers, "stiffness_felt_n_m"), tissue = mean_of(numbers, "stiffness_tissue_n_m");
  const double mass = mean_of(numbers, "apparent_mass_1hz_kg");
  const double heavier =
      std::isnan(mass) ? mass : noticeable_steps(kHandleMass + std::max(0.0, mass), kHandleMass, kMassWeber);
  const double round = 2 * one_way_s;
  const double own = scene.channel.law == LawKind::kReplica ? 0 * round : round;  // NaN if the network is unknown
  return {{"stiffness_lost_steps", noticeable_steps(bone, in_series(scene.coupling.k_c, kBone), kStiffnessWeber)},
          {"bone_tissue_steps", noticeable_steps(bone, tissue, kStiffnessWeber)},
          {"force_lost_steps", noticeable_steps(mean_of(numbers, "force_share"), 1, kForceWeber)},
          {"mass_added_steps", heavier},
          {"others_late_s", round},
          {"own_contact_late_s", own}};
}

std::vector<std::string> noticeable_text(const SceneSpec& scene, const std::map<std::string, FeelNumber>& numbers,
                                         double one_way_s) {
  std::vector<std::string> out;
  if (numbers.empty()) return out;  // interrupted before the first seed ended
  const double bone = mean_of(numbers, "stiffness_felt_n_m"), tissue = mean_of(numbers, "stiffness_tissue_n_m");
  const double possible = in_series(scene.coupling.k_c, kBone);
  if (const double steps = noticeable_steps(bone, possible, kStiffnessWeber); !std::isnan(steps))
    out.push_back(format("Bone feels %.0f N/m, %s %s than the %.0f N/m of the scene's spring and bone in series.", bone,
                         steps_text(steps).c_str(), bone < possible ? "softer" : "harder", possible));
  if (const double steps = noticeable_steps(bone, tissue, kStiffnessWeber); !std::isnan(steps))
    out.push_back(format("Bone and tissue are %s apart: %s.", steps_text(steps).c_str(),
                         steps < 1   ? "a person cannot tell them apart"
                         : steps < 2 ? "hard to tell apart"
                                     : "a person tells them apart"));
  const double share = mean_of(numbers, "force_share");
  if (const double steps = noticeable_steps(share, 1, kForceWeber); !std::isnan(steps))
    out.push_back(format("While pressing, %.0f %% of the force arrives, %s from all of it: %s.", 100 * share,
                         steps_text(steps).c_str(), steps < 1 ? "not noticed" : "noticed"));
  const double drag = mean_of(numbers, "drag_1hz_n");
  if (!std::isnan(drag))
    out.push_back(format("Moving the tool through free space at 1 Hz takes %.2f N, %.1f times a friction of 0.1 N.",
                         drag, drag / 0.1));
  const double mass = mean_of(numbers, "apparent_mass_1hz_kg");
  if (const double steps = noticeable_steps(kHandleMass + std::max(0.0, mass), kHandleMass, kMassWeber);
      !std::isnan(mass) && !std::isnan(steps))
    out.push_back(format("The handle feels %.0f g heavier at 1 Hz, %s on a handle of %.0f g.",
                         1e3 * std::max(0.0, mass), steps_text(steps).c_str(), 1e3 * kHandleMass));
  const double bump = mean_of(numbers, "handover_bump_n");
  if (const double force = mean_of(numbers, "force_got_n"); bump >= 0 && force > 0)
    out.push_back(
        format("Handing over changes a force by up to %.2f N; of the %.2f N pressed with, %.2f to %.2f N are noticed.",
               bump, force, kForceWeber * force, kForceWeberMax * force));
  if (!std::isnan(one_way_s)) {
    const double round = 2 * one_way_s;
    const char* what = round < kDelayDamper
                           ? "below what a person notices in a damper (15 ms), a spring (36 ms) or a mass (72 ms)"
                       : round < kDelaySpring ? "noticed in a damper (15 ms), not in a spring (36 ms)"
                       : round < kDelayMass   ? "noticed in a spring (36 ms), not in a mass (72 ms)"
                                              : "noticed even in a mass (72 ms)";
    const bool local = scene.channel.law == LawKind::kReplica;
    out.push_back(
        format(local ? "A hand feels the other hands %.0f ms late: %s. Its own contact does not cross the network."
                     : "A force that goes round the network is %.0f ms late: %s.",
               1e3 * round, what));
  }
  return out;
}

}  // namespace tandem::netsim
