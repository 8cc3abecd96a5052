#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "netsim/feel/feel_summary.h"
#include "proto/spec/scene_spec.h"

/// Numbers in units of human perception. One step is one just-noticeable difference.
namespace tandem::netsim {

/// Smallest noticeable change of a stiffness, as a share of it: 23 % [Jones, Hunter 1990: "A perceptual analysis of
/// stiffness", Exp. Brain Res. 79(1)]. Compliance without cues of work and force: 22 % [Tan et al. 1995: Perception &
/// Psychophysics 57(4)].
inline constexpr double kStiffnessWeber = 0.23;
/// Smallest noticeable change of a force: 7 % from 2.5 to 10 N [Pang, Tan, Durlach 1991: "Manual discrimination of
/// force using active finger motion", Perception & Psychophysics 49(6)]. Other studies give up to 10 %.
inline constexpr double kForceWeber = 0.07, kForceWeberMax = 0.10;
/// Smallest noticeable change of a moved mass: 21 % [Beauregard, Srinivasan 1997: RLE Technical Report 607, MIT].
inline constexpr double kMassWeber = 0.21;
/// Smallest noticeable delay of a force for a hand that moves a damper, a spring, a damped mass [s] [Rank, Shi,
/// Mueller, Hirche 2010: EuroHaptics, LNCS 6191, p. 205].
inline constexpr double kDelayDamper = 0.015, kDelaySpring = 0.036, kDelayMass = 0.072;
/// Reference for an added mass [kg]: a handle with the apparent mass of a Touch.
inline constexpr double kHandleMass = 0.1;

/// Returns the number of just-noticeable steps between two positive quantities of one kind. Each step is a factor of 1
/// + weber. NaN unless both are positive.
[[nodiscard]] double noticeable_steps(double a, double b, double weber) noexcept;

/// Returns the stiffness of two springs in series [N/m].
[[nodiscard]] constexpr double in_series(double a, double b) noexcept { return a * b / (a + b); }

/// Returns the perception numbers for JSON; an unknown number is NaN. Keys, in just-noticeable steps unless named
/// otherwise:
///   stiffness_lost_steps   felt stiffness of bone, below what the coupling can render
///   bone_tissue_steps      difference of bone and tissue (300 N/m)
///   force_lost_steps       delivered force while pressing, below the full force
///   mass_added_steps       mass felt at 1 Hz on top of a handle of `kHandleMass`
///   others_late_s          delay until the actions of other hands are felt [s]
///   own_contact_late_s     delay of the hand's own contact [s]: 0 under law `replica`, else a round trip
[[nodiscard]] std::vector<std::pair<std::string, double>> noticeable_numbers(
    const SceneSpec& scene, const std::map<std::string, FeelNumber>& numbers, double one_way_s);

/// Returns one sentence per number that exists, for reports; none without numbers, so without a measured seed.
/// @param one_way_s  network delay each way as the leader met it [s]; NaN: unknown
[[nodiscard]] std::vector<std::string> noticeable_text(const SceneSpec& scene,
                                                       const std::map<std::string, FeelNumber>& numbers,
                                                       double one_way_s);

}  // namespace tandem::netsim
