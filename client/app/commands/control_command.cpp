#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "client/app/console_client.h"
#include "client/app/console_commands.h"
#include "client/app/console_lines.h"
#include "common/base/sanitize.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"

namespace tandem::client {
namespace {

struct ControlArguments {
  ConnectionArguments connection;
  std::string role;
  std::vector<std::string> words;
  bool json = false;
};

/// Says that the session is lost. @return the exit code, which is the same after mistakes of typing
int tell_gone(bool person) {
  io::print_formatted(
      stderr,
      "%standem-client control: the server ended this connection: it was stopped, is being restarted, or withdrew its "
      "rights.\n"
      "Orders after that were not carried out. To continue, start again; if your ticket is refused, with a new one "
      "(`tandem-server ticket` on the server)\n",
      person ? "\n" : "");
  return io::kExitTrouble;
}

/// Says for each line that a person typed while the console was not connected that it was not carried out: seconds
/// later its order may surprise. @return the number of these lines, and whether one of them quits the console
std::pair<std::size_t, bool> drop_orders(const ConsoleLines::Arrived& arrived) {
  std::size_t orders = 0;
  for (const std::string& line : arrived.lines) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    const auto wish = parse_command(words);
    if (wish && std::holds_alternative<QuitCommand>(*wish)) return {orders, true};
    ++orders;
    io::print(stderr, "tandem-client control: not carried out, because this console was not connected: " +
                          sanitize(line) + "\n");
  }
  if (!words_of(arrived.begun).empty()) {
    ++orders;
    io::print(stderr, "tandem-client control: the line that you had begun is dropped, type it again: " +
                          sanitize(arrived.begun) + "\n");
  }
  return {orders, false};
}

/// Executes the commands of standard input line by line.
/// @return the largest exit code; kExitTrouble if the session was lost or lines were not carried out
int converse(ConsoleClient& attendant, int signals) {
  const bool person = isatty(STDIN_FILENO) == 1;
  const std::string prompt =
      attendant.welcome().session_name + " (" + std::string(to_text(attendant.welcome().role)) + ")> ";
  if (person) std::printf("the connection stays open until you quit; `help` lists the commands\n");
  ConsoleLines lines(signals, attendant.connection(), STDIN_FILENO, prompt);
  int worst = io::kExitDone;
  bool dropped = false;  // lines were not carried out
  const auto ending = [&] { return dropped ? io::kExitTrouble : worst; };
  bool waiting = false;  // the prompt is already shown
  while (true) {
    if (person && !waiting) lines.show_prompt();
    std::fflush(stdout);
    const auto line = lines.next();
    if (!line && lines.idle()) {
      const auto became = attendant.poll_status();
      waiting = became == ConsoleClient::PollResult::kNothing;
      if (became != ConsoleClient::PollResult::kGone) continue;
    }
    waiting = false;
    if (lines.server_gone() || (!line && lines.idle())) {
      if (!attendant.drained()) {
        const bool there = attendant.follow();
        const auto [orders, quits] = drop_orders(lines.take_arrived());
        dropped = dropped || orders > 0;
        if (!there) return tell_gone(person);
        if (quits) return ending();
        lines.set_server(attendant.connection());
        continue;
      }
      std::printf("%s%s has ended: the drain is complete\n", person ? "\n" : "", attendant.drained_server().c_str());
      return ending();
    }
    if (!line) return ending();
    const auto words = words_of(*line);
    if (words.empty()) continue;
    const auto wish = parse_command(words);
    int code = io::kExitUsage;
    if (wish) {
      if (std::holds_alternative<QuitCommand>(*wish)) return ending();
      code = attendant.execute(*wish);
    } else {
      io::print_formatted(stderr, "tandem-client control: %s\n", wish.error().c_str());
    }
    worst = std::max(worst, code);
  }
}

int control_command(const ControlArguments& arguments) {
  io::UsageErrors errors;
  JoinOptions asking = connection_of(arguments.connection, errors);
  asking.timeout = timeout_of(arguments.connection.timeout, errors);
  std::optional<ConsoleCommand> wish;
  if (!arguments.words.empty()) {
    auto understood = parse_command(arguments.words);
    if (understood) {
      wish = std::move(*understood);
    } else {
      errors.add(understood.error());
    }
  }
  asking.console = wish ? role_for(*wish) : AccessRole::kOperator;
  asking.drains = wish && std::holds_alternative<rpc::Drain>(*wish);
  if (!arguments.role.empty()) {
    const auto role = access_role_named(arguments.role);
    const bool stands = role && (*role == AccessRole::kInstructor || *role == AccessRole::kEvaluator ||
                                 *role == AccessRole::kOperator || *role == AccessRole::kRecorder);
    if (!stands) errors.add("--role: \"" + arguments.role + "\" must be operator, instructor, evaluator or recorder");
    if (stands) asking.console = role;
  }
  asking.ticket = ticket_of(arguments.connection.ticket, errors);
  if (!errors.empty()) return errors.print("tandem-client control: ");
  if (wish && std::holds_alternative<HelpCommand>(*wish))
    return std::fputs(console_commands_help(), stdout) < 0 ? io::kExitTrouble : io::kExitDone;
  if (wish && std::holds_alternative<QuitCommand>(*wish)) return io::kExitDone;
  const io::Fd signals = io::make_signalfd();
  asking.signals = signals.get();
  auto console = join_console(asking);
  if (!console) {
    io::print_formatted(stderr, "tandem-client control: %s\n", console.error().reason.c_str());
    return io::kExitTrouble;
  }
  ConsoleClient attendant(std::move(*console), asking, arguments.json);
  const int code = wish ? attendant.execute(*wish) : converse(attendant, signals.get());
  if (!asking.ticket.empty() && attendant.ticket_used())
    io::print(stderr, "the ticket is used up: for another connection ask for a new one (`tandem-server ticket`)\n");
  if (!wish) return code;
  const bool drains = code == io::kExitDone && std::holds_alternative<rpc::Drain>(*wish);
  return drains ? attendant.follow_drain(signals.get()) : code;
}

}  // namespace

