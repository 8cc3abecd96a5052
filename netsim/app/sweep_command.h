#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::netsim {

/// `tandem-netsim sweep`: one scene over a grid of networks. `action` runs it and returns the exit code.
void add_sweep_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
