#pragma once

#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/socket_address.h"

namespace tandem::server {

/// Response to a GET request.
struct HttpResponse {
  int status = 200;  ///< 200, 400, 404, 405, 421 or 503
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

/// Whether a request with this Host header may be answered: an IP address, `localhost`, or one of `names`, each with
/// or without a port. Other names are rejected against DNS rebinding: their owner could let them point here, and a
/// page of that owner could read the metrics by a user's browser.
[[nodiscard]] bool host_is_ours(std::string_view host, const std::vector<std::string>& names);

/// A minimal HTTP/1.1 server for monitoring (Prometheus, a load balancer). It supports GET and HEAD of a path, without
/// a body, one request per connection. A connection has a deadline from accept to the last byte of the response. At
/// most 16 connections are open; a new one then closes the oldest, so that stalled readers block no others. No request
/// changes anything. All members run on the owner's thread.
class MetricsServer {
 public:
  using RequestHandler = std::function<HttpResponse(std::string_view path)>;
  static constexpr std::size_t kConnectionsMax = 16;
  static constexpr std::chrono::milliseconds kDeadline{5000};

  /// @param names  accepted Host names, in addition to IP addresses, `localhost` and this computer's name
  MetricsServer(asio::io_context& context, RequestHandler pages, std::vector<std::string> names = {},
                std::chrono::milliseconds deadline = kDeadline);
  /// @param at  port 0: any free port @return the error; empty if there is none
  [[nodiscard]] std::string listen(const io::SocketAddress& at);
  [[nodiscard]] const io::SocketAddress& address() const noexcept { return address_; }
  void stop();

 private:
  class Connection;
  void accept_next();

  asio::io_context& context_;
  RequestHandler handler_;
  std::vector<std::string> names_;
  std::chrono::milliseconds deadline_;
  asio::ip::tcp::acceptor acceptor_;
  io::SocketAddress address_;
  /// After a failed accept that the server itself causes, such as a lack of file descriptors.
  asio::steady_timer accept_pause_;
  std::list<std::weak_ptr<Connection>> connections_;  ///< oldest first
};

}  // namespace tandem::server
