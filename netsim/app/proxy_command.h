#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::netsim {

/// Adds `proxy` to the program. If the user chooses it, `action` becomes the function to run; its result is the exit
/// code.
void add_proxy_command(CLI::App& root, std::function<int()>& action);

/// Adds `control PATH COMMAND...`, which sends a command to a running proxy.
void add_control_command(CLI::App& root, std::function<int()>& action);

/// Adds `profiles [NAME]`, which lists or previews networks.
void add_profiles_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
