#pragma once

#include <memory>
#include <string>
#include <vector>

#include "netsim/feel/drawn_hand.h"
#include "netsim/feel/feel_trace.h"
#include "netsim/world_setup.h"

namespace tandem::netsim {

/// What is measured: everything of a scene that shapes what hands feel, and the network under it.
struct FeelSetup {
  SceneSpec scene;        ///< channel, coupling, gate, alpha slew, device of the first masters, first tool
  LinkSpec network = {};  ///< of every seat
  HandKind hands = HandKind::kDrawn;
  struct Recording {
    std::string name;
    std::shared_ptr<const hal::sim::RecordedMotion> motion;
  };
  std::vector<Recording> recordings = {};  ///< moved by the leader beside the drawn motions
};

/// A hand of a probe: an impedance, and where it wants to be. Without a motion the hand's own model decides.
struct ProbeHand {
  HandSpec hand;
  std::shared_ptr<const hal::sim::RecordedMotion> motion = {};
};
/// A person or a thing knocks at a handle.
struct ProbePush {
  std::size_t hand = 0;
  double at = 0;  ///< session time [s]
  hal::Vec3 force = hal::Vec3::Zero();
  double length = 0.1;  ///< [s]
};

/// One run of the virtual world from which a number is taken. Hand 0 leads, hand 1 follows (with two hands).
struct ProbeRun {
  double length = 10;                  ///< session time [s]
  double start_x = 0;                  ///< where tips and tool begin [m]
  std::vector<ProbeHand> hands = {};   ///< one or two
  EnvironmentSpec environment = {};    ///< of the tool
  std::vector<ProbePush> pushes = {};
  double share = 1;                    ///< authority of hand 0; hand 1 has the rest
  double hand_over_at = 0;             ///< from then on hand 1 has all authority; 0: never [s]
  bool frictionless = false;           ///< devices and tool without Coulomb friction
  bool perfect_network = false;        ///< in place of the one to be measured
};

/// A wall at x = 0 that fills x > 0.
[[nodiscard]] EnvironmentSpec wall_of(double k);
inline constexpr double kBone = 20'000, kTissue = 300;  ///< [N/m]

/// The scene of a probe: FeelSetup's, with the probe's hands, environment and authority.
[[nodiscard]] WorldSetup world_of(const FeelSetup& setup, const ProbeRun& run, std::uint64_t seed);

/// Runs it to its end. A session that cannot begin or never runs gives a trace with `trouble` and no rows.
[[nodiscard]] FeelTrace run_probe(const FeelSetup& setup, const ProbeRun& run, std::uint64_t seed);

}  // namespace tandem::netsim
