#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "common/io/datagram_batch.h"
#include "common/io/spsc_queue.h"
#include "common/io/udp_socket.h"
#include "server/app/slaves.h"
#include "server/app/status.h"
#include "server/session.h"
#include "server/violations.h"

namespace tandem::server {

using TickQueue = io::SpscQueue<TickRecord>;

/// One thread, one socket, one session: receives a batch, steps the session once per tick on an absolute schedule,
/// sends a batch, and hands each tick's record to a queue. Nothing else ever delays it; no heap and no lock it could
/// wait for.
class Shard {
 public:
  /// @param socket   bound
  /// @param scene    must outlive the shard
  /// @param secret   unpredictable
  /// @param records  every tick of the running session
  Shard(io::UdpSocket socket, const SceneSpec& scene, Slaves slaves, std::uint64_t secret, TickQueue& records);

  /// Body of the thread: until the session is over.
  void run() noexcept;
  /// From any thread: lets all gates ramp out, tells the clients, ends.
  void stop() noexcept;

  /// A recent picture, from any thread.
  [[nodiscard]] SessionStatus status() const;
  /// Readable once `run` is over.
  [[nodiscard]] int finished_fd() const noexcept { return finished_.get(); }
  /// After `run`.
  [[nodiscard]] const SessionStatus& final_status() const noexcept { return picture_; }
  [[nodiscard]] const Violations& violations() const noexcept { return violations_; }
  [[nodiscard]] std::uint64_t stray() const noexcept { return session_.stray(); }

 private:
  void wait_until(Time due) noexcept;
  void receive(Time now) noexcept;
  void tick(Time now, std::uint32_t missed) noexcept;
  void send(Time now) noexcept;
  void look_at_seat(std::size_t seat, Time now) noexcept;
  void publish(Time now) noexcept;

  io::UdpSocket socket_;
  io::Fd wake_, finished_;
  const SceneSpec* scene_;
  Duration period_;
  Session session_;
  TickQueue* records_;
  Violations violations_;
  std::atomic<bool> stop_{false};

  static constexpr std::size_t kSendMax = io::SendBatch::kMax;
  io::ReceiveBatch in_;
  io::SendBatch out_;
  std::array<std::array<std::byte, link::kDatagramMax>, kSendMax> buffers_;
  std::array<io::SocketAddress, kSendMax> addresses_;

  std::uint64_t ticks_ = 0;
  SessionStatus picture_;
  mutable std::mutex published_lock_;  ///< the shard only tries it
  SessionStatus published_;
};

}  // namespace tandem::server
