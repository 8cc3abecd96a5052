#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "netsim/system/simulated_handshake.h"
#include "server/app/process/local_slaves.h"
#include "server/app/process/shard.h"
#include "tests/bench/bench_clients.h"
#include "tests/bench/crowd.h"

namespace tandem::bench {

/// A shard on a thread of its own, and bare clients at all seats of its sessions, which the calling thread drives.
class HostedShard {
 public:
  /// @param recorded  as of a server that writes a report or trace
  HostedShard(const SceneSpec& scene, std::size_t sessions, bool recorded)
      : socket_(std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0)))),
        address_(socket_.local),
        shard_(std::make_unique<server::Shard>(std::move(socket_), scene.tick_hz)) {
    for (std::size_t s = 0; s < sessions; ++s) {
      queues_.push_back(std::make_unique<server::TickQueue>(
          64));  // full soon: the shard drops and counts further rows, as with a late recorder
      hosted_.push_back(std::make_unique<server::LiveSession>(scene, *server::make_local_slaves(scene, Time{}),
                                                              static_cast<std::uint8_t>(s), *queues_.back()));
      hosted_.back()->set_recorded(recorded);
      for (std::size_t i = 0; i < scene.seats.size(); ++i)
        clients_.push_back(std::make_unique<BareClient>(
            *netsim::simulate_join(hosted_.back()->session(), io::monotonic_now(), i, caps_of(scene, i), RandomKey{s},
                                   i, false, static_cast<std::uint8_t>(s))));
      if (!shard_->add_session(*hosted_.back())) throw std::logic_error("the slot is in use");
    }
    sent_.resize(clients_.size(), false);
    crowd_ = std::make_unique<Crowd>(clients_.size(), address_);
    thread_ = std::thread([this] { shard_->run(); });
  }
  ~HostedShard() {
    shard_->stop();
    thread_.join();
  }
  HostedShard(const HostedShard&) = delete;
  HostedShard& operator=(const HostedShard&) = delete;

  struct Spent {
    Duration cpu{};           ///< of the shard's thread, in user space and in the kernel
    double client_ticks = 0;  ///< FORCE datagrams that arrived
    [[nodiscard]] double ns_per_client_tick() const { return static_cast<double>(cpu.count()) / client_ticks; }
  };
  /// Lets all clients send for `length`.
  Spent run(Duration length) {
    const Duration cpu = cpu_of(thread_.native_handle());
    const std::uint64_t before = forces();
    crowd_->run(
        length,
        [this](std::size_t c, std::span<std::byte> buffer) -> std::size_t {
          const bool answers = clients_[c]->answers();
          if (!answers) sent_[c] = !sent_[c];
          return answers || sent_[c] ? clients_[c]->send(io::monotonic_now(), ++tick_, buffer) : 0;
        },
        [this](std::size_t c, std::span<const std::byte> bytes) { clients_[c]->hear(io::monotonic_now(), bytes); });
    return {cpu_of(thread_.native_handle()) - cpu, static_cast<double>(forces() - before)};
  }
  /// All hands are engaged.
  [[nodiscard]] bool settled() const {
    return std::ranges::all_of(clients_, [](const auto& c) { return c->settled(); });
  }
  [[nodiscard]] server::Shard& shard() { return *shard_; }
  [[nodiscard]] server::LiveSession& session(std::size_t s) { return *hosted_[s]; }
  [[nodiscard]] const io::SocketAddress& address() const { return address_; }

 private:
  [[nodiscard]] std::uint64_t forces() const {
    std::uint64_t sum = 0;
    for (const auto& c : clients_) sum += c->forces();
    return sum;
  }

  io::UdpSocket socket_;
  io::SocketAddress address_;
  std::unique_ptr<server::Shard> shard_;
  std::vector<std::unique_ptr<server::TickQueue>> queues_;
  std::vector<std::unique_ptr<server::LiveSession>> hosted_;
  std::vector<std::unique_ptr<BareClient>> clients_;
  std::vector<bool> sent_;
  std::uint32_t tick_ = 0;
  std::unique_ptr<Crowd> crowd_;
  std::thread thread_;
};

}  // namespace tandem::bench
