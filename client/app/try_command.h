#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::client {

/// `try`: a server, a simulated partner and the person's own hand from one command.
void add_try_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
