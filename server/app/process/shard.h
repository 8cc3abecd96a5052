#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "common/io/datagram_batch.h"
#include "common/io/event_fd.h"
#include "common/io/spsc_queue.h"
#include "common/io/udp_socket.h"
#include "proto/rpc/rpc_limits.h"
#include "server/app/process/live_session.h"
#include "server/app/process/shard_load.h"
#include "server/app/process/shard_request.h"

namespace tandem::server {

/// Thread body that serves sessions of one tick rate over one socket. Per tick, on an absolute schedule, it receives a
/// batch, steps every session and sends a batch. Between ticks it executes the control plane's requests. It uses no
/// heap and waits for no lock.
///
/// Ticks begin at multiples of the period since the zero of the monotonic clock, and that multiple is their number.
/// Shards of one rate therefore tick at the same times with the same numbers. A session passes from one to another
/// between two ticks (kMoveSession): the shard changes the kernel's program, reads its socket once more, then passes
/// the session on. Without sessions a shard wakes 50 times a second only.
class Shard {
 public:
  static constexpr std::size_t kSessionsMax = rpc::kSessionsMax;  ///< one per slot

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
  /// Posts a request; it must stay valid until `next_completed` returns it, here or at the target of a move.
  /// @return false: as many as the queue holds are in progress
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
  /// Number of sessions that it serves. Thread-safe.
  [[nodiscard]] std::size_t sessions() const noexcept { return served_count_.load(std::memory_order_relaxed); }
  /// Whether `run` has returned, or is about to. Thread-safe.
  [[nodiscard]] bool ended() const noexcept { return arrival_.load(std::memory_order_relaxed) == &closed_; }
  /// Datagrams so far that belong to no session. Thread-safe.
  [[nodiscard]] std::uint64_t unmatched_datagrams() const noexcept {
    return unmatched_datagrams_.load(std::memory_order_relaxed);
  }

 private:
  void wait_until(Time due) noexcept;
  [[nodiscard]] Time time_of(std::uint64_t tick) const noexcept {
    return Time{static_cast<std::int64_t>(tick) * period_};
  }
  [[nodiscard]] std::uint64_t tick_at(Time now) const noexcept {
    return static_cast<std::uint64_t>(now.time_since_epoch() / period_);
  }
  [[nodiscard]] std::uint64_t next_tick() const noexcept;
  void skip_idle_ticks(Time now) noexcept;
  [[nodiscard]] bool serving() const noexcept { return count_ > 0; }
  void serve(LiveSession& session) noexcept;
  void forget(const LiveSession& session) noexcept;
  void begin_move(ShardRequest& move) noexcept;
  /// Executes `moving_` after a tick, if enough of the period is left.
  void pass_on() noexcept;
  void reject_move() noexcept;
  /// For the thread of another shard. @return false: this shard has ended, or another session is arriving
  [[nodiscard]] bool take_over(ShardRequest& move) noexcept;
  void serve_arrival() noexcept;
  /// A shard that has ended may run again.
  void open_arrivals() noexcept;
  /// From now on no session arrives. @return false: one has arrived before
  [[nodiscard]] bool close_arrivals() noexcept;
  void complete(ShardRequest& request) noexcept;
  void end_all(wire::CloseReason why) noexcept;
  void receive() noexcept;
  void execute_requests(Time now) noexcept;
  void execute(Time now, ShardRequest& request) noexcept;
  void stagger(LiveSession& session) noexcept;
  void tick(Time now) noexcept;
  void step(Time now, std::uint32_t missed, LiveSession& live, bool measured) noexcept;
  void send(Time now, Session& session) noexcept;
  void flush() noexcept;

  io::UdpSocket socket_;
  io::EventFd wake_, completions_;
  Duration period_;
  std::uint64_t idle_;                                 ///< [ticks] between two ticks without a session
  std::uint64_t tick_ = 0;                             ///< number of the last tick
  std::array<LiveSession*, kSessionsMax> sessions_{};  ///< by slot
  std::array<LiveSession*, kSessionsMax> served_{};    ///< the first `count_`: the same without gaps, in their order
  std::size_t count_ = 0;
  std::size_t seats_ = 0;                     ///< of these sessions
  std::size_t measured_ = 0;                  ///< place in `served_` of the session whose cost this tick measures
  std::atomic<std::size_t> served_count_{0};  ///< `count_` for other threads
  ShardRequest* moving_ = nullptr;            ///< kMoveSession in progress
  int waited_ticks_ = 0;                      ///< of `moving_`
  ShardRequest closed_;                       ///< its address in `arrival_`: no session may arrive
  std::atomic<ShardRequest*> arrival_{nullptr};
  std::atomic<bool> stop_{false};
  std::atomic<wire::CloseReason> stop_reason_{wire::CloseReason::kServerStops};
  io::SpscQueue<ShardRequest*> requests_, completed_;
  std::size_t posted_ = 0;  ///< requests that `next_completed` has not returned; so `completed_` has a place for each

  static constexpr std::size_t kSendMax = io::SendBatch::kMax;
  io::ReceiveBatch in_;
  Duration reading_left_{};  ///< time that this tick may still spend on receiving
  Time read_until_{};        ///< time at which the socket was last empty
  io::SendBatch out_;
  std::array<std::array<std::byte, transport::kDatagramMax>, kSendMax> buffers_;
  std::array<io::SocketAddress, kSendMax> addresses_;

  ShardLoad load_;
  std::atomic<std::uint64_t> unmatched_datagrams_{0};
};

}  // namespace tandem::server
