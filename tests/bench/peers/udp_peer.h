#pragma once

#include <vector>

#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/udp_clients.h"

namespace tandem::bench {

/// Clients of servers that answer a datagram with a datagram.
class MarkedUdpClients final : public PeerClients {
 public:
  MarkedUdpClients(const Exchange& exchange, std::uint16_t port)
      : clients_(exchange.clients, port), times_(exchange), message_(exchange.up) {}
  void send(std::size_t client) override {
    times_.stamp(client, message_);
    clients_.send(client, message_);
  }
  void receive(Time until, const Heard& heard) override {
    clients_.receive(until, [&](std::size_t, std::span<const std::byte> bytes) { times_.hear(bytes, heard); });
  }

 private:
  UdpClients clients_;
  SendTimes times_;
  std::vector<std::byte> message_;
};

}  // namespace tandem::bench
