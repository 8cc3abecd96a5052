#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "common/io/fd.h"
#include "common/io/published.h"
#include "common/io/socket_address.h"
#include "netsim/proxy/app/client_registry.h"
#include "netsim/proxy/app/proxy_clients.h"
#include "netsim/proxy/app/proxy_clock.h"
#include "netsim/proxy/app/proxy_inbox.h"
#include "netsim/proxy/app/proxy_receiver.h"
#include "netsim/proxy/app/proxy_request.h"
#include "netsim/proxy/app/proxy_sender.h"
#include "netsim/proxy/app/proxy_status.h"
#include "netsim/proxy/app/reading_interval.h"
#include "netsim/proxy/proxy_core.h"

namespace tandem::netsim {

/// Live proxy with one thread and two sockets per client (ProxyClients). Arrival times are the kernel's, so that late
/// wake-ups or reads do not change the schedule. A network with delay L is read only every L / 2, many datagrams at a
/// time. Deadlines are absolute, and the lateness of each datagram is counted.
class Proxy {
 public:
  /// Binds the listening socket. Returns the proxy, or an error with a remedy.
  /// @throws std::invalid_argument if the link is invalid
  [[nodiscard]] static std::expected<std::unique_ptr<Proxy>, std::string> open(const ProxyOptions& options);

  /// Returns the address to which clients send, with the actual port.
  [[nodiscard]] const io::SocketAddress& listening() const noexcept { return clients_.listening(); }

  /// Runs until `stop`, or until the configured duration ends.
  void run();
  /// Stops the proxy. Any thread or signal handler.
  void stop() noexcept { inbox_.stop(); }

  /// Passes a request to the packet thread. One posting thread only. The request must live until `done`, or until `run`
  /// returns.
  /// @return false if the request queue is full
  bool post(ProxyRequest& request) noexcept;
  /// Returns the pool of prepared clients, so that the packet thread allocates nothing when clients arrive. The posting
  /// thread refills it periodically and when its `wanted_fd` is readable.
  [[nodiscard]] ClientPool& pool() noexcept { return registry_.pool(); }
  /// Returns the time since `run` began. Any thread, once `run` has begun.
  [[nodiscard]] Duration now() const noexcept { return clock_.now(); }
  /// Returns the factory that prepares changes. Any thread.
  [[nodiscard]] const LinkFactory& links() const noexcept { return core_.links(); }

  /// Returns a recent status. Any thread.
  [[nodiscard]] ProxyStatus status() const;
  /// Returns the measured delays of the clients. Any thread.
  [[nodiscard]] const ClientDelays& delays() const noexcept { return delays_; }
  /// Returns the sender, which measures the lateness of sent datagrams. Any thread may read its `live_lateness`; read
  /// all else after `run`.
  [[nodiscard]] const ProxySender& sender() const noexcept { return sender_; }
  [[nodiscard]] Duration late_limit() const noexcept { return options_.late_limit; }

  /// After `run`: logs all datagrams in flight.
  void log_in_flight() const noexcept { core_.log_in_flight(); }
  /// After `run`: returns the complete status.
  [[nodiscard]] ProxyStatus final_status() const;
  /// After `run`: returns all connected clients and the first 1024 clients that left, and the link quality of the first
  /// ProxyCore::kClientsMax clients.
  [[nodiscard]] std::vector<ProxyClientStatus> client_reports() const { return registry_.reports(now_); }
  [[nodiscard]] std::vector<ProxyClientQuality> qualities() const { return registry_.qualities(); }

 private:
  Proxy(const ProxyOptions& options, ProxyClients clients);

  void run_round() noexcept;
  [[nodiscard]] std::size_t read_ready(Duration wait) noexcept;
  void send_due() noexcept;
  void process_requests() noexcept;
  void execute(ProxyRequest& request) noexcept;
  void fill(ProxyStatus& status) const noexcept;
  void publish() noexcept;

  ProxyOptions options_;
  ProxyErrors errors_;
  ProxyClients clients_;
  ProxyInbox inbox_;
  ProxyCore core_;
  ProxyClock clock_;
  ClientDelays delays_;
  ClientRegistry registry_;
  ProxyReceiver receiver_;
  ProxySender sender_;
  ReadingInterval reading_interval_;
  Duration now_{};          ///< time since the start, read once per round
  Duration read_until_{};   ///< all datagrams that arrived by then were read
  Duration tried_until_{};  ///< all datagrams due by then that could leave were sent
  Duration last_read_{}, next_maintenance_{};
  bool busy_ = false;  ///< recent arrivals, or datagrams in flight
  io::Published<ProxyStatus> published_;
};

}  // namespace tandem::netsim
