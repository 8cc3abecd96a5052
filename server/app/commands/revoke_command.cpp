#include <cstdio>

#include "common/io/command_line.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"

namespace tandem::server {
namespace {

struct RevokeArguments {
  std::string name, state;
};

int revoke_command(const RevokeArguments& arguments) {
  auto state = open_state(arguments.state);
  if (!state) return print_error("revoke", state.error());
  const auto book = state->registry().workstations();
  if (!book) return print_error("revoke", book.error());
  const auto gone = state->registry().revoke(arguments.name);
  if (!gone) return print_error("revoke", gone.error());
  if (gone->workstations + gone->codes == 0)
    return print_usage_error("revoke",
                             "NAME: " + unknown_workstation_text(arguments.name, *book, state->folder()->path()));
  record_command("revoke", *state, auth::wall_seconds(), "revoked", arguments.name);
  std::printf("%s: %s%s\n", arguments.name.c_str(),
              gone->workstations > 0 ? "the server rejects its key from now on" : "was not enrolled",
              gone->codes > 0 ? "; its enrolment string is void" : "");
  if (state->membership() != nullptr)
    std::printf(
        "the other servers of the service learn of it within a second, if this server runs and the directory "
        "answers; otherwise as soon as both do\n");
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

void add_revoke_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("revoke", "Revokes a workstation: its key, and its unused enrolment string.", revoke_command);
  command.add_option("NAME", arguments.name, "the workstation, as it was enrolled").value_name(" ").required();
  add_state_option(command, arguments.state);
  command.footer(
      "A running server rejects the next message of the workstation, and tickets issued for it. Within a second it "
      "releases the\n"
      "hand at its seat, and closes its other connections.\n"
      "Exit: 0 done; 1 the state folder cannot be used; 2 wrong arguments, or an unknown name.\n\n"
      "Examples\n"
      "  tandem-server revoke touch-07\n"
      "  tandem-server revoke touch-07 --state ./state");
}

}  // namespace tandem::server
