#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::netsim {

/// `tandem-netsim feel SCENE`: measures what hands feel. Sets `action` when it is chosen.
void add_feel_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
