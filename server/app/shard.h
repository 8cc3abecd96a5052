#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "common/io/datagram_batch.h"
#include "common/io/spsc_queue.h"
#include "common/io/udp_socket.h"
#include "server/app/hosted_session.h"
#include "server/app/order.h"
#include "server/app/tick_counts.h"
#include "server/load_ladder.h"

namespace tandem::server {

/// One thread, one socket, many sessions of one tick rate: receives a batch, carries out what the control plane ordered, steps every
/// session once per tick on an absolute schedule, sends a batch. Nothing else ever delays it; no heap and no lock it could wait for.
class Shard {
 public:
  static constexpr std::size_t kSessionsMax = 64;  ///< far more than a core can tick

  /// @param socket  bound
  Shard(io::UdpSocket socket, double tick_hz);

  /// Before `run`: serves this session from its start. @return false: its slot is taken
  bool host(HostedSession& session) noexcept;
  /// Body of the thread: until `stop` was called and the last session is over.
  void run() noexcept;
  /// From any thread: ends all sessions gently, then itself. @param why  as their clients are told
  void stop(wire::CloseReason why = wire::CloseReason::kServerStops) noexcept;

  // ---- The control plane's thread ----
  /// @return false: too many orders wait; nothing was taken
  [[nodiscard]] bool post(Order& order) noexcept;
  /// The next order that was carried out, null if there is none.
  [[nodiscard]] Order* answered() noexcept;
  /// Readable when an order was carried out or a session is over.
  [[nodiscard]] int news_fd() const noexcept { return news_.get(); }
  void news_read() noexcept;

  [[nodiscard]] const io::SocketAddress& address() const noexcept { return socket_.local; }
  /// Share of a tick's time that it takes of a processor: the 99th percentile of the last 1000 ticks [1]. Others' work on this machine does
  /// not count; it shows in the late ticks. From any thread.
  [[nodiscard]] double load() const noexcept { return load_.load(std::memory_order_relaxed); }
  /// Processor time of this thread, all it does, over the last second: share of one processor [1]. From any thread.
  [[nodiscard]] double core() const noexcept { return core_.load(std::memory_order_relaxed); }
  /// What it goes without now. From any thread.
  [[nodiscard]] Relief relief() const noexcept { return {rung_.load(std::memory_order_relaxed), passive_.load(std::memory_order_relaxed)}; }
  /// How punctual and how long ticks are. From any thread.
  [[nodiscard]] const TickCounts& lateness() const noexcept { return lateness_; }
  [[nodiscard]] const TickCounts& lengths() const noexcept { return lengths_; }
  [[nodiscard]] Duration period() const noexcept { return period_; }
  /// Ticks that began more than 1 ms after their time, so far, and the last moment at which one was through. From any thread.
  [[nodiscard]] std::uint64_t late() const noexcept { return late_.load(std::memory_order_relaxed); }
  [[nodiscard]] Time turned() const noexcept { return Time{Duration{turned_.load(std::memory_order_relaxed)}}; }
  /// Datagrams that belong to no session, so far. From any thread.
  [[nodiscard]] std::uint64_t stray() const noexcept { return stray_.load(std::memory_order_relaxed); }

 private:
  void wait_until(Time due) noexcept;
  void receive() noexcept;
  void carry_out(Time now) noexcept;
  void carry_out(Time now, Order& order) noexcept;
  void tick(Time now, std::uint32_t missed) noexcept;
  void send(Time now, Session& session) noexcept;
  void flush() noexcept;
  void weigh(Time now, Duration late) noexcept;
  void measure(Duration spent) noexcept;
  void measure_core(Time now, Duration used) noexcept;

  io::UdpSocket socket_;
  io::Fd wake_, news_;
  Duration period_;
  std::array<HostedSession*, kSessionsMax> sessions_{};
  std::atomic<bool> stop_{false};
  std::atomic<wire::CloseReason> stop_reason_{wire::CloseReason::kServerStops};
  io::SpscQueue<Order*> orders_, answers_;
  MachineStatus machine_;

  static constexpr std::size_t kSendMax = io::SendBatch::kMax;
  io::ReceiveBatch in_;
  Time read_until_{};  ///< the socket was empty then
  io::SendBatch out_;
  std::array<std::array<std::byte, link::kDatagramMax>, kSendMax> buffers_;
  std::array<io::SocketAddress, kSendMax> addresses_;

  LoadLadder ladder_;
  Duration used_{};  ///< processor time of the last tick
  std::atomic<Rung> rung_{Rung::kNothing};
  std::atomic<bool> passive_{false};
  Histogram spent_;
  TickCounts lateness_, lengths_;
  std::atomic<std::uint64_t> late_{0};
  std::atomic<std::int64_t> turned_{0};
  std::atomic<double> load_{0}, core_{0};
  Time core_since_{};
  Duration core_used_{};
  std::atomic<std::uint64_t> stray_{0};
};

}  // namespace tandem::server
