// Tandem: a shard with sessions of the shipped scene `contact_remote`, three seats each. Unlike the other packages it
// does more than to answer: each tick couples hands and tool, keeps the accounts of energy, and checks every message.
#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/udp_clients.h"
#include "tests/bench/seated_shard.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

class TandemClients final : public PeerClients {
 public:
  TandemClients(std::vector<std::unique_ptr<BareClient>>& clients, std::uint16_t port)
      : clients_(clients), sockets_(clients.size(), port) {}
  void send(std::size_t client) override {
    do {  // the answer to a challenge of its address goes before the message
      const bool answers = clients_[client]->answers();
      const std::size_t size = clients_[client]->send(io::monotonic_now(), ++tick_, buffer_);
      sockets_.send(client, std::span{buffer_}.first(size));
      if (!answers) return;
    } while (true);
  }
  void receive(Time until, const Heard& heard) override {
    sockets_.receive(until, [&](std::size_t c, std::span<const std::byte> bytes) {
      BareClient& client = *clients_[c];
      const std::uint64_t before = client.forces();
      const Time now = io::monotonic_now();
      client.hear(now, bytes);
      if (client.forces() > before) heard(client.link().timing().loop_age(now), client.link().timing().peer_silence());
    });
  }

 private:
  std::vector<std::unique_ptr<BareClient>>& clients_;
  UdpClients sockets_;
  std::uint32_t tick_ = 0;
  std::array<std::byte, transport::kDatagramMax> buffer_;
};

class TandemPeer final : public Peer {
 public:
  explicit TandemPeer(const Exchange& exchange)
      : scene_(test::shipped("contact_remote")), shard_(scene_, exchange.clients / scene_.seats.size(), false) {
    if (exchange.clients % scene_.seats.size() != 0) throw std::runtime_error("clients of whole sessions only");
  }
  void serve(const std::function<void(std::uint16_t)>& ready) override {
    ready(shard_.address().port());
    shard_.shard().run();
  }
  std::unique_ptr<PeerClients> connect(std::uint16_t port) override {
    return std::make_unique<TandemClients>(shard_.clients(), port);
  }

 private:
  SceneSpec scene_;
  SeatedShard shard_;
};

}  // namespace

std::unique_ptr<Peer> make_peer(const Exchange& exchange) {
  if (!exchange.sealed) return nullptr;  // Tandem seals every datagram
  return std::make_unique<TandemPeer>(exchange);
}

}  // namespace tandem::bench
