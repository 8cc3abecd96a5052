#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/nearest.h"
#include "common/trust/io/server_trust.h"

/// What the commands over a server's state folder share.
namespace tandem::server {

inline void add_state_option(CLI::App& command, std::string& state) {
  command
      .add_option("--state", state, "the server's state folder; default: $TANDEM_STATE, else /var/lib/tandem where this user may write, else ~/.local/state/tandem")
      ->option_text("DIR");
}

/// Prints all mistakes. @return exit code 2
[[nodiscard]] inline int wrong(const char* command, const std::vector<std::string>& mistakes) {
  for (const std::string& mistake : mistakes) std::fprintf(stderr, "%s\n", mistake.c_str());
  std::fprintf(stderr, "tandem-server %s: %zu mistake%s, nothing was done\n", command, mistakes.size(), mistakes.size() == 1 ? "" : "s");
  return 2;
}
[[nodiscard]] inline int trouble(const char* command, const std::string& what) {
  std::fprintf(stderr, "tandem-server %s: %s\n", command, what.c_str());
  return 1;
}

/// The folder of `--state`, read whole.
/// After an order that was carried out: whether the audit log says so too.
inline void tell_audit_trouble(const char* command, const trust::ServerTrust& state) {
  if (const std::string& what = state.audit_log().trouble(); !what.empty()) std::fprintf(stderr, "tandem-server %s: it is done, but the audit log does not say so: %s\n", command, what.c_str());
}

[[nodiscard]] inline std::expected<trust::ServerTrust, std::string> open_state(const std::string& option) {
  const auto path = trust::server_state_path(option);
  if (!path) return std::unexpected(path.error());
  std::error_code error;
  if (!std::filesystem::exists(*path, error) && !error)
    return std::unexpected("there is no state folder " + *path + ". Name the server's folder with --state. A server on loopback that was started without --state has no folder and needs no "
                           "`tandem-server` commands: use `tandem-client sessions --server HOST:PORT` and `tandem-client control --server HOST:PORT`. For a server on a network: `tandem-server init" +
                           trust::server_state_option(*path) + "`");
  return trust::ServerTrust::open(*path);
}

/// `no workstation is called "tuch-07"; did you mean touch-07?`
[[nodiscard]] inline std::string no_workstation(const std::string& name, const std::vector<WorkstationRow>& book, const std::string& folder) {
  std::vector<std::string> names;
  for (const WorkstationRow& row : book) names.push_back(row.name);
  return "no workstation is called \"" + name + "\"; " + (names.empty() ? "none is enrolled: run `tandem-server enroll" + trust::server_state_option(folder) + " " + name + "`" : suggest(name, names));
}

}  // namespace tandem::server
