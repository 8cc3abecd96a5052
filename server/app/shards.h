#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "server/app/shard.h"

namespace tandem::server {

/// The threads that tick: one per tick rate, each with a socket of its own behind the one port. Sessions are told apart by their slot,
/// which is a byte of every connection id.
class Shards {
 public:
  /// @param tick_hz  of the session in each slot
  explicit Shards(std::span<const double> tick_hz);
  ~Shards() { join(); }

  /// Which socket gets the datagrams of which slot.
  [[nodiscard]] const io::Steering& steering() const noexcept { return steering_; }
  /// @param sockets  as `steering` wants them
  void take(std::vector<io::UdpSocket> sockets);
  [[nodiscard]] Shard& of_slot(std::size_t slot) noexcept { return *shards_[steering_.socket_of[slot]]; }
  [[nodiscard]] const std::vector<std::unique_ptr<Shard>>& all() const noexcept { return shards_; }

  void run();
  /// Ends all sessions gently. @param why  as their clients are told
  void stop(wire::CloseReason why = wire::CloseReason::kServerStops) noexcept;
  void join();
  /// Ticks that began within 1 ms of their time, so far, of the shard that had fewest.
  [[nodiscard]] std::uint64_t punctual() const noexcept;

 private:
  std::vector<double> rates_;  ///< one per shard
  io::Steering steering_;
  std::vector<std::unique_ptr<Shard>> shards_;
  std::vector<std::thread> threads_;
};

}  // namespace tandem::server
