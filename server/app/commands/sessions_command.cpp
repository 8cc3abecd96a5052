#include <algorithm>
#include <cstdio>

#include "common/io/clock.h"
#include "common/io/command_line.h"
#include "proto/rpc/session_list_text.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"
#include "server/app/control/session_registry.h"
#include "server/app/service/service_list_file.h"

namespace tandem::server {
namespace {

struct SessionsArguments {
  std::string state;
  bool json = false;
};

ServiceList without(ServiceList service, const rpc::SessionList& own) {
  std::erase_if(service.sessions, [&](const ServiceList::Session& session) {
    return std::ranges::find(own.sessions, session.listed.id, &rpc::ListedSession::id) != own.sessions.end();
  });
  return service;
}

int sessions_command(const SessionsArguments& arguments) {
  const auto state = open_state(arguments.state);
  if (!state) return print_error("sessions", state.error());
  const auto serving = state->serving().read();
  if (!serving) return print_error("sessions", serving.error());
  if (!*serving)
    return print_error("sessions",
                       no_server_text(state->folder()->path()) +
                           "; a server with ephemeral keys has no folder: tandem-client sessions --server HOST:PORT");
  rpc::SessionList list;
  std::vector<std::string> codes;
  for (const OpenSession& s : (*serving)->sessions) {
    const auto phase = rpc::session_phase_named(s.phase).value_or(rpc::SessionPhase::kWaiting);
    list.sessions.emplace_back(s.id, s.name, phase, s.seats);
    codes.push_back(s.code.empty() ? "" : code_text(s.code));
  }
  const auto service = read_service_list(*state->folder());
  if (!service) return print_error("sessions", service.error());
  std::string text = arguments.json ? session_list_json(list, codes) : session_list_text(list, codes);
  if (*service) {
    const ServiceList others = without(**service, list);
    if (arguments.json)
      text.insert(text.rfind('}'), ", \"service\": " + service_json(others, io::boottime_now()));
    else
      text = (list.sessions.empty() ? "this server serves no session now\n" : text) +
             service_text(others, io::boottime_now());
  }
  if (!arguments.json) std::printf("server at %s\n", (*serving)->address.c_str());
  std::fputs(text.c_str(), stdout);
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

void add_sessions_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("sessions", "Lists the sessions of the running server: codes, phases, seats.", sessions_command);
  command.alias("status");
  add_state_option(command, arguments.state);
  command.add_flag("--json", arguments.json, "for machines");
  command.footer(
      "`status` is an alias. The list is at most a second old. A server of a service names the sessions of its other "
      "servers below its own. Exit: 0 done; 1 no server runs from this folder, or "
      "it cannot be read; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server sessions --json\n"
      "  tandem-server sessions --state ./state");
}

}  // namespace tandem::server
