#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::server {

/// Add the other subcommands. Each sets `action` when it is chosen.
void add_run_command(CLI::App& root, std::function<int()>& action);
void add_serve_command(CLI::App& root, std::function<int()>& action);
void add_sessions_command(CLI::App& root, std::function<int()>& action);
void add_stop_command(CLI::App& root, std::function<int()>& action);
void add_scenes_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::server
