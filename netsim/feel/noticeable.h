#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "netsim/feel/feel_summary.h"
#include "proto/scene_spec.h"

/// Numbers in units that a person notices. A step is one just-noticeable difference.
namespace tandem::netsim {

/// Smallest change of a stiffness that is noticed, as a share of it: 23 % [Jones, Hunter 1990: "A perceptual analysis of stiffness",
/// Exp. Brain Res. 79(1)]; compliance without cues of work and force: 22 % [Tan et al. 1995: Perception & Psychophysics 57(4)].
inline constexpr double kStiffnessWeber = 0.23;
/// Of a force: 7 % from 2.5 to 10 N [Pang, Tan, Durlach 1991: "Manual discrimination of force using active finger motion",
/// Perception & Psychophysics 49(6)]; other studies give up to 10 %.
inline constexpr double kForceWeber = 0.07, kForceWeberMax = 0.10;
/// Of a mass that is moved: 21 % [Beauregard, Srinivasan 1997: RLE Technical Report 607, MIT].
inline constexpr double kMassWeber = 0.21;
/// Delay of a force that is noticed by a hand that moves a damper, a spring, a damped mass [s]
/// [Rank, Shi, Mueller, Hirche 2010: EuroHaptics, LNCS 6191, p. 205].
inline constexpr double kDelayDamper = 0.015, kDelaySpring = 0.036, kDelayMass = 0.072;
/// A handle that feels like a Touch's [kg]: what an added mass is compared with.
inline constexpr double kHandleMass = 0.1;

/// How many just-noticeable steps lie between two positive quantities of the same kind, each 1 + weber times the one before. NaN of
/// what is not positive.
[[nodiscard]] double noticeable_steps(double a, double b, double weber) noexcept;

/// Springs in series [N/m].
[[nodiscard]] constexpr double in_series(double a, double b) noexcept { return a * b / (a + b); }

/// The same as numbers, for JSON; what cannot be told is NaN. Keys, in just-noticeable steps unless named otherwise:
///   stiffness_lost_steps   bone as felt, below what the coupling can show
///   bone_tissue_steps      bone apart from tissue of 300 N/m
///   force_lost_steps       the force that arrives while pressing, below all of it
///   mass_added_steps       mass felt at 1 Hz on top of a handle of `kHandleMass`
///   others_late_s          how late what other hands do is felt [s]
///   own_contact_late_s     the same of the hand's own contact [s]: nothing under law `replica`, else a round trip
[[nodiscard]] std::vector<std::pair<std::string, double>> noticeable_numbers(const SceneSpec& scene, const std::map<std::string, FeelNumber>& numbers,
                                                                            double one_way_s);

/// Sentences for people, one per line; only of numbers that exist.
/// @param one_way_s  the delay of the network each way, as the leader met it [s]; NaN: unknown
[[nodiscard]] std::vector<std::string> noticeable_text(const SceneSpec& scene, const std::map<std::string, FeelNumber>& numbers, double one_way_s);

}  // namespace tandem::netsim
