#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::server {

/// Each adds a subcommand that sets `action` when it was chosen.
void add_run_command(CLI::App& root, std::function<int()>& action);
void add_serve_command(CLI::App& root, std::function<int()>& action);
void add_sessions_command(CLI::App& root, std::function<int()>& action);
void add_stop_command(CLI::App& root, std::function<int()>& action);
void add_scenes_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::server
