// The reference: a server that answers datagrams in batches, as they come (recvmmsg, sendmmsg).
#include <poll.h>

#include "common/io/datagram_batch.h"
#include "tests/bench/peers/udp_peer.h"

namespace tandem::bench {
namespace {

class EchoPeer final : public Peer {
 public:
  explicit EchoPeer(const Exchange& exchange) : exchange_(exchange) {}

  void serve(const std::function<void(std::uint16_t)>& ready) override {
    auto socket = io::bind_udp(*io::parse_address("127.0.0.1:0", 0));
    if (!socket) throw std::runtime_error(socket.error());
    io::ReceiveBatch::prepare(socket->fd.get(), AF_INET, false);
    ready(socket->local.port());
    io::ReceiveBatch in;
    io::SendBatch out;
    std::vector<io::SocketAddress> to(io::ReceiveBatch::kMax);
    std::vector<std::vector<std::byte>> answers(io::ReceiveBatch::kMax, std::vector<std::byte>(exchange_.down));
    for (;;) {
      pollfd wait{socket->fd.get(), POLLIN, 0};
      poll(&wait, 1, -1);
      for (int count = 0; (count = in.receive(socket->fd.get())) > 0;) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
          to[i].size = sizeof(sockaddr_in);
          std::memcpy(&to[i].storage, &in.from(i), to[i].size);
          std::memcpy(answers[i].data(), in.bytes(i).data(), std::min(in.bytes(i).size(), sizeof(Mark)));
          out.add(answers[i], &to[i], nullptr);
        }
        out.send(socket->fd.get());
      }
    }
  }
  std::unique_ptr<PeerClients> connect(std::uint16_t port) override {
    return std::make_unique<MarkedUdpClients>(exchange_, port);
  }

 private:
  Exchange exchange_;
};

}  // namespace

std::unique_ptr<Peer> make_peer(const Exchange& exchange) {
  if (exchange.sealed) return nullptr;
  return std::make_unique<EchoPeer>(exchange);
}

}  // namespace tandem::bench
