#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::client {

/// Adds `sessions`, which lists the sessions of a server, and sets `action` when it was chosen.
void add_sessions_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
