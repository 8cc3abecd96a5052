#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::client {

/// `tandem-client weigh`: takes the known-mass readings from which a Falcon's force scale is fitted.
void add_weigh_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
