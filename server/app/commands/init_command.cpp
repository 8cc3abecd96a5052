#include <cstdio>

#include "common/io/command_line.h"
#include "common/io/print.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"

namespace tandem::server {
namespace {

struct InitArguments {
  std::string state;
  bool new_ticket_key = false;
};

int init_command(const InitArguments& arguments) {
  const auto path = auth::server_state_path(arguments.state);
  if (!path) return print_usage_error("init", path.error());
  const std::int64_t now = auth::wall_seconds();
  if (arguments.new_ticket_key) {
    if (const std::string problem = auth::ServerKeystore::rotate_ticket_key(*path, now); !problem.empty())
      return print_error("init", problem);
    std::printf(
        "state folder %s\nnew ticket key: every ticket issued before is void; workstations and codes stay valid\n",
        path->c_str());
  } else {
    const auto fingerprint = auth::ServerKeystore::init(*path, now);
    if (!fingerprint) return print_error("init", fingerprint.error());
    if (auto made = auth::ServerKeystore::open(*path))
      record_command("init", *made, now, "init", "", fingerprint->hex());
    std::printf("state folder %s\nserver key   %s\n", path->c_str(), fingerprint->hex().c_str());
    io::print_formatted(stderr, "next, once for each workstation: tandem-server enroll NAME --address HOST:PORT%s\n",
                        auth::server_state_option(*path).c_str());
  }
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

void add_init_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "init", "Creates a server's keys and empty registries, once; required before it may listen on a network.",
      init_command);
  add_state_option(command, arguments.state);
  command.add_flag("--new-ticket-key", arguments.new_ticket_key,
                   "replaces only the key that signs tickets, in an existing folder: every ticket issued before is "
                   "void; no server may run from it");
  command.footer(
      "The folder gets mode 0700, its files 0600; a user who can read them can impersonate this server. Run this "
      "command as the user of the server.\n"
      "Prints the SHA-256 of the server's key, by which workstations recognise it.\n"
      "Exit: 0 done; 1 it exists already or cannot be written; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server init\n"
      "  tandem-server init --state ./state");
}

}  // namespace tandem::server
