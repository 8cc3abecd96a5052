#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::netsim {

/// Adds `run SCENE`: a whole session in virtual time.
void add_run_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
