#include <cstdio>

#include "common/auth/enrolment.h"
#include "common/auth/ticket.h"
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

constexpr const char* kAny = "any";  // typed for every server, unless one has this name

std::string names_of(const auto& entries) {
  std::string names;
  for (const auto& [name, entry] : entries) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? std::string("none") : names;
}

/// Name of the session that the argument names by id, code or name; empty: there is none.
std::string session_named(const ServiceCatalogue& catalogue, const std::string& typed) {
  if (std::string name = catalogue.name_of(rpc::SessionChoice{typed}); !name.empty()) return name;
  if (auth::Id16 id; typed.size() == 2 * id.size() && auth::from_hex(typed, id))
    return catalogue.name_of(rpc::SessionChoice{id});
  const auto code = auth::canonical_session_code(typed);
  return code ? catalogue.name_of(rpc::SessionChoice{*code}) : std::string{};
}

/// Why the order cannot be carried out; empty: it can. @param session  name in the catalogue; empty: there is none
std::string move_problem(const ServiceQuery& service, const MoveArguments& arguments, const std::string& session,
                         bool anywhere) {
  if (session.empty())
    return "the service has no session \"" + arguments.session +
           "\", neither by name, code nor id; its sessions: " + names_of(service.catalogue().entries()) +
           (service.catalogue().entries().empty() ? ", in " + service.place() : "");
  if (!anywhere && service.view().server(arguments.to) == nullptr)
    return "no server \"" + arguments.to +
           "\" is registered in the service; its servers: " + names_of(service.view().servers());
  const auto* const seen = service.view().session(session);
  if (seen == nullptr || !seen->owner)
    return "session " + session + " has no server now; a server takes it over when a client asks for it";
  return {};
}

int report(const std::string& text) {
  std::printf("%s\n", text.c_str());
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

/// Server at which an operator wants the session; empty: any.
std::string home_of(const ServiceQuery& service, const std::string& session) {
  const auto found = service.catalogue().entries().find(session);
  return found == service.catalogue().entries().end() ? std::string{} : found->second.home;
}

/// Lets a session stay at the server that has it, or be moved by the service again.
/// @param home  that server; empty: any
int keep_session(ServiceQuery& service, const std::string& session, const std::string& home) {
  const std::string at =
      "session " + session + (home.empty() ? " may be at any server" : " is at server " + home + " already");
  if (home_of(service, session) == home) return report(at + (home.empty() ? " already" : ", and stays there"));
  service.begin(
      {{}, {directory::Put{service.keys().move(session), home.empty() ? ServiceKeys::kAnyServer : home, 0}}, {}});
  if (service.wait(kMoveMax, [&] { return home_of(service, session) == home; }))
    return report(at + (home.empty() ? " now" : "; from now on it stays there"));
  return print_error("move", "the server of session " + session +
                                 " did not take the order within 10 s; `tandem-server servers` says whether it is "
                                 "registered, and whether it has an older version, which does not know this order");
}

int move_command(const MoveArguments& arguments) {
  const auto opened = ServiceQuery::open(arguments.config);
  if (!opened) {
    if (opened.error().code == io::kExitUsage) return print_usage_error("move", opened.error().text);
    return print_error("move", opened.error().text);
  }
  ServiceQuery& service = **opened;
  const std::string session = session_named(service.catalogue(), arguments.session);
  const bool anywhere = arguments.to == kAny && service.view().server(kAny) == nullptr;
  if (const std::string problem = move_problem(service, arguments, session, anywhere); !problem.empty())
    return print_error("move", problem);
  if (anywhere || service.view().session(session)->owner->name == arguments.to)
    return keep_session(service, session, anywhere ? std::string{} : arguments.to);
  service.begin({{}, {directory::Put{service.keys().move(session), arguments.to, 0}}, {}});
  const bool moved = service.wait(kMoveMax, [&] {
    const auto* const seen = service.view().session(session);
    return seen != nullptr && seen->owner && seen->owner->name == arguments.to;
  });
  if (!moved)
    return print_error("move", "session " + session +
                                   " did not move within 10 s; `tandem-server servers` shows where it is, and a line "
                                   "MOVES in the log of its server whether it took the order");
  return report("session " + session + " is at server " + arguments.to + " now");
}

}  // namespace

void add_move_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("move", "Moves a session of a service to another server.", move_command);
  command.add_option("SESSION", arguments.session, "name, code or id of the session").value_name(" ").required();
  command
      .add_option(
          "--to", arguments.to,
          "name of the server, as `tandem-server servers` shows it; `any`: it stays where it is, and the service may "
          "move it again")
      .value_name("SERVER")
      .required();
  command.add_option("--config", arguments.config, "configuration of one of the servers, with a block `directory`")
      .value_name("FILE")
      .required();
  command.footer(
      "The session's server releases all hands, stores the last snapshot and hands the session over; the clients join "
      "the other server by themselves. It stays there, unless that server drains or fails, until `--to any`; so "
      "does a session that is there already.\n"
      "Exit: 0 the named server has it, or it may move again; 1 it did not move, or the directory does not answer; 2 "
      "wrong arguments or "
      "files.\n\n"
      "Examples\n"
      "  tandem-server move lab --to desk-b --config /etc/tandem/server.textproto\n"
      "  tandem-server move lab --to any --config server.textproto");
}

}  // namespace tandem::server
