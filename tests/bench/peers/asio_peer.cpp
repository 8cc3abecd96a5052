// asio: one asynchronous receive and one asynchronous send per datagram.
#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>

#include "tests/bench/peers/udp_peer.h"

namespace tandem::bench {
namespace {

using asio::ip::udp;

class AsioEcho {
 public:
  explicit AsioEcho(const Exchange& exchange)
      : socket_(context_, udp::endpoint(asio::ip::address_v4::loopback(), 0)), out_(exchange.down) {
    socket_.set_option(asio::socket_base::receive_buffer_size(4 << 20));
  }
  [[nodiscard]] std::uint16_t port() const { return socket_.local_endpoint().port(); }
  void run() {
    receive();
    context_.run();
  }

 private:
  void receive() {
    socket_.async_receive_from(asio::buffer(in_), from_, [this](const asio::error_code& failed, std::size_t size) {
      if (failed || size < sizeof(Mark)) return receive();
      std::memcpy(out_.data(), in_.data(), sizeof(Mark));
      socket_.async_send_to(asio::buffer(out_), from_, [this](const asio::error_code&, std::size_t) { receive(); });
    });
  }

  asio::io_context context_{1};
  udp::socket socket_;
  udp::endpoint from_;
  std::array<std::byte, 1500> in_;
  std::vector<std::byte> out_;
};

class AsioPeer final : public Peer {
 public:
  explicit AsioPeer(const Exchange& exchange) : exchange_(exchange) {}
  void serve(const std::function<void(std::uint16_t)>& ready) override {
    AsioEcho echo(exchange_);
    ready(echo.port());
    echo.run();
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
  return std::make_unique<AsioPeer>(exchange);
}

}  // namespace tandem::bench
