#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <expected>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/base/histogram.h"
#include "common/base/time.h"
#include "common/io/datagram_batch.h"
#include "common/io/event_fd.h"
#include "common/io/fd.h"
#include "common/io/published.h"
#include "common/io/socket_address.h"
#include "common/io/spsc_queue.h"
#include "netsim/proxy/app/arrival_buffer.h"
#include "netsim/proxy/app/client_pool.h"
#include "netsim/proxy/app/live_delay_histogram.h"
#include "netsim/proxy/app/proxy_clients.h"
#include "netsim/proxy/app/proxy_request.h"
#include "netsim/proxy/app/proxy_status.h"
#include "netsim/proxy/app/send_queue.h"
#include "netsim/proxy/proxy_core.h"
#include "netsim/quality/link_monitor.h"

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
  void stop() noexcept;

  /// Passes a request to the packet thread. One posting thread only. The request must live until `done`, or until `run`
  /// returns.
  /// @return false if the request queue is full
  bool post(ProxyRequest& order) noexcept;
  /// Prepares resources of future clients, so that the packet thread allocates nothing when they arrive (ClientPool).
  /// The posting thread calls it periodically and when `wanted_fd` is readable.
  void refill() { client_pool_.refill(); }
  [[nodiscard]] int wanted_fd() const noexcept { return client_pool_.wanted_fd(); }
  /// Returns the number of clients without prepared resources: more than ClientPool::kReady arrived at once. Any
  /// thread.
  [[nodiscard]] std::uint64_t pool_misses() const noexcept { return client_pool_.misses(); }
  /// Returns the time since `run` began. Any thread, once `run` has begun.
  [[nodiscard]] Duration now() const noexcept { return since_start(); }
  /// Returns the core, for preparing changes. Other threads may use only what ProxyCore permits to any thread.
  [[nodiscard]] const ProxyCore& core() const noexcept { return core_; }

  /// Returns a recent status. Any thread.
  [[nodiscard]] ProxyStatus status() const;
  /// Returns the measured (not scheduled) delays of the client in this place. Any thread.
  [[nodiscard]] const LiveDelayHistogram& delays(std::uint32_t place, Direction direction) const noexcept {
    return delays_[place * kDirections + static_cast<std::size_t>(direction)];
  }

  [[nodiscard]] Duration late_limit() const noexcept { return options_.late_limit; }
  /// Returns the lateness of sent datagrams. Any thread.
  [[nodiscard]] const LiveDelayHistogram& live_lateness() const noexcept { return live_lateness_; }

  /// After `run`: logs all datagrams in flight.
  void log_in_flight() const noexcept { core_.log_in_flight(); }
  /// After `run`: returns the complete status; `lateness` compares sending times with the schedule.
  [[nodiscard]] ProxyStatus final_status() const;
  [[nodiscard]] const Histogram& lateness() const noexcept { return lateness_; }
  /// Returns all connected clients and the first 1024 clients that left.
  [[nodiscard]] std::vector<ProxyClientStatus> client_reports() const;
  /// Returns the link quality of the first ProxyCore::kClientsMax clients.
  [[nodiscard]] std::vector<ProxyClientQuality> qualities() const;

 private:
  struct MonitoredClient {
    std::uint64_t number = 0;
    std::unique_ptr<LinkMonitor> monitor;
  };
  Proxy(const ProxyOptions& options, ProxyClients clients, io::EventFd wake);

  // Main loop: proxy.cpp
  [[nodiscard]] Duration since_start() const noexcept;
  void work(Duration now) noexcept;
  void sleep_until(Duration moment) const noexcept;
  [[nodiscard]] std::size_t read_ready(Duration wait) noexcept;
  void send_due() noexcept;
  void flush_send_queue() noexcept;
  [[nodiscard]] ProxySource egress_socket(const ProxyCore::Egress& egress) noexcept;
  // Receiving and identification of clients: proxy_receive.cpp
  std::size_t read(ProxySource source) noexcept;
  std::size_t read_unknown_senders() noexcept;
  std::size_t receive_unknown_senders(int fd) noexcept;
  std::size_t receive(int fd) noexcept;
  [[nodiscard]] Time arrival_time(Duration stamp) const noexcept;
  [[nodiscard]] std::optional<std::uint32_t> client_of(std::size_t message, const io::LocalAddress& local) noexcept;
  [[nodiscard]] std::optional<std::uint32_t> admit_client(const io::PeerKey& key, std::size_t message,
                                                          const io::LocalAddress& local) noexcept;
  // Client maintenance, requests and status: proxy_maintenance.cpp
  void maintain(Duration now) noexcept;
  void remove_idle_clients() noexcept;
  void remove_client(std::uint32_t place) noexcept;
  void process_requests() noexcept;
  void update_reading_interval(const LinkSpec& link) noexcept;
  [[nodiscard]] ProxyClientStatus client_status(std::uint32_t place) const noexcept;
  void fill(ProxyStatus& status) const noexcept;
  void publish() noexcept;

  ProxyOptions options_;
  ProxyClients clients_;
  io::EventFd wake_;  ///< written by other threads
  std::atomic<bool> stopping_{false};
  io::SpscQueue<ProxyRequest*> requests_;
  ProxyCore core_;
  ClientPool client_pool_;
  io::ReceiveBatch in_;
  ArrivalBuffer arrivals_;
  io::SendBatch out_;
  SendQueue send_queue_;
  Histogram lateness_;
  LiveDelayHistogram live_lateness_;
  std::unique_ptr<LiveDelayHistogram[]> delays_;
  std::vector<MonitoredClient> monitored_;  ///< by order of arrival; never above the reserved capacity
  ProxyErrors errors_;
  std::uint64_t released_ = 0, late_ = 0;
  std::atomic<Duration> started_{};  ///< CLOCK_MONOTONIC
  Duration now_{};                   ///< time since the start, read once per round
  bool read_immediately_ = false;    ///< datagrams affect each other: read them as they arrive
  Duration least_delay_{};           ///< minimum over all present and future links
  Duration reading_interval_{};      ///< 0: read at every arrival
  Duration read_until_{};            ///< all datagrams that arrived by then were read
  Duration tried_until_{};           ///< all datagrams due by then that could leave were sent
  Duration last_read_{}, last_sent_{}, next_maintenance_{};
  Duration wall_at_start_{};  ///< CLOCK_REALTIME at the start, derived from this round's clocks
  bool busy_ = false;         ///< recent arrivals, or datagrams in flight
  std::vector<ProxyClientStatus> departed_;
  std::uint64_t departed_drops_ = 0;  ///< kernel drops of clients that left
  io::Published<ProxyStatus> published_;
};

}  // namespace tandem::netsim
