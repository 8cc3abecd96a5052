#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::client {

/// Adds `calibrate`, which measures known masses to fit a Falcon's force scale, and sets `action` when it was chosen.
void add_calibrate_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
