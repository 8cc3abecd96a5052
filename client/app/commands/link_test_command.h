#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::client {

/// Adds `link-test`, which measures the link to a server, and sets `action` when it was chosen.
void add_link_test_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
