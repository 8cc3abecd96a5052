#include <cstdio>

#include "common/io/command_line.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/service_query.h"
#include "server/app/commands/state_option.h"

namespace tandem::server {
namespace {

constexpr Duration kMoveMax = std::chrono::seconds(10);

struct MoveArguments {
  std::string session, to, config;
};

/// Why the session cannot move; empty: it can.
std::string move_problem(const ServiceQuery& service, const MoveArguments& arguments) {
  const auto listed = [](const auto& entries) {
    std::string names;
    for (const auto& [name, entry] : entries) names += (names.empty() ? "" : ", ") + name;
    return names.empty() ? std::string("none") : names;
  };
  if (service.catalogue().find(arguments.session) == nullptr)
    return "the service has no session \"" + arguments.session +
           "\"; its sessions: " + listed(service.catalogue().entries());
  if (service.view().server(arguments.to) == nullptr)
    return "no server \"" + arguments.to +
           "\" is registered in the service; its servers: " + listed(service.view().servers());
  const auto* const seen = service.view().session(arguments.session);
  if (seen == nullptr || !seen->owner)
    return "session " + arguments.session + " has no server now; a server takes it over when a client asks for it";
  return {};
}

int move_command(const MoveArguments& arguments) {
  const auto opened = ServiceQuery::open(arguments.config);
  if (!opened) {
    if (opened.error().code == io::kExitUsage) return print_usage_error("move", opened.error().text);
    return print_error("move", opened.error().text);
  }
  ServiceQuery& service = **opened;
  if (const std::string problem = move_problem(service, arguments); !problem.empty())
    return print_error("move", problem);
  if (service.view().session(arguments.session)->owner->name == arguments.to) {
    std::printf("session %s is at server %s already\n", arguments.session.c_str(), arguments.to.c_str());
    return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
  }
  service.begin({{}, {directory::Put{service.keys().move(arguments.session), arguments.to, 0}}, {}});
  const bool moved = service.wait(kMoveMax, [&] {
    const auto* const seen = service.view().session(arguments.session);
    return seen != nullptr && seen->owner && seen->owner->name == arguments.to;
  });
  if (!moved)
    return print_error("move", "session " + arguments.session +
                                   " did not move within 10 s; the log of its server has "
                                   "the cause, and `tandem-server servers` shows where it is");
  std::printf("session %s is at server %s now\n", arguments.session.c_str(), arguments.to.c_str());
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

}  // namespace

void add_move_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("move", "Moves a session of a service to another server.", move_command);
  command.add_option("SESSION", arguments.session, "name of the session").value_name(" ").required();
  command.add_option("--to", arguments.to, "name of the server, as `tandem-server servers` shows it")
      .value_name("SERVER")
      .required();
  command.add_option("--config", arguments.config, "configuration of one of the servers, with a block `directory`")
      .value_name("FILE")
      .required();
  command.footer(
      "The session's server releases all hands, stores the last snapshot and hands the session over; the clients join "
      "the other server by themselves.\n"
      "Exit: 0 the other server has it; 1 it did not move, or the directory does not answer; 2 wrong arguments or "
      "files.\n\n"
      "Examples\n"
      "  tandem-server move lab --to desk-b --config /etc/tandem/server.textproto\n"
      "  tandem-server move lab --to desk-a --config server.textproto");
}

}  // namespace tandem::server
