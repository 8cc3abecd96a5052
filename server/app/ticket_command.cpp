#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "common/base/printed_command.h"
#include "common/io/number_option.h"
#include "common/io/own_address.h"
#include "common/trust/enrolment.h"
#include "common/trust/ticket.h"
#include "server/app/trust_commands.h"
#include "server/app/trust_option.h"
#include "server/roles.h"

namespace tandem::server {
namespace {

struct TicketArguments {
  std::string session, seat, workstation, role, state, hours = "4", force = "100";
};

/// The session that a person means, among those of the running server.
std::expected<OpenSession, std::string> find_session(const std::string& typed, const std::optional<ServingSpec>& serving) {
  trust::Id16 id;
  const bool is_id = trust::from_hex(typed, id);
  const auto code = trust::canonical_session_code(typed);
  std::vector<std::string> names;
  const OpenSession* found = nullptr;
  std::size_t same_name = 0;
  const std::vector<OpenSession> none;
  for (const OpenSession& s : serving ? serving->sessions : none) {
    names.push_back(s.name);
    if ((is_id && s.id == id) || (code && s.code == *code)) return s;
    if (s.name == typed && ++same_name == 1) found = &s;
  }
  if (same_name > 1)
    return std::unexpected("--session: \"" + typed + "\" is the name of " + std::to_string(same_name) + " sessions; give the id or the code of one");
  if (found != nullptr) return *found;
  if (is_id) return OpenSession{id, "", "", 0, {}};  // of a session that will run: nothing is known of its seats
  if (!serving) return std::unexpected("--session: no server runs from this state folder, so only an id of 32 hex digits can be understood");
  return std::unexpected("--session: \"" + typed + "\" is neither id, code nor name of a session; " +
                         (names.empty() ? "the server has none" : suggest(typed, names)));
}

std::optional<AccessRole> find_role(const TicketArguments& arguments, const OpenSession& session, std::vector<std::string>& mistakes) {
  std::optional<AccessRole> role;
  if (!arguments.role.empty()) {
    role = access_role_named(arguments.role);
    if (!role) mistakes.push_back("--role: \"" + arguments.role + "\" must be instructor, trainee, evaluator, observer, operator or recorder");
  }
  const bool sits = !arguments.seat.empty();
  if (role && (sits ? *role == AccessRole::kOperator || *role == AccessRole::kRecorder : !may_stand(*role))) {
    mistakes.push_back(!sits ? "--seat is required: the role " + std::string(to_text(*role)) + " sits on one; without a seat: instructor, operator, recorder"
                                              : "--seat: the role " + std::string(to_text(*role)) + " sits on none");
    return role;
  }
  if (arguments.seat.empty() || session.seats.empty()) {
    if (arguments.role.empty())
      mistakes.push_back(arguments.seat.empty() ? "--seat is required, or a --role that needs none: operator, recorder, instructor"
                                                : "--role is required: the session's seats are not known here");
    return role;
  }
  const auto seat = std::ranges::find(session.seats, arguments.seat, &OpenSeat::name);
  if (seat == session.seats.end()) {
    std::vector<std::string> names;
    for (const OpenSeat& s : session.seats) names.push_back(s.name);
    mistakes.push_back("--seat: the session has no seat \"" + arguments.seat + "\"; " + suggest(arguments.seat, names));
    return role;
  }
  if (role && *role != seat->role)
    mistakes.push_back("--role: seat " + seat->name + " is one for " + std::string(to_text(seat->role)) + ", not for " + std::string(to_text(*role)));
  return seat->role;
}

int ticket_command(const TicketArguments& arguments) {
  std::vector<std::string> mistakes;
  std::string hours = arguments.hours, force = arguments.force;
  if (const auto problem = io::number_in(0.01, 12, "h")(hours); !problem.empty()) mistakes.push_back("--hours: " + problem);
  if (const auto problem = io::number_in(0.1, 100, "%")(force); !problem.empty()) mistakes.push_back("--force: " + problem);
  auto state = open_state(arguments.state);
  if (!state) return mistakes.empty() ? trouble("ticket", state.error()) : wrong("ticket", mistakes);
  const auto serving = state->read_serving();
  if (!serving) return trouble("ticket", serving.error());
  const auto book = state->workstations();
  if (!book) return trouble("ticket", book.error());
  const WorkstationRow* const workstation = trust::find_workstation(*book, arguments.workstation);
  if (workstation == nullptr) mistakes.push_back("--workstation: " + no_workstation(arguments.workstation, *book, state->folder()->path()));
  const auto session = find_session(arguments.session, *serving);
  std::optional<AccessRole> role;
  if (session) {
    role = find_role(arguments, *session, mistakes);
  } else {
    mistakes.push_back(session.error());
  }
  if (!mistakes.empty() || !role) return wrong("ticket", mistakes);

  trust::Ticket ticket;
  trust::fill_random(ticket.ticket_id);
  ticket.session_id = session->id;
  ticket.seat = arguments.seat;
  ticket.role = *role;
  ticket.workstation.sha256 = workstation->spki;
  ticket.force_scale = static_cast<std::uint16_t>(std::lround(std::stod(force) * 10.0));
  ticket.not_before = trust::wall_seconds();
  ticket.not_after = ticket.not_before + static_cast<std::int64_t>(std::stod(hours) * 3600.0);
  ticket.epoch_min = session->epoch;
  const auto bytes = trust::sign_ticket(ticket, state->ticket_key());
  if (!bytes) return wrong("ticket", {"the ticket cannot be made: " + bytes.error()});
  state->audit(ticket.not_before, "ticket", workstation->name, trust::to_hex(ticket.ticket_id) + " " + ticket.seat + " " + std::string(to_text(ticket.role)));
  tell_audit_trouble("ticket", *state);
  std::printf("%s\n", trust::ticket_text(*bytes).c_str());
  const std::string address = *serving ? shell_word(io::dialable((*serving)->address)) : "HOST:PORT";
  const std::string what = arguments.seat.empty() ? "control --server " + address : "join --server " + address + " --seat " + arguments.seat + " --device sim";
  std::fprintf(stderr, "good once, for %s h, on %s only; write it to FILE there, then type\n  tandem-client %s --ticket-file FILE\n(--ticket TICKET is seen by everybody on that computer)\n", hours.c_str(),
               workstation->name.c_str(), what.c_str());
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

void add_ticket_command(CLI::App& root, std::function<int()>& action) {
  const auto arguments = std::make_shared<TicketArguments>();
  CLI::App* const command = root.add_subcommand("ticket", "Writes a join ticket: the right of one workstation to take one seat of one session, or to look after it without one, once.");
  command->add_option("--session", arguments->session, "required: id (32 hex digits), code (10 characters) or name of the session")
      ->option_text("ID|CODE|NAME")
      ->required();
  command->add_option("--seat", arguments->seat, "the seat's name; none for an operator, a recorder, or an instructor at a console")->option_text("SEAT");
  command->add_option("--workstation", arguments->workstation, "required: the only workstation that may use it")->option_text("NAME")->required();
  command->add_option("--role", arguments->role, "instructor, trainee, evaluator, observer, operator, recorder; default: the seat's")->option_text("ROLE");
  command->add_option("--hours", arguments->hours, "how long it is good [h], 0.01 to 12; default 4")->option_text("H");
  command->add_option("--force", arguments->force, "of the scene's force limit [%], 0.1 to 100; default 100")->option_text("PERCENT");
  add_state_option(*command, arguments->state);
  command->footer(
      "Prints the ticket to standard output. It cannot be changed, used twice or used on another workstation. Codes and names, and the\n"
      "role of a seat, are known while the server runs.\n"
      "Exit: 0 done; 1 the state folder cannot be used; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server ticket --session contact --seat trainee --workstation touch-07\n"
      "  tandem-server ticket --session contact --role operator --workstation office     # for `tandem-client control`");
  command->callback([arguments, &action] { action = [arguments] { return ticket_command(*arguments); }; });
}

}  // namespace tandem::server
