#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::client {

/// Adds `join`, which attaches a device to a seat of a session, and sets `action` when it was chosen.
void add_join_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
