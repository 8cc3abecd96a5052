#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "netsim/quality_text.h"
#include "netsim/world.h"

namespace tandem::netsim {

/// A session nobody would write by hand, drawn from one number: seats, roles, tools, gains, hands, environments, links, faults
/// (design notes, security 2.6). Until `calm` everything may go wrong; from then on nothing does.
struct SwarmCase {
  std::uint64_t seed = 0;
  std::string scene_text;  ///< as a scene file: what to run again, changed by hand
  std::string words;       ///< one line for people
  WorldSetup setup;
  Duration calm{};         ///< network time at which the safety phase ends
};

/// How long after the calm, and after the network has brought what it held then, all hands may take to be active again [s].
inline constexpr double kLivenessLimit = 10;
/// How long a session of ordinary motion is then watched [s].
inline constexpr double kOrdinary = 10;

/// @param safety_max  longest safety phase [s], at least 2
/// @param law         of hands, kSetPosition or kReplica
/// @throws std::logic_error if a drawn scene is not valid: a mistake of the generator, with the reason.
[[nodiscard]] SwarmCase draw_swarm_case(std::uint64_t seed, double safety_max = 40, LawKind law = LawKind::kSetPosition);

struct SwarmResult {
  std::vector<server::Violation> broken;  ///< of a promise that was made; expected ones are left out
  std::string trouble;                    ///< a seat that was refused, hands that were not active again
  double lived_s = 0;                     ///< virtual time
  double recovered_s = 0;                 ///< from the calm until everybody was active
  std::uint64_t fingerprint = 0;          ///< of every hand's place and force at every tick
  std::uint32_t gate_trips = 0;
  std::vector<NamedLink> links;           ///< every seat's, if the setup asked for it (`watch_quality`)
  [[nodiscard]] bool passed() const noexcept { return broken.empty() && trouble.empty(); }
};

/// Lives through a case: safety, then liveness. A person resets a gate that latched.
/// @param each_tick  for traces; may be empty
[[nodiscard]] SwarmResult live_swarm_case(const SwarmCase& which, const std::function<void(World&)>& each_tick = {});

}  // namespace tandem::netsim
