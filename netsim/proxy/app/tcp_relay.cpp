#include "netsim/proxy/app/tcp_relay.h"

#include <array>
#include <asio.hpp>
#include <chrono>
#include <cstring>
#include <thread>

namespace tandem::netsim {
namespace {

using asio::ip::tcp;

tcp::endpoint endpoint_of(const io::SocketAddress& a) {
  tcp::endpoint e;
  e.resize(a.size);
  std::memcpy(e.data(), a.get(), a.size);
  return e;
}

/// One client's connection and the corresponding connection to the server. It exists while either direction is open.
class RelayedConnection : public std::enable_shared_from_this<RelayedConnection> {
 public:
  RelayedConnection(tcp::socket client, std::size_t& count)
      : client_(std::move(client)), server_(client_.get_executor()), count_(count) {
    ++count_;
  }
  ~RelayedConnection() { --count_; }

  void start(const tcp::endpoint& to) {
    server_.async_connect(to, [self = shared_from_this()](std::error_code error) {
      if (error) return;  // both sockets close: the client sees the same as at the server
      self->pass(self->client_, self->server_, self->up_);
      self->pass(self->server_, self->client_, self->down_);
    });
  }

 private:
  using Bytes = std::array<char, 16384>;
  void pass(tcp::socket& from, tcp::socket& to, Bytes& bytes) {
    from.async_read_some(asio::buffer(bytes), [this, self = shared_from_this(), &from, &to, &bytes](
                                                  std::error_code error, std::size_t size) {
      if (error) return hang_up(to);
      asio::async_write(to, asio::buffer(bytes, size),
                        [this, self, &from, &to, &bytes](std::error_code failed, std::size_t) {
                          if (failed) return hang_up(from);
                          pass(from, to, bytes);
                        });
    });
  }
  /// Ends one direction; the other one continues.
  static void hang_up(tcp::socket& to) {
    std::error_code ignored;
    to.shutdown(tcp::socket::shutdown_send, ignored);
  }

  tcp::socket client_, server_;
  std::size_t& count_;
  Bytes up_{}, down_{};
};

constexpr std::chrono::milliseconds kPause{100};

}  // namespace

struct TcpRelay::Work {
  Work(io::TcpListener listener, const io::SocketAddress& server, std::size_t connections_max)
      : most(connections_max),
        acceptor(context, listener.local.family() == AF_INET6 ? tcp::v6() : tcp::v4(), listener.fd.release()),
        to(endpoint_of(server)) {}

  void accept() {
    if (count >= most) return accept_later();
    acceptor.async_accept([this](std::error_code error, tcp::socket client) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();
      std::make_shared<RelayedConnection>(std::move(client), count)->start(to);
      accept();
    });
  }
  /// Waits, because without a free place or file descriptor the next attempt would fail at once, too.
  void accept_later() {
    pause.expires_after(kPause);
    pause.async_wait([this](std::error_code error) {
      if (!error) accept();
    });
  }

  std::size_t most;
  std::size_t count = 0;  // outlives the connections that it counts
  asio::io_context context{1};
  asio::steady_timer pause{context};
  tcp::acceptor acceptor;
  tcp::endpoint to;
  std::thread thread;
};

TcpRelay::TcpRelay(io::TcpListener listener, const io::SocketAddress& to, std::size_t connections_max)
    : work_(std::make_unique<Work>(std::move(listener), to, connections_max)) {
  work_->accept();
  work_->thread = std::thread([work = work_.get()] { work->context.run(); });
}

TcpRelay::~TcpRelay() {
  work_->context.stop();
  work_->thread.join();
}

}  // namespace tandem::netsim
