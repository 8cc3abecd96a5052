#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/io/log.h"
#include "server/app/control/control_options.h"
#include "server/app/process/session_creation.h"
#include "server/app/process/session_instance.h"
#include "server/app/service/service_options.h"

namespace tandem::server {

/// Options of a server process, validated: one session (`run`) or several (`serve`).
struct ServerOptions {
  const char* command = "run";  ///< name of the command, for messages
  std::vector<SessionOptions> sessions{};
  ControlOptions control{};
  std::optional<io::Level> json_log{};                ///< set: log lines are JSON, of this level and above
  double start_timeout_s = 0;                         ///< [s] for the required seats to get ready; 0: no limit
  std::size_t threads = 0;                            ///< tick threads wanted, 1 ... 64; 0: one per processor
  std::size_t created_max = kCreatedSessionsDefault;  ///< sessions created at run time that are open at a time
  std::string scenes{};       ///< folder of scenes for created sessions, NAME.textproto; empty: shipped scenes only
  std::string reports{};      ///< folder for reports of created sessions; empty: none
  RecordingOptions record{};  ///< of created sessions
  /// Called once clients can join, with HOST:PORT; empty: nothing is to be done then.
  std::function<void(const std::string& address)> on_listening{};
  /// Called a few times per second while the first session waits for its required seats. Returns why it waits in vain:
  /// the server then ends. Empty: no such check.
  std::function<std::string()> start_problem{};
  /// The server is a member of a service: it runs on without sessions, and opens only what it owns.
  bool service = false;
  std::optional<ServiceOptions> directory{};  ///< of the service; only with `service`
  std::string version = "unknown";            ///< of the program
  bool quiet = false;
  bool no_restore = false;       ///< ignores all checkpoints
  bool sessions_resume = false;  ///< a signal ends the server but keeps its sessions: the next start restores them
};

/// Warning about a metrics endpoint beyond loopback.
inline constexpr const char* kUnprotectedMetricsWarning =
    "warning: any host that reaches this address can read the metrics without a password; use 127.0.0.1, or put a "
    "proxy with a password in front";

/// Runs a server until all sessions are over and none restarts, or until a signal or a drain. Then new joins are
/// rejected, all hands are released and reports are written. A second signal, or 3 s, ends the process at once.
/// Sessions are restored from the checkpoints of a server that failed, or that ended with `sessions_resume`.
/// @return exit code
[[nodiscard]] int run_server(const ServerOptions& options);

}  // namespace tandem::server
