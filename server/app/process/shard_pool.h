#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "server/app/process/shard.h"

namespace tandem::server {

/// The tick threads: one shard per tick rate, each with its own socket on the shared port. The kernel distributes
/// datagrams by the session's slot, which is a byte of every connection id.
class ShardPool {
 public:
  /// @param tick_hz  of the session in each slot; sessions that are created later have one of these rates
  explicit ShardPool(std::span<const double> tick_hz);
  ~ShardPool() { join(); }

  /// Assignment of slots to sockets.
  [[nodiscard]] const io::Steering& steering() const noexcept { return steering_; }
  /// @param sockets  one per shard, as `steering` requires
  void take_sockets(std::vector<io::UdpSocket> sockets);
  [[nodiscard]] Shard& of_slot(std::size_t slot) noexcept { return *shards_[steering_.socket_of[slot]]; }
  /// Tick rate of the sessions in a slot [Hz]. Slots beyond those of the constructor are shared out among the rates.
  [[nodiscard]] double rate_of_slot(std::size_t slot) const noexcept { return rates_[steering_.socket_of[slot]]; }
  [[nodiscard]] const std::vector<double>& rates() const noexcept { return rates_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Shard>>& all() const noexcept { return shards_; }

  void run();
  /// Ends all sessions; they release their hands first. @param why reason in the clients' CLOSE
  void stop(wire::CloseReason why = wire::CloseReason::kServerStops) noexcept;
  void join();
  /// Ticks so far that began within 1 ms of their time, of the shard with the fewest.
  [[nodiscard]] std::uint64_t punctual() const noexcept;

 private:
  std::vector<double> rates_;  ///< one per shard
  io::Steering steering_;
  std::vector<std::unique_ptr<Shard>> shards_;
  std::vector<std::thread> threads_;
};

}  // namespace tandem::server
