#pragma once

#include <string>
#include <vector>

#include "netsim/system/simulation_config.h"

namespace tandem::netsim {

class Simulation;

/// Begin and end of the session in network time. The network starts earlier, because hands must be engaged before a
/// session begins. Scripts, outages and faults use network time.
struct SessionSpan {
  Duration begin{}, end{};
};
[[nodiscard]] SessionSpan session_span(const Simulation& simulation);

/// Returns facts needed to understand the report, one line each. They name the events, outages and faults outside the
/// session, and the effect of a change of address on a seat.
[[nodiscard]] std::vector<std::string> session_notes(const SimulationConfig& setup, const SessionSpan& span);

/// Returns why a scene without an end cannot run in virtual time. @param remedy  setting that gives the scene an end
[[nodiscard]] std::string endless_scene_error(const std::string& scene, const std::string& remedy);

/// Returns, for `--check`, the events that the session reaches only if it begins late. The time of its begin is not yet
/// known.
[[nodiscard]] std::vector<std::string> late_notes(const SimulationConfig& setup);

/// Returns, for `--check`, the network of every seat with its numbers, its events and its clock. The text consists of
/// whole lines, each beginning with `indent`.
[[nodiscard]] std::string network_listing(const SimulationConfig& setup, const std::string& indent);

/// Returns the stiffness of the spring between a master's simulated device and its tool [N/m]: the scene's k_c, or less
/// where the device renders less.
[[nodiscard]] double granted_stiffness(const SceneSpec& scene, std::size_t seat);

}  // namespace tandem::netsim
