#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::netsim {

/// Adds `proxy` to the program. When it was chosen, `action` becomes what to run; its result is the exit code.
void add_proxy_command(CLI::App& root, std::function<int()>& action);

/// Adds `control PATH COMMAND...`: a word to a running proxy.
void add_control_command(CLI::App& root, std::function<int()>& action);

/// Adds `profiles [NAME]`.
void add_profiles_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
