#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::netsim {

/// Adds `run SCENE`, which runs a whole session in virtual time.
void add_run_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
