#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "client/app/commands/client_commands.h"
#include "client/app/commands/connection_options.h"
#include "client/app/console_commands.h"
#include "client/app/console_follow.h"
#include "client/app/console_lines.h"
#include "client/app/console_sessions.h"
#include "common/auth/io/control_client.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/help_text.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/io/usage_errors.h"
#include "proto/rpc/session_list_text.h"
#include "proto/rpc/session_pages.h"

namespace tandem::client {
namespace {

constexpr int kPollIntervalMs = ConsoleLines::kIdleMs;  // between two polls of the session status

struct ControlArguments {
  ConnectionArguments connection;
  std::string role;
  std::vector<std::string> words;
  bool json = false;
};

/// Executes console commands for one session over one connection.
class ConsoleClient {
 public:
  ConsoleClient(Console console, const JoinOptions& asked, bool json)
      : console_(std::move(console)),
        asked_(asked),
        timeout_(std::chrono::duration_cast<std::chrono::milliseconds>(asked.timeout)),
        json_(json) {}

  [[nodiscard]] const rpc::Welcome& welcome() const { return console_.welcome; }
  [[nodiscard]] int connection() const { return console_.connection->fd(); }

  /// kChanged: a change of the session status was printed. kGone: the connection is lost.
  enum class PollResult { kNothing, kChanged, kGone };
  PollResult poll_status() {
    const auto answer = console_.connection->ask(rpc::StatusRequest{console_.welcome.session_id}, timeout_);
    const auto* const moved = answer ? std::get_if<rpc::Elsewhere>(&*answer) : nullptr;
    if (moved_ = moved != nullptr; moved_) complain(moved_text(*moved));
    if (!answer || moved_) return PollResult::kGone;
    const auto* said = std::get_if<rpc::Status>(&*answer);
    if (said == nullptr) return PollResult::kNothing;  // rate limit or end of the session; the next command reports it
    looked_ = true;
    const rpc::Status now = completed(*said);
    const std::string news = status_changes_text(seen_.value_or(rpc::Status{}), now);
    seen_ = now;
    if (news.empty()) return PollResult::kNothing;
    say((isatty(STDIN_FILENO) == 1 ? "\n" : "") + news);  // on its own line, not after the prompt
    return PollResult::kChanged;
  }

  /// Follows the session to another server of its service. @return false: it is not there, or a signal came
  bool follow() {
    if (!console_.service) return false;
    if (!std::exchange(moved_, false))
      complain("the server has ended this connection. This console looks for session " + welcome().session_name +
               " at the other servers; until it has found it, it carries out no order");
    auto again = follow_session(asked_);
    if (!again) {
      if (!again.error().empty()) complain(again.error());
      return false;
    }
    console_ = std::move(*again);
    seen_.reset();
    say("this console has followed session " + welcome().session_name + " to its new server");
    return true;
  }

  /// Shows the progress of a drain until the server has ended or a signal arrives. @return exit code
  int follow_drain(int signals) {
    while (true) {
      const bool gone = poll_status() == PollResult::kGone;
      pollfd files[] = {{signals, POLLIN, 0}, {connection(), POLLIN | POLLRDHUP, 0}};
      poll(files, 2, gone ? 0 : kPollIntervalMs / 2);
      if (files[0].revents != 0) return say("the drain continues without this console");
      if (gone || files[1].revents != 0) return say("the server has ended");
    }
  }

  /// True if a drain requested on this console is due, so that an end of the connection is expected.
  [[nodiscard]] bool drained() const { return drain_due_ && io::monotonic_now() >= *drain_due_; }

  /// True if the server accepted a command, so that the ticket of this console is used up. A status query alone uses
  /// it up too, unless another command was refused. A recorder uses it up by any query, its only command.
  [[nodiscard]] bool ticket_used() const {
    return acted_ || (looked_ && (!refused_ || console_.welcome.role == AccessRole::kRecorder));
  }

  /// Executes a command. @return exit code
  int execute(const ConsoleCommand& command) {
    return std::visit(
        [this](const auto& typed) {
          if constexpr (requires { typed.session_id; }) {
            auto request = typed;
            request.session_id = welcome().session_id;
            return run(request);
          } else {
            return run(typed);
          }
        },
        command);
  }

