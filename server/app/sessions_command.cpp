#include <cstdio>
#include <memory>

#include "proto/lobby_text.h"
#include "server/app/house.h"
#include "server/app/run_command.h"
#include "server/app/trust_option.h"

namespace tandem::server {
namespace {

struct SessionsArguments {
  std::string state;
  bool json = false;
};

control::SessionPhase phase_named(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(control::SessionPhase::kPassive); ++i)
    if (name == control::to_text(static_cast<control::SessionPhase>(i))) return static_cast<control::SessionPhase>(i);
  return control::SessionPhase::kWaiting;
}

int sessions_command(const SessionsArguments& arguments) {
  const auto state = open_state(arguments.state);
  if (!state) return trouble("sessions", state.error());
  const auto serving = state->read_serving();
  if (!serving) return trouble("sessions", serving.error());
  if (!*serving)
    return trouble("sessions", "no server runs from " + state->folder()->path() +
                                   "; one with keys made on the spot has no folder: tandem-client sessions --server HOST:PORT");
  control::SessionList list;
  std::vector<std::string> codes;
  for (const OpenSession& s : (*serving)->sessions) {
    control::ListedSession& out = list.sessions.emplace_back();
    out.id = s.id;
    out.name = s.name;
    out.phase = phase_named(s.phase);
    for (const OpenSeat& seat : s.seats) out.seats.push_back({seat.name, seat.role, seat.taken, seat.required});
    codes.push_back(s.code.empty() ? "" : code_text(s.code));
  }
  if (!arguments.json) std::printf("server at %s\n", (*serving)->address.c_str());
  std::fputs((arguments.json ? lobby_json(list, codes) : lobby_text(list, codes)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_sessions_command(CLI::App& root, std::function<int()>& action) {
  const auto arguments = std::make_shared<SessionsArguments>();
  CLI::App* const command = root.add_subcommand("sessions", "Lists the sessions of the running server: codes, phases, seats.");
  command->alias("status");
  add_state_option(*command, arguments->state);
  command->add_flag("--json", arguments->json, "for machines");
  command->footer(
      "`status` is the same. What it says is at most a second old. Exit: 0 done; 1 no server runs from this folder, or it cannot be read; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server sessions --json\n"
      "  tandem-server sessions --state ./state");
  command->callback([arguments, &action] { action = [arguments] { return sessions_command(*arguments); }; });
}

}  // namespace tandem::server
