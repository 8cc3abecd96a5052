#pragma once

#include <string>
#include <vector>

#include "netsim/world_setup.h"

namespace tandem::netsim {

class World;

/// The session within the network's time, which begins earlier: hands must be engaged first. Times of scripts, outages
/// and faults are the network's.
struct SessionSpan {
  Duration begin{}, end{};
};
[[nodiscard]] SessionSpan session_span(const World& world);

/// What a reader of the report must know to understand it, one line each: events, outages and faults that the session
/// did not live through, and what a change of address did to a seat.
[[nodiscard]] std::vector<std::string> session_notes(const WorldSetup& setup, const SessionSpan& span);

/// Why a scene without an end cannot be run in virtual time as it is. @param remedy  what gives it one
[[nodiscard]] std::string no_end(const std::string& scene, const std::string& remedy);

/// For `--check`, when nobody knows yet when the session will begin: what it can only live through if that is late.
[[nodiscard]] std::vector<std::string> late_notes(const WorldSetup& setup);

/// For `--check`: the network of every seat with its numbers, what happens to it when, clocks. Whole lines, each beginning
/// with `indent`.
[[nodiscard]] std::string network_listing(const WorldSetup& setup, const std::string& indent);

}  // namespace tandem::netsim
