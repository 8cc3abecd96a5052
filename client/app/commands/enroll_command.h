#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::client {

/// Adds `enroll`, which registers this workstation at a server, and sets `action` when it was chosen.
void add_enroll_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
