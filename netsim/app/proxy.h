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
#include "common/io/fd.h"
#include "common/io/socket_address.h"
#include "common/io/spsc_queue.h"
#include "netsim/app/live_delays.h"
#include "netsim/app/newcomer_pool.h"
#include "netsim/app/proxy_clients.h"
#include "netsim/app/proxy_order.h"
#include "netsim/app/proxy_outbox.h"
#include "netsim/app/proxy_status.h"
#include "netsim/app/proxy_waiting_room.h"
#include "netsim/link_watch.h"
#include "netsim/proxy_core.h"

namespace tandem::netsim {

/// The live proxy: one thread, two sockets per client (ProxyClients). Moments of arrival are the kernel's, so neither a
/// late wake-up nor late reading moves the schedule: a network that delays by L is read only every L / 2, many
/// datagrams at a time. Deadlines are absolute; how late each datagram left is counted.
class Proxy {
 public:
  /// Binds the listening socket. @return the proxy, or what went wrong and what to do about it
  /// @throws std::invalid_argument when the link cannot be simulated
  [[nodiscard]] static std::expected<std::unique_ptr<Proxy>, std::string> open(const ProxyOptions& options);

  /// The address that clients send to, with the port in force.
  [[nodiscard]] const io::SocketAddress& listening() const noexcept { return clients_.listening(); }

  /// Works until `stop`, or until the duration is over.
  void run();
  /// From any thread or signal handler.
  void stop() noexcept;

  /// Hands an order to the packet thread; from one thread only. It must live until `done`, or until `run` returned.
  /// @return false: too many wait
  bool post(ProxyOrder& order) noexcept;
  /// From the thread that posts orders, now and then and when `wanted_fd` is readable: makes what clients to come need, so that
  /// the packet thread takes no memory when they do (NewcomerPool).
  void refill() { newcomers_.refill(); }
  [[nodiscard]] int wanted_fd() const noexcept { return newcomers_.wanted_fd(); }
  /// Clients for whom nothing was ready: more came at once than NewcomerPool::kReady. From any thread.
  [[nodiscard]] std::uint64_t unprepared() const noexcept { return newcomers_.missed(); }
  /// Time since `run` began, from any thread once it has.
  [[nodiscard]] Duration now() const noexcept { return since_start(); }
  /// To prepare changes; only what ProxyCore allows to any thread.
  [[nodiscard]] const ProxyCore& core() const noexcept { return core_; }

  /// A recent picture, from any thread.
  [[nodiscard]] ProxyStatus status() const;
  /// What the client in this place got, actually, not by schedule; from any thread.
  [[nodiscard]] const LiveDelays& delays(std::uint32_t place, Direction direction) const noexcept {
    return delays_[place * kDirections + static_cast<std::size_t>(direction)];
  }

  [[nodiscard]] Duration late_limit() const noexcept { return options_.late_limit; }
  /// How late datagrams left, from any thread.
  [[nodiscard]] const LiveDelays& late_now() const noexcept { return late_now_; }

  /// After `run`: tells the sink what is still under way.
  void log_waiting() const noexcept { core_.log_waiting(); }
  /// After `run`: everything, and how late datagrams were sent compared with their schedule.
  [[nodiscard]] ProxyStatus final_status() const;
  [[nodiscard]] const Histogram& lateness() const noexcept { return lateness_; }
  /// All clients, also those that left; of very many the first thousand.
  [[nodiscard]] std::vector<ProxyClientStatus> client_reports() const;
  /// Of the first ProxyCore::kClientsMax clients.
  [[nodiscard]] std::vector<ProxyClientQuality> qualities() const;

 private:
  struct Watched {
    std::uint64_t number = 0;
    std::unique_ptr<LinkWatch> watch;
  };
  Proxy(const ProxyOptions& options, ProxyClients clients, io::Fd wake);

  // The pump: proxy.cpp
  [[nodiscard]] Duration since_start() const noexcept;
  void work(Duration now) noexcept;
  void sleep_until(Duration moment) const noexcept;
  [[nodiscard]] std::size_t read_ready(Duration wait) noexcept;
  void send_due() noexcept;
  void send_outbox() noexcept;
  [[nodiscard]] ProxySource way_out(const ProxyCore::Egress& egress) noexcept;
  // What comes in, from whom: proxy_arrivals.cpp
  std::size_t read(ProxySource source) noexcept;
  std::size_t read_strangers() noexcept;
  std::size_t receive_strangers(int fd) noexcept;
  std::size_t receive(int fd) noexcept;
  [[nodiscard]] Time moment_of(Duration stamp) const noexcept;
  [[nodiscard]] std::optional<std::uint32_t> client_of(std::size_t message, const io::LocalAddress& local) noexcept;
  [[nodiscard]] std::optional<std::uint32_t> welcome(const io::PeerKey& key, std::size_t message,
                                                     const io::LocalAddress& local) noexcept;
  // Who is there, and what others are told: proxy_house.cpp
  void housekeeping(Duration now) noexcept;
  void forget_idle() noexcept;
  void forget(std::uint32_t place) noexcept;
  void carry_out_orders() noexcept;
  void plan_reading(const LinkSpec& link) noexcept;
  [[nodiscard]] ProxyClientStatus picture_of(std::uint32_t place) const noexcept;
  void fill(ProxyStatus& status) const noexcept;
  void publish() noexcept;

  ProxyOptions options_;
  ProxyClients clients_;
  io::Fd wake_;  ///< others write to it
  std::atomic<bool> stopping_{false};
  io::SpscQueue<ProxyOrder*> orders_;
  ProxyCore core_;
  NewcomerPool newcomers_;
  io::ReceiveBatch in_;
  ProxyWaitingRoom waiting_;
  io::SendBatch out_;
  ProxyOutbox outbox_;
  Histogram lateness_;
  LiveDelays late_now_;
  std::unique_ptr<LiveDelays[]> delays_;
  std::vector<Watched> watched_;  ///< by arrival; never more than reserved
  ProxyTroubles troubles_;
  std::uint64_t released_ = 0, late_ = 0;
  std::atomic<Duration> started_{};  ///< CLOCK_MONOTONIC
  Duration now_{};                   ///< since start, read once per round
  bool at_once_ = false;             ///< datagrams meet on the way: they must be read as they come
  Duration least_delay_{};           ///< of all links there are and will be
  Duration reading_interval_{};      ///< 0: as soon as something comes
  Duration read_until_{};            ///< all that came by then has been read
  Duration tried_until_{};           ///< what was due by then and could leave has left
  Duration last_read_{}, last_sent_{}, next_housekeeping_{};
  Duration wall_at_start_{};  ///< CLOCK_REALTIME at the start, by the clocks of this round
  bool busy_ = false;  ///< something came lately or is under way
  std::vector<ProxyClientStatus> left_;
  std::uint64_t drops_of_left_ = 0;  ///< by the kernel, of clients that left
  mutable std::mutex published_lock_;
  ProxyStatus published_;
};

}  // namespace tandem::netsim
