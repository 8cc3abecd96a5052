#pragma once

#include <memory>
#include <string>
#include <vector>

#include "netsim/feel/drawn_hand.h"
#include "netsim/feel/feel_trace.h"
#include "netsim/system/simulation_config.h"

namespace tandem::netsim {

/// Phases of the clients' ticks within the server's.
enum class ClientPhases : std::uint8_t {
  kServers,  ///< all clients tick together, just before the server
  /// Drawn for each client and kept, as of devices with a clock of their own. The server has the time of arrival of
  /// each datagram.
  kDrawn,
  kShifted,  ///< as kDrawn, then each client shifts its ticks as the session begins (client/seat/tick_phase.h)
  /// As kShifted, but the shifts were made long ago: each client has the phase at which they rest. For constant delays.
  kRested,
};

/// Subject of a measurement: all parts of a scene that shape what hands feel, and the network.
struct FeelSetup {
  SceneSpec scene;        ///< channel, coupling, gate, alpha slew, device of the first masters, first tool
  LinkSpec network = {};  ///< network of every seat
  HandKind hands = HandKind::kDrawn;
  struct Recording {
    std::string name;
    std::shared_ptr<const hal::sim::RecordedMotion> motion;
  };
  std::vector<Recording> recordings = {};  ///< recordings that the leader plays in addition to the drawn motions
  ClientPhases phases = ClientPhases::kServers;
};

/// A hand of a probe: impedance and intended motion. Without a motion the hand's own model decides.
struct ProbeHand {
  HandSpec hand;
  std::shared_ptr<const hal::sim::RecordedMotion> motion = {};
};
/// A push at a handle.
struct ProbePush {
  std::size_t hand = 0;
  double at = 0;  ///< session time [s]
  hal::Vec3 force = hal::Vec3::Zero();
  double length = 0.1;  ///< [s]
};

/// One run of the simulation from which a number is taken. Hand 0 leads; the others, if present, follow.
struct ProbeRun {
  double length = 10;                 ///< session time [s]
  double start_x = 0;                 ///< start position of tips and tool [m]
  std::vector<ProbeHand> hands = {};  ///< 1 to kMastersMax
  EnvironmentSpec environment = {};   ///< environment of the tool
  std::vector<ProbePush> pushes = {};
  double share = 1;              ///< authority of hand 0; the others share the rest equally
  double hand_over_at = 0;       ///< time at which hand 1 receives all authority [s]; 0: never
  bool frictionless = false;     ///< devices and tool without Coulomb friction
  bool perfect_network = false;  ///< replaces the network to be measured
};

/// Returns a wall at x = 0 that fills x > 0. @param k  stiffness [N/m]
[[nodiscard]] EnvironmentSpec wall_of(double k);
inline constexpr double kBone = 20'000, kTissue = 300;  ///< [N/m]

/// Returns the configuration of a probe: that of FeelSetup with the probe's hands, environment and authority.
[[nodiscard]] SimulationConfig simulation_config_of(const FeelSetup& setup, const ProbeRun& run, std::uint64_t seed);

/// Runs a probe to its end. If the session cannot begin or never runs, the trace has `trouble` and no rows.
[[nodiscard]] FeelTrace run_probe(const FeelSetup& setup, const ProbeRun& run, std::uint64_t seed);

}  // namespace tandem::netsim
