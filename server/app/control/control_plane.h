#pragma once

#include <asio/steady_timer.hpp>
#include <cstdint>
#include <expected>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "common/auth/pending_slots.h"
#include "common/auth/returning_addresses.h"
#include "server/app/control/control_acceptor.h"
#include "server/app/control/control_connection.h"
#include "server/app/control/control_services.h"

namespace tandem::server {

/// Accepts TLS connections, enrols workstations, passes join requests to a `JoinHandler` and dispatches commands. All
/// members run on the thread of `context`. Only file access of the keystore blocks it.
class ControlPlane {
 public:
  /// @param trust  after `begin_serving`; from now on used by the context's thread only
  /// @pre before destruction: `stop`, and the context has run out of work (ControlThread does both)
  ControlPlane(asio::io_context& context, auth::ServerKeystore& trust, JoinHandler& join_handler,
               const ControlLimits& limits = {}, ControlClocks clocks = {},
               std::function<void(const ControlEventRecord&)> on_event = {});
  ~ControlPlane();
  ControlPlane(const ControlPlane&) = delete;
  ControlPlane& operator=(const ControlPlane&) = delete;

  /// Listens on an address. It may be called several times, before the context runs.
  /// @return the address with the chosen port, or the error
  [[nodiscard]] std::expected<io::SocketAddress, std::string> listen(const io::SocketAddress& at) {
    return acceptor_.listen(at);
  }
  /// Stops accepting and closes every connection. Call it on the context's thread.
  void stop();

  /// Ends the connections of revoked workstations, without waiting for a frame of them. Call it on the context's
  /// thread.
  void disconnect_revoked();

  /// Number of events so far. Thread-safe.
  [[nodiscard]] std::uint64_t count(ControlEvent event) const noexcept { return services_.events.count(event); }

 private:
  using Id = auth::PendingSlots::Id;
  /// A connection before its TLS handshake: only a socket.
  struct PendingConnection {
    asio::ip::tcp::socket socket;
    auth::Origin origin;
    std::string address;
    Time arrived;
  };

  void on_accepted(asio::ip::tcp::socket socket);
  void on_accept_failed(const asio::error_code& error);
  void wait_for_first_byte(Id id);
  void on_first_byte(Id id);
  void begin_handshake(Id id);
  /// Closes expired connections, begins the handshakes that may begin, and schedules the next call.
  void service_pending();
  void close_unproven(Id id, ControlEvent why);
  /// Closes connections that have not joined and are idle or too many.
  void close_unjoined();
  /// Checks four times per second which connections still own a seat or a console.
  void schedule_sweep();
  void on_change(const ControlConnection& connection, ConnectionChange change);

  ControlServices services_;
  ControlAcceptor acceptor_;
  auth::AcceptLimiter accept_limiter_;
  auth::PendingSlots pending_;
  auth::ReturningAddresses returning_;
  std::map<Id, std::shared_ptr<PendingConnection>> waiting_;
  std::map<Id, std::shared_ptr<ControlConnection>> connections_;
  asio::steady_timer pending_timer_, sweep_timer_;
  std::optional<Time> pending_due_;
  bool stopped_ = false, servicing_pending_ = false;
};

}  // namespace tandem::server