void add_control_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "control",
      "Operates a session from a console: stops, resumes, moves authority, removes clients, creates sessions.",
      control_command);
  add_server_option(command, arguments.connection);
  add_session_option(command, arguments.connection,
                     "name, code or id of the session; default: the ticket's, or the only one there");
  add_ticket_options(command, arguments.connection.ticket,
                     "ticket printed by `tandem-server ticket --role operator`; not needed with a loopback server with "
                     "ephemeral keys");
  command
      .add_option("--role", arguments.role,
                  "without a ticket: operator, instructor, evaluator or recorder; default: operator, for `authority` "
                  "instructor")
      .value_name("ROLE");
  add_state_option(command, arguments.connection.state);
  add_timeout_option(command, arguments.connection.timeout);
  command.add_flag("--json", arguments.json, "status for machines");
  command
      .add_option("COMMAND", arguments.words,
                  "one of the commands below; none: a console that takes one command per line and stays connected")
      .value_name("...");
  command.footer(std::string("Commands\n") + console_commands_help() +
                 "\n"
                 "A ticket is valid for one connection, and used up by the first command that succeeds (`status` too, "
                 "unless all others are refused).\n"
                 "For several commands use the console (also through a pipe); it reports stops by others and the "
                 "progress of a drain. A stop is latched\n"
                 "and numbered; a resume names the newest stop, so that an old command never ends a newer stop.\n"
                 "Exit: 0 done; 1 refused, with the reason, or server not reachable; 2 wrong arguments. In the "
                 "console: the greatest code of its commands, but 1 if it lost its session or did not carry out "
                 "lines.\n\n"
                 "Examples\n"
                 "  tandem-client control --server 127.0.0.1:7000 stop a hand is in the way\n"
                 "  tandem-client control --server lab-server:7000 --ticket-file operator.ticket");
}

}  // namespace tandem::client
