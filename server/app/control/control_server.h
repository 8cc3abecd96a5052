#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/auth/io/client_keystore.h"
#include "common/auth/io/server_keystore.h"
#include "common/io/udp_socket.h"
#include "server/app/control/audit_writer.h"
#include "server/app/control/control_options.h"
#include "server/app/control/control_plane.h"
#include "server/app/control/control_thread.h"
#include "server/app/control/session_joins.h"
#include "server/app/monitor/metrics_server.h"
#include "server/service/service_member.h"

namespace tandem::server {

/// The control side of a server process: keys, control connections on their own thread, registry of sessions, metrics
/// endpoint. On loopback without a state directory the keys are ephemeral. Clients of the same user then find the keys
/// in the runtime directory; nothing else differs.
class ControlServer {
 public:
  /// Called on the control thread.
  struct Handlers {
    std::function<void(const ControlEventRecord&)> on_event;
    /// Receives executed commands, one line each, for the operator of the server.
    std::function<void(const std::string&)> on_message;
  };
  /// @param steering  assignment of datagrams to shards
  /// @return the control server, listening but not yet replying; or the error and its remedy
  [[nodiscard]] static std::expected<std::unique_ptr<ControlServer>, std::string> open(const ControlOptions& options,
                                                                                       const io::Steering& steering,
                                                                                       const Handlers& handlers);
  ~ControlServer();

  /// The datagram sockets for the shards, all on the port of the control connections. May be called once.
  [[nodiscard]] std::vector<io::UdpSocket> take_sockets() { return std::move(sockets_); }
  [[nodiscard]] const io::SocketAddress& address() const noexcept { return address_; }
  /// Directory for checkpoints: the state directory, or the runtime directory with ephemeral keys.
  [[nodiscard]] std::string folder() const;
  /// Folder for marks and sheets: that of the options, else the state directory. Empty: ephemeral keys and none in the
  /// options, so notes end with the server.
  [[nodiscard]] std::string notes_folder() const;
  /// Whether the keys are ephemeral.
  [[nodiscard]] bool ephemeral_keys() const noexcept { return !trust_.on_disk(); }

  /// Bound address of the metrics endpoint; nullopt without one.
  [[nodiscard]] std::optional<io::SocketAddress> metrics_address() const {
    return metrics_ ? std::optional(metrics_->address()) : std::nullopt;
  }
  /// The sessions. Only for the control thread, except before `start`; `drain().due()` for any thread.
  [[nodiscard]] SessionRegistry& registry() noexcept { return registry_; }
  /// Orders of operators to create and end sessions, for the thread that executes them.
  [[nodiscard]] SessionOrders& orders() noexcept { return orders_; }
  /// Keys of this server.
  [[nodiscard]] const auth::ServerKeystore& trust() const noexcept { return trust_; }
  /// Sets the source of the metrics about a service. Call it before `start`. @param status  called on the control
  /// thread
  void set_service_status(std::function<ServiceStatus()> status) { service_status_ = std::move(status); }
  /// Its `post` is for any thread.
  [[nodiscard]] AuditWriter& audit() noexcept { return audit_; }

  /// Sets where the sessions of this server's service are. Call it before `start`.
  /// @param locator  must outlive this object
  void set_locator(SessionLocator& locator) {
    joins_.set_locator(&locator, trust_.membership() == nullptr ? std::string{} : trust_.membership()->name);
  }
  /// Sets where tickets are used once in the whole service. Call it before `start`. @param uses  must outlive this
  /// object
  void set_ticket_uses(TicketUses& uses) { joins_.set_ticket_uses(&uses); }
  /// Makes the tickets of this session's consoles valid again. Waits for the control thread.
  void release_consoles(const std::string& session);
  /// Membership in a service; null: the server belongs to none.
  [[nodiscard]] const auth::ServiceMembership* membership() const noexcept { return trust_.membership(); }

  /// Begins to reply. @return the error; empty if there is none
  [[nodiscard]] std::string start();
  /// Calls `change` on the control thread and waits until it has called `done`. From another thread, after `start`.
  void change(const std::function<void(SessionRegistry&, std::function<void()> done)>& change);
  /// Calls `what` later on the control thread. From any thread, while this object exists.
  void post(std::function<void()> what);
  /// Stops accepting and closes all control connections. Call it before the shards and sessions are destroyed.
  void stop();

 private:
  ControlServer(auth::ServerKeystore trust, const ControlOptions& options, const Handlers& handlers);
  /// Writes the list of sessions for the local `tandem-server` commands, if it changed. @return the error
  [[nodiscard]] std::string write_serving_file();
  void schedule_serving_file();
  /// Checks repeatedly for revoked workstations; they lose seat, link test and connection. Also checks for a requested
  /// shutdown.
  void schedule_revocation_check();

  auth::ServerKeystore trust_;
  std::string notes_;  ///< ControlOptions::notes
  std::function<void(const ControlEventRecord&)> on_event_;
  ControlThread thread_;
  AuditWriter audit_;
  SessionRegistry registry_;
  SessionOrders orders_;
  SessionCommands commands_;
  SessionJoins joins_;
  ControlPlane plane_;
  std::optional<MetricsServer> metrics_;
  asio::steady_timer serving_timer_, revocation_timer_;
  std::vector<io::UdpSocket> sockets_;
  io::SocketAddress address_;
  std::optional<auth::RuntimeDirectory> local_;
  ServingSpec serving_;
  std::function<ServiceStatus()> service_status_;  ///< empty: the server belongs to no service
  bool serving_fails_ = false;                     ///< a failure was reported
  bool started_ = false;
  bool stopping_ = false;  ///< of the control thread
};

}  // namespace tandem::server
