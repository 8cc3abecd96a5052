#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "common/io/datagram_batch.h"
#include "common/io/event_fd.h"
#include "common/io/spsc_queue.h"
#include "common/io/udp_socket.h"
#include "server/app/process/live_session.h"
#include "server/app/process/shard_load.h"
#include "server/app/process/shard_request.h"

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
  [[nodiscard]] bool post(ShardRequest& request) noexcept;
  /// Next completed request; null if there is none.
  [[nodiscard]] ShardRequest* next_completed() noexcept;
  /// File descriptor that becomes readable when a request is completed or a session is over.
  [[nodiscard]] int completion_fd() const noexcept { return completions_.get(); }
  void clear_completions() noexcept;

  [[nodiscard]] const io::SocketAddress& address() const noexcept { return socket_.local; }
  /// Its members for any thread are thread-safe.
  [[nodiscard]] const ShardLoad& load() const noexcept { return load_; }
  [[nodiscard]] Duration period() const noexcept { return period_; }
  /// Datagrams so far that belong to no session. Thread-safe.
  [[nodiscard]] std::uint64_t unmatched_datagrams() const noexcept {
    return unmatched_datagrams_.load(std::memory_order_relaxed);
  }

 private:
  void wait_until(Time due) noexcept;
  void receive() noexcept;
  void execute_requests(Time now) noexcept;
  void execute(Time now, ShardRequest& request) noexcept;
  void stagger(LiveSession& session) noexcept;
  void tick(Time now, Time due, std::uint32_t missed) noexcept;
  void send(Time now, Session& session) noexcept;
  void flush() noexcept;

  io::UdpSocket socket_;
  io::EventFd wake_, completions_;
  Duration period_;
  std::uint32_t ticks_ = 0;  ///< so far, with missed ones
  std::array<LiveSession*, kSessionsMax> sessions_{};
  std::atomic<bool> stop_{false};
  std::atomic<wire::CloseReason> stop_reason_{wire::CloseReason::kServerStops};
  io::SpscQueue<ShardRequest*> requests_, completed_;

  static constexpr std::size_t kSendMax = io::SendBatch::kMax;
  io::ReceiveBatch in_;
  Time read_until_{};  ///< time at which the socket was last empty
  io::SendBatch out_;
  std::array<std::array<std::byte, transport::kDatagramMax>, kSendMax> buffers_;
  std::array<io::SocketAddress, kSendMax> addresses_;

  ShardLoad load_;
  std::atomic<std::uint64_t> unmatched_datagrams_{0};
};

}  // namespace tandem::server
