#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace tandem::server {

/// Each adds a subcommand that sets `action` when it was chosen: who may join a server, kept in its state folder.
void add_init_command(CLI::App& root, std::function<int()>& action);
void add_enroll_command(CLI::App& root, std::function<int()>& action);
void add_ticket_command(CLI::App& root, std::function<int()>& action);
void add_revoke_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::server
