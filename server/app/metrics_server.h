#pragma once

#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <string_view>

#include "common/io/socket_address.h"

namespace tandem::server {

/// An answer to a GET.
struct Page {
  int status = 200;  ///< 200, 404 or 503
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

/// The smallest HTTP/1.1: GET and HEAD of a path, one request per connection, no body, at most 16 connections and 5 s each. For those who
/// look on (Prometheus, a load balancer); nobody can change anything here. On its owner's thread.
class MetricsServer {
 public:
  using Pages = std::function<Page(std::string_view path)>;
  MetricsServer(asio::io_context& context, Pages pages);
  /// @param at  port 0: one that is free  @return what is wrong
  [[nodiscard]] std::string listen(const io::SocketAddress& at);
  [[nodiscard]] const io::SocketAddress& address() const noexcept { return address_; }
  void stop();

 private:
  class Visit;
  void accept_next();

  asio::io_context& context_;
  Pages pages_;
  asio::ip::tcp::acceptor acceptor_;
  io::SocketAddress address_;
  asio::steady_timer rest_;  ///< after an error of accepting that is ours, such as no file descriptors left
  std::list<std::weak_ptr<Visit>> visits_;
};

}  // namespace tandem::server
