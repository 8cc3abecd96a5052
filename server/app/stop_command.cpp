#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "common/base/format.h"
#include "common/io/number_option.h"
#include "common/io/print.h"
#include "server/app/run_command.h"
#include "server/app/trust_option.h"

namespace tandem::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kLook = std::chrono::milliseconds(200);
constexpr auto kLate = std::chrono::seconds(10);  // after the grace: a server that drains ends within 3 s of it

struct StopArguments {
  std::string state, grace = "0";
  bool no_wait = false;
};

std::string who_is_there(const ServingSpec& serving) {
  std::size_t sessions = 0, people = 0;
  for (const OpenSession& s : serving.sessions) {
    sessions += s.phase == "ending" ? 0 : 1;
    for (const OpenSeat& seat : s.seats) people += seat.taken ? 1 : 0;
  }
  return format("%zu session%s, %zu %s", sessions, sessions == 1 ? "" : "s", people, people == 1 ? "person on a seat" : "people on their seats");
}

/// Until the server has ended: how far it is, each ten seconds and in the last five.
int follow(const trust::ServerTrust& state, std::uint32_t grace_s) {
  const auto due = Clock::now() + std::chrono::seconds(grace_s);
  long told = static_cast<long>(grace_s) + 10;
  while (true) {
    const auto serving = state.read_serving();
    if (!serving) return trouble("stop", serving.error());
    if (!*serving) break;
    const auto now = Clock::now();
    const long left = std::max(0L, static_cast<long>(std::chrono::ceil<std::chrono::seconds>(due - now).count()));
    if (told / 10 != left / 10 || (left <= 5 && left != told)) io::printf_for_people(stdout, "DRAINING: %ld s left, %s\n", left, who_is_there(**serving).c_str());
    std::fflush(stdout);
    told = left;
    if (now > due + kLate)
      return trouble("stop", "the server is still there 10 s after it should have ended: does it stand still (SIGSTOP, a debugger)? `kill -KILL` ends it; clients let go of their hands by themselves");
    std::this_thread::sleep_for(kLook);
  }
  io::printf_for_people(stdout, "the server has ended\n");
  return std::fflush(stdout) == 0 ? 0 : 1;
}

int stop_command(const StopArguments& arguments) {
  std::string grace = arguments.grace;
  if (const auto problem = io::number_in(0, 3600, "s")(grace); !problem.empty()) return wrong("stop", {"--grace: " + problem});
  const auto grace_s = static_cast<std::uint32_t>(std::stod(grace));
  auto state = open_state(arguments.state);
  if (!state) return trouble("stop", state.error());
  const auto serving = state->read_serving();
  if (!serving) return trouble("stop", serving.error());
  if (!*serving)
    return trouble("stop", "no server runs from " + state->folder()->path() +
                               "; one on loopback with keys made on the spot has no folder: Ctrl-C where it runs, or `tandem-client control --server HOST:PORT drain`");
  if (const std::string problem = state->ask_to_end(grace_s); !problem.empty()) return trouble("stop", problem);
  state->audit(trust::wall_seconds(), "stop_ordered", "", format("in %u s", grace_s));
  tell_audit_trouble("stop", *state);
  io::printf_for_people(stdout, "server at %s: nobody new comes in; all hands are let go in %u s, then it ends\n", (*serving)->address.c_str(), grace_s);
  std::fflush(stdout);
  return arguments.no_wait ? 0 : follow(*state, grace_s);
}

}  // namespace

void add_stop_command(CLI::App& root, std::function<int()>& action) {
  const auto arguments = std::make_shared<StopArguments>();
  CLI::App* const command = root.add_subcommand("stop", "Ends the server that runs on this computer: nobody new comes in, all hands are let go gently.");
  add_state_option(*command, arguments->state);
  command->add_option("--grace", arguments->grace, "until all hands are let go [s], 0 to 3600, whole seconds; default 0: at once")->option_text("S");
  command->add_flag("--no-wait", arguments->no_wait, "returns at once; else it shows how far the server is until it has ended");
  command->footer(
      "Sessions of `serve` are kept: started again within 10 min, it goes on with them. Ctrl-C ends this command, not what it asked for.\n"
      "The same without a grace: `kill -TERM PID`, Ctrl-C where it runs, or, as a service, `systemctl stop tandem-server`. From another\n"
      "computer: `tandem-client control drain`.\n"
      "Exit: 0 the server has ended (--no-wait: it was asked to); 1 no server runs from this folder, or it does not end; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server stop --grace 60\n"
      "  tandem-server stop --state ./state --no-wait");
  command->callback([arguments, &action] { action = [arguments] { return stop_command(*arguments); }; });
}

}  // namespace tandem::server
