#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <thread>
#include <vector>

#include "common/io/clock.h"
#include "tests/bench/crowd.h"
#include "tests/bench/seated_shard.h"

namespace tandem::bench {

/// A shard on a thread of its own, and bare clients at all seats of its sessions, which the calling thread drives.
class HostedShard {
 public:
  /// @param recorded  as of a server that writes a report or trace
  HostedShard(const SceneSpec& scene, std::size_t sessions, bool recorded)
      : seated_(scene, sessions, recorded),
        sent_(seated_.clients().size(), false),
        crowd_(seated_.clients().size(), seated_.address()) {
    thread_ = std::thread([this] { shard().run(); });
  }
  ~HostedShard() {
    shard().stop();
    thread_.join();
  }
  HostedShard(const HostedShard&) = delete;
  HostedShard& operator=(const HostedShard&) = delete;

  struct Spent {
    Duration cpu{};           ///< of the shard's thread, in user space and in the kernel
    double client_ticks = 0;  ///< FORCE datagrams that arrived
    [[nodiscard]] double ns_per_client_tick() const { return static_cast<double>(cpu.count()) / client_ticks; }
  };
  /// Lets all clients send for `length`, once per tick.
  Spent run(Duration length) {
    const Duration cpu = cpu_of(thread_.native_handle());
    const std::uint64_t before = forces();
    crowd_.run(
        length,
        [this](std::size_t c, std::span<std::byte> buffer) -> std::size_t {
          const bool answers = seated_.clients()[c]->answers();
          if (!answers) sent_[c] = !sent_[c];
          return answers || sent_[c] ? seated_.clients()[c]->send(io::monotonic_now(), ++tick_, buffer) : 0;
        },
        [this](std::size_t c, std::span<const std::byte> bytes) {
          seated_.clients()[c]->hear(io::monotonic_now(), bytes);
        },
        shard().period());
    return {cpu_of(thread_.native_handle()) - cpu, static_cast<double>(forces() - before)};
  }
  /// Lets the shard tick without datagrams. @return processor time of its thread so far
  Duration run_without_clients(Duration length) {
    UdpLoad::pause_until((io::monotonic_now() + length).time_since_epoch());
    return cpu_of(thread_.native_handle());
  }
  /// All hands are engaged.
  [[nodiscard]] bool settled() const {
    return std::ranges::all_of(seated_.clients(), [](const auto& c) { return c->settled(); });
  }
  [[nodiscard]] server::Shard& shard() { return seated_.shard(); }
  [[nodiscard]] server::LiveSession& session(std::size_t s) { return seated_.session(s); }
  [[nodiscard]] server::TickQueue& records(std::size_t s) { return seated_.records(s); }
  [[nodiscard]] const io::SocketAddress& address() const { return seated_.address(); }

 private:
  [[nodiscard]] std::uint64_t forces() const {
    std::uint64_t sum = 0;
    for (const auto& c : seated_.clients()) sum += c->forces();
    return sum;
  }

  SeatedShard seated_;
  std::vector<bool> sent_;
  std::uint32_t tick_ = 0;
  Crowd crowd_;
  std::thread thread_;
};

}  // namespace tandem::bench
