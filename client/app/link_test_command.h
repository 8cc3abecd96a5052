#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::client {

/// Adds `link-test`, which sets `action` when it was chosen.
void add_link_test_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
