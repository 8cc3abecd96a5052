#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::netsim {

/// Adds `sweep`, which runs one scene over a grid of networks. `action` runs it and returns the exit code.
void add_sweep_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
