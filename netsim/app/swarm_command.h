#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::netsim {

/// Adds `swarm` to the program. When it was chosen, `action` becomes what to run; its result is the exit code.
void add_swarm_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
