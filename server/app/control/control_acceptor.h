#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>
#include <expected>
#include <functional>
#include <list>
#include <string>

#include "common/auth/limiter.h"
#include "common/io/socket_address.h"

namespace tandem::server {

/// Accepts TCP connections on one or more addresses, at a limited rate: accepting and closing a connection alone costs
/// about 20 us. After a failure that the server itself causes, such as a lack of file descriptors, it pauses. All
/// members run on the thread of `context`.
class ControlAcceptor {
 public:
  struct Handlers {
    std::function<void(asio::ip::tcp::socket)> accepted;
    std::function<void(const asio::error_code&)> failed;
  };
  /// @param clock  monotonic
  ControlAcceptor(asio::io_context& context, std::function<Time()> clock, Handlers handlers);

  /// Listens on an address. It may be called several times. @return the address with the chosen port, or the error
  [[nodiscard]] std::expected<io::SocketAddress, std::string> listen(const io::SocketAddress& at);
  /// Stops accepting.
  void stop();

 private:
  struct Listener {
    asio::ip::tcp::acceptor acceptor;
    asio::steady_timer timer;
    bool busy = false;  ///< accepting, or pausing
  };
  void accept_next(Listener& listener);
  void pause(Listener& listener, Duration time);

  asio::io_context& context_;
  std::function<Time()> clock_;
  Handlers handlers_;
  TokenBucket rate_;
  std::list<Listener> listeners_;
  bool stopped_ = false;
};

}  // namespace tandem::server
