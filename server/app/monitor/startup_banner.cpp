#include "server/app/monitor/startup_banner.h"

#include <algorithm>
#include <cerrno>

#include "common/auth/io/state_directory.h"
#include "common/base/command_hints.h"
#include "common/base/format.h"
#include "common/io/reachable_address.h"
#include "server/app/control/session_registry.h"

namespace tandem::server {
namespace {

/// A program of this folder as the user would type it: with a path if this program was started with one.
std::string command(const char* program) {
  const std::string own = program_invocation_name;
  const auto slash = own.rfind('/');
  return (slash == std::string::npos ? "" : own.substr(0, slash + 1)) + program;
}

}  // namespace

std::string startup_banner(const SessionInstance& run, const io::SocketAddress& at, bool ephemeral_keys, bool several,
                           const std::string& folder, const std::string& read_code) {
  const SceneSpec& scene = run.options().scene;
  const std::string &name = run.options().name, dialled = shell_quote(io::reachable_address(at));
  const bool by_code = !run.code().empty();
  const std::string which = by_code   ? " --session " + (read_code.empty() ? code_text(run.code()) : "CODE")
                            : several ? " --session " + name
                                      : "";
  std::string text = several ? "session " + name + ": " : "", required, optional, replayed;
  text += "scene " + scene.name + (scene.endless() ? ", no end; " : format(", %.10g s; ", scene.duration));
  if (by_code)
    text += read_code.empty() ? "session code " + code_text(run.code()) + "; "
                              : "`" + read_code + "` shows the session's CODE; ";
  for (const SeatSpec& seat : scene.seats) {
    if (std::ranges::find(run.options().replayed, seat.name) != run.options().replayed.end()) {
      replayed += (replayed.empty() ? "" : ", ") + seat.name;
      continue;
    }
    const bool ticket = !ephemeral_keys && (!by_code || seat.role == Role::kInstructor);
    (seat.required ? required : optional) +=
        format("  %s join --server %s --seat %s --device sim%s\n", command("tandem-client").c_str(), dialled.c_str(),
               seat.name.c_str(), ticket ? " --ticket-file FILE" : which.c_str());
  }
  if (!replayed.empty()) text += "recorded hands play " + replayed + (required.empty() && optional.empty() ? "" : "; ");
  if (required.empty() && optional.empty()) return text + "\n";
  text += (ephemeral_keys ? "in other terminals type" : "on enrolled workstations type");
  text += required.empty() ? ", for optional seats\n" : "\n" + required;
  if (!required.empty() && !optional.empty()) text += "and for optional seats\n";
  text += optional;
  return ephemeral_keys
             ? text
             : text + "a ticket FILE is written by\n  " + command("tandem-server") + " ticket --session " + name +
                   " --seat SEAT --workstation NAME" + auth::server_state_option(folder) + " > FILE\n";
}

}  // namespace tandem::server