 private:
  static int say(const std::string& text) {
    const std::string line = text.ends_with('\n') ? text : text + "\n";
    std::fputs(text.starts_with('{') ? line.c_str() : io::wrap_for_terminal(line, stdout).c_str(),
               stdout);  // JSON is not wrapped
    return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
  }
  static int complain(const std::string& text, int code = io::kExitTrouble) {
    io::print(stderr, "tandem-client control: " + text + "\n");
    return code;
  }

  /// Returns the reply if it has this type; otherwise prints the error.
  template <class Answer>
  std::optional<Answer> ask(const rpc::Body& question) {
    const auto answer = console_.connection->ask(question, timeout_);
    if (!answer) {
      complain(answer.error().text);
    } else if (const auto* good = std::get_if<Answer>(&*answer)) {
      (std::is_same_v<Answer, rpc::Status> || std::is_same_v<Answer, rpc::SessionList> ? looked_ : acted_) = true;
      return *good;
    } else if (const auto* refused = std::get_if<rpc::ErrorReply>(&*answer)) {
      refused_ = true;
      complain("refused: " + refused->text + refusal_hint(question, console_.welcome.role));
    } else if (const auto* moved = std::get_if<rpc::Elsewhere>(&*answer)) {
      refused_ = true;
      complain(moved_text(*moved));
    } else {
      complain("unexpected reply from the server; use the same release on both");
    }
    return std::nullopt;
  }
  bool order(const rpc::Body& command) { return ask<rpc::Ok>(command).has_value(); }
  std::optional<rpc::SessionList> sessions() {
    return rpc::all_sessions([this](const rpc::Body& page) { return ask<rpc::SessionList>(page); }, console_.service);
  }
  std::optional<rpc::Status> status() {
    auto now = ask<rpc::Status>(rpc::StatusRequest{console_.welcome.session_id});
    if (now) seen_ = now = completed(*now);
    return now;
  }

  int tell_stop(const char* what) {
    const auto now = status();
    if (!now)
      return say(std::string(what) + ": all hands are released");  // the stop succeeded even if the status query failed
    return say(format("%s: all hands are released; `resume %u` ends it", what, now->stops));
  }

  int run(const rpc::StatusRequest&) {
    const auto now = status();
    return now ? say(json_ ? status_json(*now) : status_text(*now)) : io::kExitTrouble;
  }
  int run(const rpc::StopSession& request) { return order(request) ? tell_stop("STOPPED") : io::kExitTrouble; }
  int run(const rpc::PauseSession& request) { return order(request) ? tell_stop("PAUSED") : io::kExitTrouble; }

  int run(rpc::ResumeSession request) {
    if (request.stop == 0) {
      const auto now = status();
      if (!now) return io::kExitTrouble;
      request.stop = now->stops;
    }
    if (!order(request)) return io::kExitTrouble;
    return say(format("RESUMED: stop %u is over", request.stop));
  }

  int run(const AuthorityCommand& command) {
    const auto now = status();
    if (!now) return io::kExitTrouble;
    const auto frame = authority_frame(command, *now);
    if (!frame) return complain(frame.error(), io::kExitUsage);
    const auto answer = ask<rpc::AuthorityReply>(*frame);
    if (!answer) return io::kExitTrouble;
    const std::string is =
        format("authority over %s, version %u: ", now->tools[frame->tool].name.c_str(), answer->version) +
        weights_text(*now, answer->alpha);
    if (answer->applied) return say(is + "; the transfer begins in 50 ms");
    return complain("refused: another change came first. In force: " + is + ". Check it, then repeat the command");
  }

  int run(const rpc::RemoveParticipant& request) {
    if (!order(request)) return io::kExitTrouble;
    return say(request.seat +
               ": released; the seat is free in a moment, and that workstation cannot join again with the session's "
               "code");
  }

