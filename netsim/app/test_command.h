#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::netsim {

/// Adds `test`, which gives verdicts for CI. `action` runs it and returns the exit code.
void add_test_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::netsim
