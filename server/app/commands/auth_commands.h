#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tandem::server {

/// Add the subcommands that administer the state directory: keys, workstations, codes and tickets. Each sets `action`
/// when it is chosen.
void add_init_command(CLI::App& root, std::function<int()>& action);
void add_enroll_command(CLI::App& root, std::function<int()>& action);
void add_ticket_command(CLI::App& root, std::function<int()>& action);
void add_revoke_command(CLI::App& root, std::function<int()>& action);

}  // namespace tandem::server
