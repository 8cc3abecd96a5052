#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/io/datagram_steering.h"
#include "server/app/process/server_process.h"
#include "server/app/process/shard.h"
#include "server/policy/shard_plan.h"

namespace tandem::server {

/// The tick threads: shards of each tick rate, each with its own socket on the shared port. The kernel distributes
/// datagrams by the session's slot, which is a byte of every connection id. Only one thread changes the assignment.
class ShardPool {
 public:
  /// Plans the shards for the sessions of the options, which take the first slots in their order.
  explicit ShardPool(const ServerOptions& options);
  ~ShardPool() { join(); }

  /// Assignment of slots to sockets.
  [[nodiscard]] const io::Steering& steering() const noexcept { return steering_; }
  /// @param sockets  one per shard, as `steering` requires
  void take_sockets(std::vector<io::UdpSocket> sockets);
  [[nodiscard]] std::size_t shard_of_slot(std::size_t slot) const noexcept { return steering_.socket_of[slot]; }
  [[nodiscard]] Shard& of_slot(std::size_t slot) noexcept { return *shards_[shard_of_slot(slot)]; }
  /// Adds a shard for sessions of another tick rate [Hz], and runs it if the others run.
  /// @return its number; or the error: this server is no member of a service, has the most shards, or the system gives
  /// no socket
  [[nodiscard]] std::expected<std::size_t, std::string> add(double tick_hz);
  /// Tick rate of each shard [Hz].
  [[nodiscard]] const std::vector<double>& rates() const noexcept { return rates_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Shard>>& all() const noexcept { return shards_; }

  /// The assignment with one slot at another shard.
  [[nodiscard]] io::Steering steering_with(std::size_t slot, std::size_t shard) const noexcept;
  /// Records that the kernel distributes by this assignment now.
  void set_steering(const io::Steering& steering) noexcept { steering_ = steering; }
  /// Assigns a slot without a session to a shard, from now on. @return false if the kernel rejects it
  [[nodiscard]] bool assign(std::size_t slot, std::size_t shard);

  void run();
  /// Ends all sessions; they release their hands first. @param why reason in the clients' CLOSE
  void stop(wire::CloseReason why = wire::CloseReason::kServerStops) noexcept;
  void join();
  /// Ticks so far of each shard that began within 1 ms of their time; nullopt: it has ended. Any
  /// thread.
  [[nodiscard]] std::vector<std::optional<std::uint64_t>> punctual() const;

 private:
  std::vector<double> rates_;  ///< one per shard
  io::Steering steering_;
  io::UdpSocket socket_;       ///< one of the sockets, for `assign` and `add`
  mutable std::mutex adding_;  ///< `punctual` on another thread reads the list while `add` changes it
  std::vector<std::unique_ptr<Shard>> shards_;
  std::vector<std::thread> threads_;
  bool running_ = false;
};

}  // namespace tandem::server
