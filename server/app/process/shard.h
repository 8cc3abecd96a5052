#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "common/io/datagram_batch.h"
#include "common/io/event_fd.h"
#include "common/io/spsc_queue.h"
#include "common/io/udp_socket.h"
#include "server/app/process/live_session.h"
#include "server/app/process/shard_request.h"
#include "server/app/process/tick_histogram.h"
#include "server/policy/load_shedder.h"

namespace tandem::server {

/// Thread body that serves sessions of one tick rate over one socket. Per tick, on an absolute schedule, it receives a
/// batch, steps every session and sends a batch. Between ticks it executes the control plane's requests. It uses no
/// heap and waits for no lock.
class Shard {
 public:
  static constexpr std::size_t kSessionsMax = 64;  ///< far more than one core can tick

  /// @param socket  bound
  Shard(io::UdpSocket socket, double tick_hz);

  /// Adds a session before `run`. @return false if its slot is in use
  bool add_session(LiveSession& session) noexcept;
  /// Body of the thread. Returns when `stop` was called and the last session is over.
  void run() noexcept;
  /// Ends all sessions, which release their hands first, then `run`. Thread-safe. @param why reason in the clients'
  /// CLOSE
  void stop(wire::CloseReason why = wire::CloseReason::kServerStops) noexcept;

  // ---- The control plane's thread ----
  /// Posts a request; it must stay valid until `next_completed` returns it. @return false if the queue is full
  [[nodiscard]] bool post(ShardRequest& order) noexcept;
  /// Next completed request; null if there is none.
  [[nodiscard]] ShardRequest* next_completed() noexcept;
  /// File descriptor that becomes readable when a request is completed or a session is over.
  [[nodiscard]] int completion_fd() const noexcept { return completions_.get(); }
  void clear_completions() noexcept;

  [[nodiscard]] const io::SocketAddress& address() const noexcept { return socket_.local; }
  /// Load of a tick: processor time / period, the 99th percentile of the last 1000 ticks [1]. Thread-safe. Other
  /// processes do not count; they show as late ticks.
  [[nodiscard]] double load() const noexcept { return load_.load(std::memory_order_relaxed); }
  /// Processor time of this thread over the last second, as share of one processor [1]. Thread-safe.
  [[nodiscard]] double cpu_share() const noexcept { return cpu_share_.load(std::memory_order_relaxed); }
  /// Current shed level. Thread-safe.
  [[nodiscard]] LoadState load_state() const noexcept {
    return {shed_level_.load(std::memory_order_relaxed), overloaded_.load(std::memory_order_relaxed)};
  }
  /// Histograms of the lateness and the length of ticks. Thread-safe.
  [[nodiscard]] const TickHistogram& lateness() const noexcept { return lateness_; }
  [[nodiscard]] const TickHistogram& lengths() const noexcept { return lengths_; }
  [[nodiscard]] Duration period() const noexcept { return period_; }
  /// Ticks so far that began more than 1 ms late, and the time when the last tick began. Thread-safe.
  [[nodiscard]] std::uint64_t late_ticks() const noexcept { return late_ticks_.load(std::memory_order_relaxed); }
  [[nodiscard]] Time last_tick() const noexcept { return Time{Duration{last_tick_.load(std::memory_order_relaxed)}}; }
  /// Datagrams so far that belong to no session. Thread-safe.
  [[nodiscard]] std::uint64_t unmatched_datagrams() const noexcept {
    return unmatched_datagrams_.load(std::memory_order_relaxed);
  }

 private:
  void wait_until(Time due) noexcept;
  void receive() noexcept;
  void execute_requests(Time now) noexcept;
  void execute_requests(Time now, ShardRequest& order) noexcept;
  void tick(Time now, std::uint32_t missed) noexcept;
  void send(Time now, Session& session) noexcept;
  void flush() noexcept;
  void update_load_state(Time now, Duration late) noexcept;
  void measure_tick(Duration spent) noexcept;
  void measure_core(Time now, Duration used) noexcept;

  io::UdpSocket socket_;
  io::EventFd wake_, completions_;
  Duration period_;
  std::array<LiveSession*, kSessionsMax> sessions_{};
  std::atomic<bool> stop_{false};
  std::atomic<wire::CloseReason> stop_reason_{wire::CloseReason::kServerStops};
  io::SpscQueue<ShardRequest*> requests_, completed_;
  MachineStatus machine_;

  static constexpr std::size_t kSendMax = io::SendBatch::kMax;
  io::ReceiveBatch in_;
  Time read_until_{};  ///< time at which the socket was last empty
  io::SendBatch out_;
  std::array<std::array<std::byte, transport::kDatagramMax>, kSendMax> buffers_;
  std::array<io::SocketAddress, kSendMax> addresses_;

  LoadShedder load_shedder_;
  Duration used_{};  ///< processor time of the last tick
  std::atomic<ShedLevel> shed_level_{ShedLevel::kNone};
  std::atomic<bool> overloaded_{false};
  Histogram spent_;
  TickHistogram lateness_, lengths_;
  std::atomic<std::uint64_t> late_ticks_{0};
  std::atomic<std::int64_t> last_tick_{0};
  std::atomic<double> load_{0}, cpu_share_{0};
  Time core_since_{};
  Duration core_used_{};
  std::atomic<std::uint64_t> unmatched_datagrams_{0};
};

}  // namespace tandem::server
