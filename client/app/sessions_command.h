#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::client {

void add_sessions_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
