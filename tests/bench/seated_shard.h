#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "netsim/system/simulated_handshake.h"
#include "server/app/process/local_slaves.h"
#include "server/app/process/shard.h"
#include "tests/bench/bench_clients.h"

namespace tandem::bench {

/// A shard with sessions of one scene, and bare clients that joined all their seats. It starts no thread.
class SeatedShard {
 public:
  /// @param recorded  as of a server that writes a report or trace
  SeatedShard(const SceneSpec& scene, std::size_t sessions, bool recorded)
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
  }

  [[nodiscard]] server::Shard& shard() { return *shard_; }
  [[nodiscard]] server::LiveSession& session(std::size_t s) { return *hosted_[s]; }
  [[nodiscard]] server::TickQueue& records(std::size_t s) { return *queues_[s]; }
  [[nodiscard]] std::vector<std::unique_ptr<BareClient>>& clients() { return clients_; }
  [[nodiscard]] const std::vector<std::unique_ptr<BareClient>>& clients() const { return clients_; }
  [[nodiscard]] const io::SocketAddress& address() const { return address_; }

 private:
  io::UdpSocket socket_;
  io::SocketAddress address_;
  std::unique_ptr<server::Shard> shard_;
  std::vector<std::unique_ptr<server::TickQueue>> queues_;
  std::vector<std::unique_ptr<server::LiveSession>> hosted_;
  std::vector<std::unique_ptr<BareClient>> clients_;
};

}  // namespace tandem::bench
