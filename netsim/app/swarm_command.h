#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::netsim {

/// Adds `swarm` to the program. If the user chooses it, `action` becomes the function to run; its result is the exit
/// code.
void add_swarm_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
