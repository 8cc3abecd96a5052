// ENet: unreliable packets in sequence, each client a peer of one host.
#include <enet/enet.h>
#include <poll.h>

#include "common/io/clock.h"
#include "tests/bench/peers/peer.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

std::span<const std::byte> bytes_of(const ENetPacket& packet) {
  return {reinterpret_cast<const std::byte*>(packet.data), packet.dataLength};
}

class EnetClients final : public PeerClients {
 public:
  EnetClients(const Exchange& exchange, std::uint16_t port)
      : times_(exchange), message_(exchange.up), host_(enet_host_create(nullptr, exchange.clients, 1, 0, 0)) {
    if (host_ == nullptr) throw std::runtime_error("ENet gives no host");
    ENetAddress server{};
    enet_address_set_host_ip(&server, "127.0.0.1");
    server.port = port;
    for (std::size_t c = 0; c < exchange.clients; ++c) peers_.push_back(enet_host_connect(host_, &server, 1, 0));
    std::size_t connected = 0;
    ENetEvent event;
    for (const Time until = io::monotonic_now() + 10s; connected < exchange.clients && io::monotonic_now() < until;)
      if (enet_host_service(host_, &event, 100) > 0 && event.type == ENET_EVENT_TYPE_CONNECT) ++connected;
    if (connected < exchange.clients) throw std::runtime_error("not all clients got through");
  }
  void send(std::size_t client) override {
    times_.stamp(client, message_);
    enet_peer_send(peers_[client], 0, enet_packet_create(message_.data(), message_.size(), 0));
  }
  void flush() override { enet_host_flush(host_); }
  void receive(Time until, const Heard& heard) override {
    // ENet itself waits for whole milliseconds only.
    for (Duration left; (left = until - io::monotonic_now()) > Duration{};) {
      pollfd wait{host_->socket, POLLIN, 0};
      const timespec timeout = io::to_timespec(left);
      ppoll(&wait, 1, &timeout, nullptr);
      for (ENetEvent event; enet_host_service(host_, &event, 0) > 0;) {
        if (event.type != ENET_EVENT_TYPE_RECEIVE) continue;
        times_.hear(bytes_of(*event.packet), heard);
        enet_packet_destroy(event.packet);
      }
    }
  }

 private:
  SendTimes times_;
  std::vector<std::byte> message_;
  ENetHost* host_;
  std::vector<ENetPeer*> peers_;
};

class EnetServer final : public Peer {
 public:
  explicit EnetServer(const Exchange& exchange) : exchange_(exchange) {}
  void serve(const std::function<void(std::uint16_t)>& ready) override {
    ENetAddress at{};
    enet_address_set_host_ip(&at, "127.0.0.1");
    ENetHost* const host = enet_host_create(&at, exchange_.clients, 1, 0, 0);
    if (host == nullptr || enet_socket_get_address(host->socket, &at) != 0)
      throw std::runtime_error("ENet gives no host");
    ready(at.port);
    std::vector<std::byte> answer(exchange_.down);
    for (ENetEvent event;;) {
      if (enet_host_service(host, &event, 1000) <= 0) continue;
      do {
        if (event.type != ENET_EVENT_TYPE_RECEIVE) continue;
        const auto asked = bytes_of(*event.packet);
        std::memcpy(answer.data(), asked.data(), std::min(asked.size(), sizeof(Mark)));
        enet_packet_destroy(event.packet);
        enet_peer_send(event.peer, 0, enet_packet_create(answer.data(), answer.size(), 0));
      } while (enet_host_check_events(host, &event) > 0);
      enet_host_flush(host);
    }
  }
  std::unique_ptr<PeerClients> connect(std::uint16_t port) override {
    return std::make_unique<EnetClients>(exchange_, port);
  }

 private:
  Exchange exchange_;
};

}  // namespace

std::unique_ptr<Peer> make_peer(const Exchange& exchange) {
  if (exchange.sealed) return nullptr;
  if (enet_initialize() != 0) throw std::runtime_error("ENet cannot start");
  return std::make_unique<EnetServer>(exchange);
}

}  // namespace tandem::bench
