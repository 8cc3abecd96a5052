#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/auth/audit_throttle.h"
#include "common/auth/io/client_keystore.h"
#include "common/auth/io/server_keystore.h"
#include "common/io/udp_socket.h"
#include "server/app/control/control_plane.h"
#include "server/app/control/session_joins.h"
#include "server/app/monitor/metrics_server.h"

namespace tandem::server {

/// The control side of a server process: keys, control connections on their own thread, registry of sessions, metrics
/// endpoint. On loopback without a state directory the keys are ephemeral. Clients of the same user then find the keys
/// in the runtime directory; nothing else differs.
class ControlServer {
 public:
  struct Options {
    io::SocketAddress listen;  ///< port 0: a port that is free for UDP and TCP
    /// State directory as given. Empty: the default directory, or ephemeral keys on loopback.
    std::string state;
    std::function<void(const ControlEventRecord&)> on_event;  ///< called on the control thread
    /// Receives executed commands, one line each, for the operator of the server. Called on the control thread.
    std::function<void(const std::string&)> on_message{};
    ControlLimits limits{};
    LoadLimits load_limits{};  ///< load of a shard above which new joins are rejected
    io::Steering steering{};   ///< assignment of datagrams to shards
    /// Address of /metrics, /healthz and /readyz; nullopt: none.
    std::optional<io::SocketAddress> metrics{};
    std::vector<std::string> metrics_hosts{};  ///< accepted Host names, in addition to addresses
    auth::AuditLimits audit{};
  };
  /// Error in the keys or the registry for this address, before anything starts; empty if there is none.
  [[nodiscard]] static std::string problem_with_keys(const io::SocketAddress& listen, const std::string& state);
  /// All errors in them, for `--check`. `problem_with_address` checks whether this computer has the address. Both open
  /// and change nothing.
  [[nodiscard]] static std::vector<std::string> problems_with_keys(const io::SocketAddress& listen,
                                                                   const std::string& state);
  [[nodiscard]] static std::string problem_with_address(const io::SocketAddress& listen);
  /// @return the control server, listening but not yet replying; or the error and its remedy
  [[nodiscard]] static std::expected<std::unique_ptr<ControlServer>, std::string> open(const Options& plan);
  ~ControlServer();

  /// The datagram sockets for the shards, all on the port of the control connections. May be called once.
  [[nodiscard]] std::vector<io::UdpSocket> take_sockets() { return std::move(sockets_); }
  [[nodiscard]] const io::SocketAddress& address() const noexcept { return address_; }
  /// Directory for checkpoints: the state directory, or the runtime directory with ephemeral keys.
  [[nodiscard]] std::string folder() const;
  /// Whether the keys are ephemeral.
  [[nodiscard]] bool ephemeral_keys() const noexcept { return !trust_.on_disk(); }

  /// Registers a session, before `start`.
  void add_session(SessionRegistration opening);
  void watch(Shard& shard) { registry_.requests().watch(shard); }
  /// Begins to reply. @return the error; empty if there is none
  [[nodiscard]] std::string start();

  // ---- After `start`, from threads other than the control thread. Each call waits for its completion. ----
  /// Removes a session that is over. Afterwards the control thread does not access it.
  void close_session(const auth::Id16& id);
  /// Registers a session in place of one that ended, in a free slot of its shard.
  void add_running_session(SessionRegistration opening);
  /// Ends a session: all hands are released first.
  void end_session(const auth::Id16& id);
  /// From now on join requests are rejected, because the server is about to end.
  void drain();
  /// Time at which all hands are to be released, as an operator requested; nullopt without a request. Does not wait.
  [[nodiscard]] std::optional<Time> drain_due() const noexcept { return registry_.drain().due(); }
  /// Bound address of the metrics endpoint; nullopt without one.
  [[nodiscard]] std::optional<io::SocketAddress> metrics_address() const {
    return metrics_ ? std::optional(metrics_->address()) : std::nullopt;
  }

  /// Appends an event of a session to the audit log, on the control thread. Thread-safe, does not wait.
  void audit(std::string_view event, std::string session, std::string detail);
  /// Stops accepting and closes all control connections. Call it before the shards and sessions are destroyed.
  void stop();

 private:
  ControlServer(auth::ServerKeystore trust, const Options& plan);
  // Audit log (control_server_audit.cpp).
  /// Writes joins and rejections to the audit log. @return false if the source has too many such lines
  [[nodiscard]] bool record_event(const ControlEventRecord& news);
  /// Writes pending lines of the audit log, and reports when it fails and when it recovers.
  void service_audit_log();
  void close_audit_log();
  /// Writes the list of sessions for the local `tandem-server` commands, if it changed. @return the error
  [[nodiscard]] std::string write_serving_file();
  void schedule_serving_file();
  /// Checks repeatedly for revoked workstations; they lose seat, link test and connection. Also checks for a requested
  /// shutdown.
  void schedule_revocation_check();
  void on_thread(const std::function<void()>& what);

  auth::ServerKeystore trust_;
  std::function<void(const ControlEventRecord&)> on_event_;
  std::function<void(const std::string&)> on_message_;
  auth::AuditThrottle throttle_;
  std::uint64_t lost_reported_ = 0;  ///< lost audit lines that were reported
  bool audit_fails_ = false;         ///< a failure was reported
  ControlThread thread_;
  SessionRegistry registry_;
  SessionCommands commands_;
  SessionJoins joins_;
  ControlPlane plane_;
  std::optional<MetricsServer> metrics_;
  asio::steady_timer serving_timer_, revocation_timer_;
  std::vector<io::UdpSocket> sockets_;
  io::SocketAddress address_;
  std::optional<auth::RuntimeDirectory> local_;
  ServingSpec serving_;
  bool serving_fails_ = false;  ///< a failure was reported
  bool started_ = false;
};

}  // namespace tandem::server
