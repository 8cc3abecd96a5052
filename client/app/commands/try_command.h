#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::client {

/// Adds `try`, which starts a server, simulated partners and the user's seat, and sets `action` when it was chosen.
void add_try_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
