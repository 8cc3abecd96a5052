#include <cstdio>
#include <string>
#include <vector>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"
#include "proto/rpc/session_list_text.h"

namespace tandem::client {
namespace {

struct SessionsArguments {
  ConnectionArguments connection;
  bool json = false;
};

int sessions_command(const SessionsArguments& arguments) {
  io::UsageErrors errors;
  JoinOptions asking = connection_of(arguments.connection, errors);
  asking.timeout = timeout_of(arguments.connection.timeout, errors);
  if (!errors.empty()) return errors.print("");
  const io::Fd signals = io::make_signalfd();
  asking.signals = signals.get();
  const auto list = list_sessions(asking);
  if (!list) {
    io::print_formatted(stderr, "tandem-client sessions: %s\n", list.error().reason.c_str());
    return 1;
  }
  std::fputs((arguments.json ? session_list_json(*list) : session_list_text(*list)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_sessions_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "sessions", "Lists the sessions of a server: phases, seats free and taken, roles.", sessions_command);
  add_server_option(command, arguments.connection);
  add_state_option(command, arguments.connection.state);
  add_timeout_option(command, arguments.connection.timeout);
  command.add_flag("--json", arguments.json, "for machines");
  command.footer(
      "The workstation must be enrolled there; with a loopback server with ephemeral keys it need not. Exit: 0 done; 1 "
      "refused, or server not reachable; 2 wrong\n"
      "arguments.\n\n"
      "Examples\n"
      "  tandem-client sessions --server lab-server:7000\n"
      "  tandem-client sessions --server 127.0.0.1:7000 --json");
}

}  // namespace tandem::client
