#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/auth/enrolment.h"
#include "common/auth/ticket.h"
#include "common/base/command_hints.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/command_line.h"
#include "common/io/reachable_address.h"
#include "proto/rpc/rpc_texts.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"
#include "server/app/service/service_list_file.h"
#include "server/policy/roles.h"

namespace tandem::server {
namespace {

constexpr std::int64_t kClockStep = 60;  // [s] by which the clocks of two servers may differ

struct TicketArguments {
  std::string session, seat, workstation, person, role, state, hours = "4", force = "100";
};

/// Sessions that the running server knows: its own, then those of its service.
std::vector<OpenSession> known_sessions(const std::optional<ServingSpec>& serving,
                                        const std::optional<ServiceList>& service) {
  std::vector<OpenSession> sessions = serving ? serving->sessions : std::vector<OpenSession>{};
  if (!serving || !service) return sessions;
  for (const ServiceList::Session& other : service->sessions) {
    if (std::ranges::find(sessions, other.listed.id, &OpenSession::id) != sessions.end()) continue;
    OpenSession session{other.listed.id, other.code, other.listed.name, 0, {}};
    for (const rpc::ListedSeat& seat : other.listed.seats)
      session.seats.push_back({seat.name, seat.role, false, seat.required});
    sessions.push_back(std::move(session));
  }
  return sessions;
}

/// Returns the part of a message about sessions that the list of a service lacks; empty: it lacks none.
std::string gap_of(const ServiceList& service) {
  switch (service.known) {
    case ServiceList::Known::kNothing:
      return ". The directory of the service has not answered this server yet, so sessions of other servers are not "
             "known; use the id, or try again when `tandem-server sessions` shows them";
    case ServiceList::Known::kOld:
      return ". The directory of the service does not answer now, so newer sessions of other servers are not known";
    case ServiceList::Known::kNow:
      break;
  }
  return {};
}

/// Session that the argument names by id, code or name.
std::expected<OpenSession, std::string> find_session(const std::string& typed,
                                                     const std::optional<ServingSpec>& serving,
                                                     const std::optional<ServiceList>& service,
                                                     const std::string& folder) {
  auth::Id16 id;
  const bool is_id = auth::from_hex(typed, id);
  const auto code = auth::canonical_session_code(typed);
  const OpenSession* found = nullptr;
  std::size_t same_name = 0;
  const std::vector<OpenSession> sessions = known_sessions(serving, service);
  for (const OpenSession& s : sessions) {
    if ((is_id && s.id == id) || (code && s.code == *code)) return s;
    if (s.name == typed && ++same_name == 1) found = &s;
  }
  if (same_name > 1)
    return std::unexpected("--session: \"" + typed + "\" is the name of " + std::to_string(same_name) +
                           " sessions; give the id or the code of one");
  if (found != nullptr) return *found;
  if (is_id) return OpenSession{id, "", "", 0, {}};  // an id of a future session: its seats are unknown
  if (!serving)
    return std::unexpected("--session: " + no_server_text(folder) +
                           ". Without a server only an id of 32 hex digits is accepted");
  return std::unexpected("--session: \"" + typed + "\" is neither id, code nor name of a session" +
                         (service ? " of the service; " : "; ") +
                         (!sessions.empty() ? suggest_name(typed, sessions)
                          : service         ? "the service has none"
                                            : "the server has none") +
                         (service ? gap_of(*service) : ""));
}

std::optional<AccessRole> find_role(const TicketArguments& arguments, const OpenSession& session,
                                    io::UsageErrors& errors) {
  std::optional<AccessRole> role;
  if (!arguments.role.empty()) {
    role = access_role_named(arguments.role);
    if (!role)
      errors.add("--role: \"" + arguments.role +
                 "\" must be instructor, trainee, evaluator, observer, operator or recorder");
  }
  const bool sits = !arguments.seat.empty();
  if (role && sits && (*role == AccessRole::kOperator || *role == AccessRole::kRecorder)) {
    errors.add("--seat: the role " + std::string(to_text(*role)) + " has none");
    return role;
  }
  if (arguments.seat.empty() || session.seats.empty()) {
    if (arguments.role.empty())
      errors.add(arguments.seat.empty() ? "--seat is required, or a --role for a console without a seat"
                                        : "--role is required: the session's seats are not known here");
    return role;
  }
  const auto seat = std::ranges::find(session.seats, arguments.seat, &OpenSeat::name);
  if (seat == session.seats.end()) {
    errors.add("--seat: the session has no seat \"" + arguments.seat + "\"; " +
               suggest_name(arguments.seat, session.seats));
    return role;
  }
  if (role && *role != seat->role)
    errors.add("--role: seat " + seat->name + " is one for " + std::string(to_text(seat->role)) + ", not for " +
               std::string(to_text(*role)));
  return seat->role;
}

int ticket_command(const TicketArguments& arguments) {
  io::UsageErrors errors;
  std::string hours = arguments.hours;
  errors.add("--hours", io::number_in(0.01, 12, "h")(hours));
  const double force_percent = errors.number("--force", arguments.force, 0.1, 100, "%");
  auto state = open_state(arguments.state);
  if (!state) return errors.empty() ? print_error("ticket", state.error()) : print_usage_errors("ticket", errors);
  const auto serving = state->serving().read();
  if (!serving) return print_error("ticket", serving.error());
  const auto book = state->registry().workstations();
  if (!book) return print_error("ticket", book.error());
  const WorkstationRow* const workstation = auth::find_workstation(*book, arguments.workstation);
  if (workstation == nullptr)
    errors.add("--workstation: " + unknown_workstation_text(arguments.workstation, *book, state->folder()->path()) +
               (state->membership() == nullptr
                    ? ""
                    : "; if another server of the service has just enrolled it, try again in a second"));
  const std::int64_t now = auth::wall_seconds();
  if (workstation != nullptr && workstation->enrolled_at > now + kClockStep)
    errors.add("--workstation: by the clock of this server, " + arguments.workstation +
               format(" is enrolled %lld s later than now, and no ticket of before counts: the clock of a server is "
                      "wrong, or was. Set it, then `tandem-server revoke ",
                      static_cast<long long>(workstation->enrolled_at - now)) +
               arguments.workstation + "` and enrol it again");
  std::expected<std::optional<ServiceList>, std::string> service;
  if (*serving) service = read_service_list(*state->folder());
  if (!service) return print_error("ticket", service.error());
  const auto session = find_session(arguments.session, *serving, *service, state->folder()->path());
  std::optional<AccessRole> role;
  if (session) {
    role = find_role(arguments, *session, errors);
  } else {
    errors.add(session.error());
  }
  if (!arguments.person.empty() && !rpc::is_name(arguments.person))
    errors.add("--person: \"" + sanitize(arguments.person, 64) + "\" must be 1 to 32 characters of A-Z a-z 0-9 _ -");
  if (!errors.empty() || !role) return print_usage_errors("ticket", errors);

  const auth::Ticket ticket{.ticket_id = auth::random_bytes<auth::Id16>(),
                            .session_id = session->id,
                            .seat = arguments.seat,
                            .role = *role,
                            .workstation = {workstation->spki},
                            .force_scale = static_cast<std::uint16_t>(std::lround(force_percent * 10.0)),
                            .not_before = std::max(now, workstation->enrolled_at),  // by another server's clock
                            .not_after = now + static_cast<std::int64_t>(std::stod(hours) * 3600.0),
                            .epoch_min = session->epoch,
                            .person = arguments.person};
  const auto bytes = auth::sign_ticket(ticket, state->ticket_key());
  if (!bytes) return print_usage_error("ticket", "the ticket cannot be made: " + bytes.error());
  record_command("ticket", *state, now, "ticket", workstation->name,
                 auth::to_hex(ticket.ticket_id) + " " + ticket.seat + " " + std::string(to_text(ticket.role)) +
                     (ticket.person.empty() ? "" : " for " + ticket.person));
  std::printf("%s\n", auth::ticket_text(*bytes).c_str());
  const std::string address = *serving ? shell_quote(io::reachable_address((*serving)->address)) : "HOST:PORT";
  const std::string what = arguments.seat.empty() && watches_only(*role) ? "watch --server " + address
                           : arguments.seat.empty()
                               ? "control --server " + address
                               : "join --server " + address + " --seat " + arguments.seat + " --device sim";
  std::fprintf(stderr,
               "valid once, for %s h, on %s only; write it to FILE there, then type\n  tandem-client %s --ticket-file "
               "FILE\n(every user of that computer can read --ticket TICKET)\n",
               hours.c_str(), workstation->name.c_str(), what.c_str());
  const auto at = *serving ? io::parse_address((*serving)->address, 0) : std::unexpected(std::string());
  if (const std::string note = at ? io::only_here_note(*at, io::reachable_address(*at)) : ""; !note.empty())
    std::fprintf(stderr, "%s\n", note.c_str());
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

void add_ticket_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("ticket",
                       "Writes a join ticket: the right of one workstation to take one seat "
                       "of one session, or to operate it from a console, once.",
                       ticket_command);
  command
      .add_option("--session", arguments.session,
                  "required: id (32 hex digits), code (10 characters) or name of the session")
      .value_name("ID|CODE|NAME")
      .required();
  command
      .add_option("--seat", arguments.seat,
                  "the seat's name; none for a console. A trainee or observer without a seat only watches")
      .value_name("SEAT");
  command.add_option("--workstation", arguments.workstation, "required: the only workstation that may use it")
      .value_name("NAME")
      .required();
  command
      .add_option("--person", arguments.person,
                  "name of the person who gets it, for the audit log, notes and screens: A-Z a-z 0-9 _ -, at most 32")
      .value_name("NAME");
  command
      .add_option("--role", arguments.role,
                  "instructor, trainee, evaluator, observer, operator, recorder; default: the seat's")
      .value_name("ROLE");
  command.add_option("--hours", arguments.hours, "validity [h], 0.01 to 12; default 4").value_name("H");
  command.add_option("--force", arguments.force, "of the scene's force limit [%], 0.1 to 100; default 100")
      .value_name("PERCENT");
  add_state_option(command, arguments.state);
  command.footer(
      "Prints the ticket to standard output. It cannot be changed, used twice or used on another workstation. Codes "
      "and names, and the\n"
      "role of a seat, are known while the server runs; a server of a service knows those of the whole service.\n"
      "Exit: 0 done; 1 the state folder cannot be used; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server ticket --session contact --seat trainee --workstation touch-07 --person ann\n"
      "  tandem-server ticket --session contact --role operator --workstation office     # for `tandem-client "
      "control`");
}

}  // namespace tandem::server
