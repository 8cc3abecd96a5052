#include "client/app/console_client.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ranges>
#include <utility>

#include "client/app/console_follow.h"
#include "client/app/console_lines.h"
#include "client/app/server_addresses.h"
#include "client/app/session_status_text.h"
#include "common/auth/io/control_client.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/clock.h"
#include "common/io/exit_code.h"
#include "common/io/help_text.h"
#include "common/io/print.h"
#include "common/io/socket_address.h"
#include "proto/rpc/session_list_text.h"
#include "proto/rpc/session_pages.h"

namespace tandem::client {
namespace {

constexpr int kPollIntervalMs = ConsoleLines::kIdleMs;  // between two polls of the session status

int say(const std::string& text) {
  const std::string line = text.ends_with('\n') ? text : text + "\n";
  std::fputs(text.starts_with('{') ? line.c_str() : io::wrap_for_terminal(line, stdout).c_str(),
             stdout);  // JSON is not wrapped
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

int complain(const std::string& text, int code = io::kExitTrouble) {
  io::print(stderr, "tandem-client control: " + text + "\n");
  return code;
}

/// Whether the prompt of a person, and perhaps the begin of a line, is before what is printed next.
bool beside_prompt() { return isatty(STDIN_FILENO) == 1; }

/// Complains on a line of its own, while a person may type.
void interrupt(const std::string& text) {
  if (beside_prompt()) io::print(stderr, "\n");
  complain(text);
}

}  // namespace

ConsoleClient::ConsoleClient(Console console, const JoinOptions& asked, bool json)
    : console_(std::move(console)),
      asked_(asked),
      timeout_(std::chrono::duration_cast<std::chrono::milliseconds>(asked.timeout)),
      json_(json) {}

int ConsoleClient::connection() const { return console_.connection->fd(); }

bool ConsoleClient::drained() const { return drain_due_ && io::monotonic_now() >= *drain_due_; }

std::string ConsoleClient::drained_server() const { return named(drained_); }

ConsoleClient::PollResult ConsoleClient::poll_status() {
  const auto answer = console_.connection->ask(rpc::StatusRequest{console_.welcome.session_id}, timeout_);
  const auto* const moved = answer ? std::get_if<rpc::Elsewhere>(&*answer) : nullptr;
  if (moved_ = moved != nullptr; moved_) interrupt(moved_text(*moved));
  if (!answer || moved_) return PollResult::kGone;
  const auto* said = std::get_if<rpc::Status>(&*answer);
  if (said == nullptr) return PollResult::kNothing;  // rate limit or end of the session; the next command reports it
  looked_ = true;
  const rpc::Status now = completed(*said);
  const std::string news = status_changes_text(seen_.value_or(rpc::Status{}), now);
  seen_ = now;
  if (news.empty()) return PollResult::kNothing;
  say((beside_prompt() ? "\n" : "") + news);
  return PollResult::kChanged;
}

bool ConsoleClient::follow() {
  if (!console_.service) return false;
  const std::string looks = " looks for session " + welcome().session_name +
                            " at the other servers; until it has found it, it carries out no order";
  if (std::exchange(moved_, false)) {
    complain("this console" + looks);
  } else {
    interrupt("the server has ended this connection. This console" + looks);
  }
  auto again = follow_session(asked_);
  if (!again) {
    if (!again.error().empty()) complain(again.error());
    return false;
  }
  console_ = std::move(*again);
  seen_.reset();
  drain_due_.reset();  // of the server before
  say("this console has followed session " + welcome().session_name + " to its new server");
  return true;
}

int ConsoleClient::follow_drain(int signals) {
  bool moved = false;  // the connection stays until the server ends
  while (true) {
    const bool gone = !moved && poll_status() == PollResult::kGone;
    moved = moved || std::exchange(moved_, false);
    pollfd files[] = {{signals, POLLIN, 0}, {connection(), POLLIN | POLLRDHUP, 0}};
    poll(files, 2, gone && !moved ? 0 : kPollIntervalMs / 2);
    if (files[0].revents != 0) return say("the drain of " + drained_server() + " continues without this console");
    if ((gone && !moved) || files[1].revents != 0) return say(drained_server() + " has ended");
  }
}

int ConsoleClient::execute(const ConsoleCommand& command) {
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

template <class Answer>
std::optional<Answer> ConsoleClient::ask(const rpc::Body& question) {
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

bool ConsoleClient::order(const rpc::Body& command) {
  const auto done = ask<rpc::Ok>(command);
  if (done && !done->not_stored.empty()) complain("WARNING: " + sanitize(done->not_stored));
  return done.has_value();
}

std::optional<rpc::SessionList> ConsoleClient::sessions() {
  return rpc::all_sessions([this](const rpc::Body& page) { return ask<rpc::SessionList>(page); }, console_.service);
}

std::optional<rpc::Status> ConsoleClient::status() {
  auto now = ask<rpc::Status>(rpc::StatusRequest{console_.welcome.session_id});
  if (now) seen_ = now = completed(*now);
  return now;
}

int ConsoleClient::tell_stop(const char* what) {
  const auto now = status();
  if (!now)
    return say(std::string(what) + ": all hands are released");  // the stop succeeded even if the status query failed
  return say(format("%s: all hands are released; `resume %u` ends it", what, now->stops));
}

int ConsoleClient::run(const rpc::StatusRequest&) {
  const auto now = status();
  return now ? say(json_ ? status_json(*now) : status_text(*now)) : io::kExitTrouble;
}

int ConsoleClient::run(const rpc::StopSession& request) {
  return order(request) ? tell_stop("STOPPED") : io::kExitTrouble;
}

int ConsoleClient::run(const rpc::PauseSession& request) {
  return order(request) ? tell_stop("PAUSED") : io::kExitTrouble;
}

int ConsoleClient::run(rpc::ResumeSession request) {
  if (request.stop == 0) {
    const auto now = status();
    if (!now) return io::kExitTrouble;
    request.stop = now->stops;
  }
  if (!order(request)) return io::kExitTrouble;
  return say(format("RESUMED: stop %u is over", request.stop));
}

int ConsoleClient::run(const AuthorityCommand& command) {
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

int ConsoleClient::run(const rpc::RemoveParticipant& request) {
  if (!order(request)) return io::kExitTrouble;
  return say(request.seat +
             ": released; the seat is free in a moment, and that workstation cannot join again with the session's "
             "code");
}

DrainTarget ConsoleClient::drain_target() {
  DrainTarget target{"", io::to_text(console_.server), console_.service};
  if (!console_.service) return target;
  // The first member is the server itself.
  ServerAddresses others{asked_};
  for (const std::string& member : welcome().members | std::views::drop(1)) others.add(member);
  others.begin(timeout_);
  static_cast<void>(others.has(kAddressesTried));  // resolves all names
  for (const io::SocketAddress& address : others.known()) target.others.push_back(io::to_text(address));
  if (const auto list = sessions())
    for (const rpc::ListedSession& s : list->sessions)
      if (s.id == welcome().session_id) target.name = s.server;
  return target;
}

int ConsoleClient::run(const rpc::Drain& request) {
  DrainTarget target = drain_target();
  if (const std::string problem = drain_problem(asked_, target, welcome().session_name); !problem.empty())
    return complain("refused: " + problem);
  // Computed before the request, so the server never ends earlier.
  const Time due = io::monotonic_now() + std::chrono::seconds(request.grace_s);
  if (!order(request)) return io::kExitTrouble;
  drain_due_ = std::min(due, drain_due_.value_or(due));
  drained_ = std::move(target);
  return say(drain_text(drained_, request.grace_s));
}

int ConsoleClient::run(const CreateCommand& command) {
  const auto order = creation_order(command);
  if (!order) return complain(order.error(), io::kExitUsage);
  const auto created = ask<rpc::SessionCreated>(*order);
  if (!created) return io::kExitTrouble;
  return say(json_ ? created_json(*created) : created_text(*created, asked_));
}

int ConsoleClient::run(const EndCommand& command) {
  const auto list = sessions();
  if (!list) return io::kExitTrouble;
  const auto id = listed_session(*list, command.session);
  if (!id) return complain(id.error());
  return order(rpc::EndSession{*id, command.why}) ? say(command.session + ": ended") : io::kExitTrouble;
}

int ConsoleClient::run(const SessionsCommand&) {
  const auto list = sessions();
  return list ? say(json_ ? session_list_json(*list) : session_list_text(*list)) : io::kExitTrouble;
}

int ConsoleClient::run(const rpc::Note& note) {
  return order(note) ? say(std::string(to_text(note.kind)) + ": written") : io::kExitTrouble;
}

int ConsoleClient::run(const rpc::RecordSession& request) {
  if (!order(request)) return io::kExitTrouble;
  return say(request.on ? "the session is recorded; all participants see it" : "the recording ends");
}

int ConsoleClient::run(const HelpCommand&) { return say(console_commands_help()); }

int ConsoleClient::run(const QuitCommand&) { return io::kExitDone; }

rpc::Status ConsoleClient::completed(rpc::Status status) const {
  if (status.stop)
    status.stop->ends = complete_commands(status.stop->ends, asked_, status.name, !asked_.ticket.empty());
  return status;
}

}  // namespace tandem::client
