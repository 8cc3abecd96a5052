#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "common/base/format.h"
#include "common/io/command_line.h"
#include "common/io/print.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"

namespace tandem::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kLook = std::chrono::milliseconds(200);
constexpr auto kLate = std::chrono::seconds(10);  // after the grace; a draining server ends within 3 s of it

struct StopArguments {
  std::string state, grace = "0";
  bool no_wait = false;
};

std::string participants_text(const ServingSpec& serving) {
  std::size_t sessions = 0, people = 0;
  for (const OpenSession& s : serving.sessions) {
    sessions += s.phase == "ending" ? 0 : 1;
    for (const OpenSeat& seat : s.seats) people += seat.taken ? 1 : 0;
  }
  return format("%zu session%s, %zu %s", sessions, sessions == 1 ? "" : "s", people,
                people == 1 ? "participant on a seat" : "participants on their seats");
}

/// Waits until the server has ended. Prints the progress every ten seconds, and every second in the last five.
int wait_for_drain(const auth::ServerKeystore& state, std::uint32_t grace_s) {
  const auto due = Clock::now() + std::chrono::seconds(grace_s);
  long shown = static_cast<long>(grace_s) + 10;
  while (true) {
    const auto serving = state.serving().read();
    if (!serving) return print_error("stop", serving.error());
    if (!*serving) break;
    const auto now = Clock::now();
    const long left = std::max(0L, static_cast<long>(std::chrono::ceil<std::chrono::seconds>(due - now).count()));
    if (shown / 10 != left / 10 || (left <= 5 && left != shown))
      io::print_formatted(stdout, "DRAINING: %ld s left, %s\n", left, participants_text(**serving).c_str());
    std::fflush(stdout);
    shown = left;
    if (now > due + kLate)
      return print_error("stop",
                         "the server still runs 10 s after it should have ended: is it suspended (SIGSTOP, a "
                         "debugger)? `kill -KILL` ends it; each client releases its own hand");
    std::this_thread::sleep_for(kLook);
  }
  io::print_formatted(stdout, "the server has ended\n");
  return std::fflush(stdout) == 0 ? 0 : 1;
}

int stop_command(const StopArguments& arguments) {
  io::UsageErrors errors;
  const auto grace_s = static_cast<std::uint32_t>(errors.number("--grace", arguments.grace, 0, 3600, "s"));
  if (!errors.empty()) return print_usage_errors("stop", errors);
  auto state = open_state(arguments.state);
  if (!state) return print_error("stop", state.error());
  const auto serving = state->serving().read();
  if (!serving) return print_error("stop", serving.error());
  if (!*serving)
    return print_error("stop", no_server_text(state->folder()->path()) +
                                   "; a loopback server with ephemeral keys has no folder: Ctrl-C where it runs, or "
                                   "`tandem-client control --server HOST:PORT drain`");
  if (const std::string problem = state->serving().request_shutdown(grace_s); !problem.empty())
    return print_error("stop", problem);
  record_command("stop", *state, auth::wall_seconds(), "stop_requested", "", format("in %u s", grace_s));
  const bool member = state->membership() != nullptr;
  io::print_formatted(
      stdout, "server at %s: new joins are rejected; %sall hands are released in %u s, then the server ends%s\n",
      (*serving)->address.c_str(),
      member && grace_s > 0 ? "its sessions move to other servers of the service, and it ends when it "
                              "has none; of those that find no room "
                            : "",
      grace_s,
      member && grace_s == 0 ? "; if other servers of the service run, they take its sessions over (with --grace 60 "
                               "they move first)"
                             : "");
  std::fflush(stdout);
  return arguments.no_wait ? 0 : wait_for_drain(*state, grace_s);
}

}  // namespace

void add_stop_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "stop", "Ends the server that runs on this computer: rejects new joins and releases all hands.", stop_command);
  add_state_option(command, arguments.state);
  command
      .add_option("--grace", arguments.grace,
                  "until all hands are released [s], 0 to 3600, whole seconds; default 0: at once")
      .value_name("S");
  command.add_flag("--no-wait", arguments.no_wait,
                   "returns at once; default: shows the progress until the server has ended");
  command.footer(
      "Sessions of `serve` are kept: started again within 10 min, it resumes them. A server of a service moves its "
      "sessions to other servers during the grace, and ends when it has none left. Ctrl-C ends this command; the "
      "server still ends.\n"
      "To stop without a grace period: `kill -TERM PID`, Ctrl-C where it runs, or, as a service, `systemctl stop "
      "tandem-server`. From another\n"
      "computer: `tandem-client control drain`.\n"
      "Exit: 0 the server has ended (--no-wait: it was asked to); 1 no server runs from this folder, or it does not "
      "end; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server stop --grace 60\n"
      "  tandem-server stop --state ./state --no-wait");
}

}  // namespace tandem::server
