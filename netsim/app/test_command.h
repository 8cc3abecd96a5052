#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::netsim {

/// `tandem-netsim test`: verdicts for CI. `action` runs it and returns the exit code.
void add_test_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
