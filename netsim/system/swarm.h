#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "netsim/quality/quality_text.h"
#include "netsim/system/simulation.h"

namespace tandem::netsim {

/// A random session, drawn from one number: seats, roles, tools, gains, hands, environments, links, faults.
/// Faults occur only in the fault phase, which ends at `recovery_start`.
struct SwarmCase {
  std::uint64_t seed = 0;
  std::string scene_text;   ///< the scene file, so that a user can edit it and run it again
  std::string description;  ///< one line for reports
  SimulationConfig setup;
  Duration recovery_start{};  ///< network time at which the fault phase ends and the recovery phase begins
};

/// Longest time until all hands are active in the recovery phase [s]. It starts when the network has delivered every
/// datagram of the fault phase.
inline constexpr double kRecoveryLimit = 10;
/// Time for which a session of ordinary motion is then checked [s].
inline constexpr double kOrdinaryMotionDuration = 10;

/// Draws the case of a seed.
/// @param safety_max  longest fault phase [s], at least 2
/// @param law         law of the hands, kSetPosition or kReplica
/// @throws std::logic_error if a drawn scene is not valid: a bug of the generator, with the reason.
[[nodiscard]] SwarmCase generate_swarm_case(std::uint64_t seed, double safety_max = 40,
                                            LawKind law = LawKind::kSetPosition);

struct SwarmResult {
  std::vector<server::Violation> violations;  ///< expected violations are left out
  std::string trouble;  ///< a seat whose join was rejected, hands that did not become active again
  double lived_s = 0;   ///< virtual time
  /// From the begin of the recovery phase, or the delivery of the last datagram from before it, until all hands were
  /// active [s].
  double recovered_s = 0;
  std::uint64_t fingerprint = 0;  ///< hash of every hand's position and force at every tick
  std::uint32_t gate_trips = 0;
  std::vector<NamedLink> links;  ///< of every seat, if the setup requested them (`monitor_quality`)
  [[nodiscard]] bool passed() const noexcept { return violations.empty() && trouble.empty(); }
};

/// Runs a case: fault phase, then recovery phase. A simulated user resets each latched gate.
/// @param each_tick  called after every tick, for traces; may be empty
[[nodiscard]] SwarmResult run_swarm_case(const SwarmCase& which,
                                         const std::function<void(Simulation&)>& each_tick = {});

}  // namespace tandem::netsim
