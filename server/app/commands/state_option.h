#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/auth/io/server_keystore.h"
#include "common/base/suggestions.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/usage_errors.h"

/// Shared by the commands that use a server's state directory.
namespace tandem::server {

inline void add_state_option(const io::Command& command, std::string& state) {
  command
      .add_option("--state", state,
                  "the server's state folder; default: $TANDEM_STATE, else /var/lib/tandem where this user may write, "
                  "else ~/.local/state/tandem")
      .value_name("DIR");
}

/// Prints the usage errors of a command. @return exit code 2
[[nodiscard]] inline int print_usage_errors(const std::string& command, const io::UsageErrors& errors) {
  return errors.report("tandem-server " + command, "nothing was done");
}
[[nodiscard]] inline int print_usage_error(const std::string& command, const std::string& what) {
  io::UsageErrors errors;
  errors.add(what);
  return print_usage_errors(command, errors);
}
[[nodiscard]] inline int print_error(const char* command, const std::string& what) {
  std::fprintf(stderr, "tandem-server %s: %s\n", command, what.c_str());
  return io::kExitTrouble;
}

/// Text of a command that has succeeded, but not its record in the audit log. A full disk must not suggest to repeat
/// it: a second ticket would be valid, too. @param why  error of the audit log
[[nodiscard]] inline std::string audit_failure_text(std::string why) {
  constexpr std::string_view kRepeat = ", then repeat";
  if (const auto at = why.find(kRepeat); at != std::string::npos) why.erase(at, kRepeat.size());
  return "the command is done, do not repeat it; but the audit log has no record of it: " + why;
}

/// Warns, after a command has succeeded, if the audit log could not record it.
inline void warn_audit_failure(const char* command, const auth::ServerKeystore& state) {
  if (const std::string& what = state.audit_log().error(); !what.empty())
    static_cast<void>(print_error(command, audit_failure_text(what)));
}
/// Records a command in the audit log after it has succeeded; warns if that fails.
inline void record_command(const char* command, auth::ServerKeystore& state, std::int64_t now, std::string_view event,
                           const std::string& workstation, const std::string& detail = {}) {
  state.audit(now, event, workstation, detail);
  warn_audit_failure(command, state);
}

/// Returns how to go on if no server runs from this folder: it may have another one.
[[nodiscard]] inline std::string no_server_text(const std::string& folder) {
  return "no server runs from " + folder + "; if it has another folder, name that with --state";
}

/// Opens the state directory that `--state` names, or the default one. @return the keystore, or the error and its
/// remedy
[[nodiscard]] inline std::expected<auth::ServerKeystore, std::string> open_state(const std::string& option) {
  const auto path = auth::server_state_path(option);
  if (!path) return std::unexpected(path.error());
  std::error_code error;
  if (!std::filesystem::exists(*path, error) && !error)
    return std::unexpected(
        "there is no state folder " + *path +
        ". Name the server's folder with --state. A server on loopback that was started without --state has no folder "
        "and needs no "
        "`tandem-server` commands: use `tandem-client sessions --server HOST:PORT` and `tandem-client control --server "
        "HOST:PORT`. For a server on a network: `tandem-server init" +
        auth::server_state_option(*path) + "`");
  return auth::ServerKeystore::open(*path);
}

/// Error message for an unknown name: `no workstation is called "tuch-07"; did you mean touch-07?`
[[nodiscard]] inline std::string unknown_workstation_text(const std::string& name,
                                                          const std::vector<WorkstationRow>& book,
                                                          const std::string& folder) {
  return "no workstation is called \"" + name + "\"; " +
         (book.empty()
              ? "none is enrolled in " + folder +
                    ": if the server has another folder, name that with --state; otherwise run `tandem-server enroll" +
                    auth::server_state_option(folder) + " " + name + " --address HOST:PORT`"
              : suggest_name(name, book));
}

}  // namespace tandem::server