  int run(const rpc::Drain& request) {
    // Computed before the request, so the server never ends earlier.
    const Time due = io::monotonic_now() + std::chrono::seconds(request.grace_s);
    if (!order(request)) return io::kExitTrouble;
    drain_due_ = std::min(due, drain_due_.value_or(due));
    return say(request.grace_s == 0
                   ? std::string("draining: all hands are released, then the server ends")
                   : format("draining: new joins are rejected; all hands are released in %u s, then the server ends",
                            request.grace_s));
  }

  int run(const CreateCommand& command) {
    const auto order = creation_order(command);
    if (!order) return complain(order.error(), io::kExitUsage);
    const auto created = ask<rpc::SessionCreated>(*order);
    if (!created) return io::kExitTrouble;
    return say(json_ ? created_json(*created) : created_text(*created, io::to_text(asked_.server)));
  }
  int run(const EndCommand& command) {
    const auto list = sessions();
    if (!list) return io::kExitTrouble;
    const auto id = listed_session(*list, command.session);
    if (!id) return complain(id.error());
    return order(rpc::EndSession{*id, command.why}) ? say(command.session + ": ended") : io::kExitTrouble;
  }
  int run(const SessionsCommand&) {
    const auto list = sessions();
    return list ? say(json_ ? session_list_json(*list) : session_list_text(*list)) : io::kExitTrouble;
  }
  int run(const rpc::Note& note) {
    return order(note) ? say(std::string(to_text(note.kind)) + ": written") : io::kExitTrouble;
  }

  int run(const rpc::RecordSession& request) {
    if (!order(request)) return io::kExitTrouble;
    return say(request.on ? "the session is recorded; all participants see it" : "the recording ends");
  }

  int run(const HelpCommand&) { return say(console_commands_help()); }
  int run(const QuitCommand&) { return io::kExitDone; }

  /// Completes the commands in the server's texts with the options of this console.
  [[nodiscard]] rpc::Status completed(rpc::Status status) const {
    if (status.stop) status.stop->ends = complete_commands(status.stop->ends, asked_, status.name);
    return status;
  }

  Console console_;
  JoinOptions asked_;
  std::optional<rpc::Status> seen_;
  std::optional<Time> drain_due_;  ///< earliest drain requested on this console
  std::chrono::milliseconds timeout_;
  bool json_;
  bool moved_ = false;                                     ///< the server has said that the session is at another one
  bool looked_ = false, acted_ = false, refused_ = false;  ///< a status was read; others were accepted; one was refused
};

int tell_gone(bool person, int worst) {
  io::print_formatted(
      stderr,
      "%standem-client control: the server ended this connection: it was stopped, is being restarted, or withdrew its "
      "rights.\n"
      "Orders after that were not carried out. To continue, start again, with a new ticket if you joined with one "
      "(`tandem-server ticket` on the server)\n",
      person ? "\n" : "");
  return std::max(worst, io::kExitTrouble);
}

/// Executes the commands of standard input line by line. @return the largest exit code
int converse(ConsoleClient& attendant, int signals) {
  const bool person = isatty(STDIN_FILENO) == 1;
  const std::string prompt =
      attendant.welcome().session_name + " (" + std::string(to_text(attendant.welcome().role)) + ")> ";
  if (person) std::printf("the connection stays open until you quit; `help` lists the commands\n");
  ConsoleLines lines(signals, attendant.connection());
  int worst = io::kExitDone;
  bool waiting = false;  // the prompt is already shown
  while (true) {
    if (person && !waiting) std::printf("%s", prompt.c_str());
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
        if (!attendant.follow()) return tell_gone(person, worst);
        lines.set_server(attendant.connection());
        continue;
      }
      std::printf("%sthe server has ended: the drain is complete\n", person ? "\n" : "");
      return worst;
    }
    if (!line) return worst;
    const auto words = words_of(*line);
    if (words.empty()) continue;
    const auto wish = parse_command(words);
    int code = io::kExitUsage;
    if (wish) {
      if (std::holds_alternative<QuitCommand>(*wish)) return worst;
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
                 "console: the greatest code of its commands.\n\n"
                 "Examples\n"
                 "  tandem-client control --server 127.0.0.1:7000 stop a hand is in the way\n"
                 "  tandem-client control --server lab-server:7000 --ticket-file operator.ticket");
}

}  // namespace tandem::client
