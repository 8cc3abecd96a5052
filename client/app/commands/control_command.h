#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::client {

/// Adds `control`, which operates a session without a seat, and sets `action` when it was chosen.
void add_control_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
