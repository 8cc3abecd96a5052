#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::client {

/// `tandem-client control`: stops, resumes and looks after a session without sitting in it.
void add_control_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::client
