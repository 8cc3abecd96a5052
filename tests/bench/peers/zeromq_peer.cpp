// ZeroMQ: DEALER sockets at the clients, a ROUTER at the server, over TCP; sealed by CURVE.
#include <sys/epoll.h>
#include <zmq.h>

#include <array>
#include <string>

#include "common/io/clock.h"
#include "common/io/fd.h"
#include "tests/bench/peers/peer.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

/// Keys as Z85 text.
struct KeyPair {
  std::array<char, 41> open{}, secret{};
  KeyPair() {
    if (zmq_curve_keypair(open.data(), secret.data()) != 0) throw std::runtime_error("this libzmq has no CURVE");
  }
};

class ZeromqClients final : public PeerClients {
 public:
  ZeromqClients(const Exchange& exchange, std::uint16_t port, const char* server_key)
      : times_(exchange), message_(exchange.up), context_(zmq_ctx_new()) {
    const std::string address = "tcp://127.0.0.1:" + std::to_string(port);
    for (std::size_t c = 0; c < exchange.clients; ++c) {
      void* const socket = zmq_socket(context_, ZMQ_DEALER);
      if (exchange.sealed) {
        const KeyPair own;
        zmq_setsockopt(socket, ZMQ_CURVE_SERVERKEY, server_key, 41);
        zmq_setsockopt(socket, ZMQ_CURVE_PUBLICKEY, own.open.data(), 41);
        zmq_setsockopt(socket, ZMQ_CURVE_SECRETKEY, own.secret.data(), 41);
      }
      if (zmq_connect(socket, address.c_str()) != 0) throw std::runtime_error("not all clients got through");
      int descriptor = -1;
      std::size_t size = sizeof descriptor;
      zmq_getsockopt(socket, ZMQ_FD, &descriptor, &size);
      epoll_event event{.events = EPOLLIN | EPOLLET, .data = {.u64 = c}};
      epoll_ctl(poll_.get(), EPOLL_CTL_ADD, descriptor, &event);
      sockets_.push_back(socket);
    }
  }
  void send(std::size_t client) override {
    times_.stamp(client, message_);
    zmq_send(sockets_[client], message_.data(), message_.size(), ZMQ_DONTWAIT);
  }
  void receive(Time until, const Heard& heard) override {
    // zmq_poll waits for whole milliseconds only. The descriptor of a socket tells of changes, so each round looks at
    // all sockets first.
    for (Duration left; (left = until - io::monotonic_now()) > Duration{};) {
      bool any = false;
      for (void* const socket : sockets_)
        for (int size; (size = zmq_recv(socket, answer_.data(), answer_.size(), ZMQ_DONTWAIT)) > 0; any = true)
          times_.hear(std::span{answer_}.first(std::min(static_cast<std::size_t>(size), answer_.size())), heard);
      if (any) continue;
      const timespec timeout = io::to_timespec(left);
      epoll_pwait2(poll_.get(), ready_.data(), static_cast<int>(ready_.size()), &timeout, nullptr);
    }
  }

 private:
  SendTimes times_;
  std::vector<std::byte> message_;
  void* context_;
  std::vector<void*> sockets_;
  io::Fd poll_{epoll_create1(EPOLL_CLOEXEC)};
  std::vector<epoll_event> ready_{64};
  std::array<std::byte, 1500> answer_;
};

class ZeromqPeer final : public Peer {
 public:
  explicit ZeromqPeer(const Exchange& exchange) : exchange_(exchange) {}
  void serve(const std::function<void(std::uint16_t)>& ready) override {
    void* const socket = zmq_socket(zmq_ctx_new(), ZMQ_ROUTER);
    const int yes = 1;
    if (exchange_.sealed) {
      zmq_setsockopt(socket, ZMQ_CURVE_SERVER, &yes, sizeof yes);
      zmq_setsockopt(socket, ZMQ_CURVE_SECRETKEY, keys_.secret.data(), 41);
    }
    std::array<char, 256> at{};
    std::size_t length = at.size();
    if (zmq_bind(socket, "tcp://127.0.0.1:*") != 0 ||
        zmq_getsockopt(socket, ZMQ_LAST_ENDPOINT, at.data(), &length) != 0)
      throw std::runtime_error("ZeroMQ cannot listen");
    const std::string address = at.data();
    ready(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
    std::vector<std::byte> answer(exchange_.down);
    std::array<std::byte, 256> client;
    std::array<std::byte, 1500> asked;
    for (;;) {
      const int name = zmq_recv(socket, client.data(), client.size(), 0);
      const int size = zmq_recv(socket, asked.data(), asked.size(), 0);
      if (name <= 0 || size < static_cast<int>(sizeof(Mark))) continue;
      std::memcpy(answer.data(), asked.data(), sizeof(Mark));
      zmq_send(socket, client.data(), static_cast<std::size_t>(name), ZMQ_SNDMORE);
      zmq_send(socket, answer.data(), answer.size(), 0);
    }
  }
  std::unique_ptr<PeerClients> connect(std::uint16_t port) override {
    return std::make_unique<ZeromqClients>(exchange_, port, keys_.open.data());
  }

 private:
  Exchange exchange_;
  KeyPair keys_;
};

}  // namespace

std::unique_ptr<Peer> make_peer(const Exchange& exchange) { return std::make_unique<ZeromqPeer>(exchange); }

}  // namespace tandem::bench
