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

/// An answer to a GET.
struct Page {
  int status = 200;  ///< 200, 400, 404, 405, 421 or 503
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

/// Whether a request with this Host header may be answered: an IP address, `localhost`, or one of `names`, each with or without a port.
/// Any other name is one that its owner let point here, so that pages of that owner can read what a person's browser may read.
[[nodiscard]] bool host_is_ours(std::string_view host, const std::vector<std::string>& names);

/// The smallest HTTP/1.1: GET and HEAD of a path, one request per connection, no body, at most 16 connections. From accept to the last byte
/// of the answer a connection has a deadline; when all places are taken, the oldest connection ends for a new one, so that readers who do
/// not read keep nobody out. For those who look on (Prometheus, a load balancer); nobody can change anything here. On its owner's thread.
class MetricsServer {
 public:
  using Pages = std::function<Page(std::string_view path)>;
  static constexpr std::size_t kConnectionsMax = 16;
  static constexpr std::chrono::milliseconds kDeadline{5000};

  /// @param names  under which it is asked for, beside IP addresses, `localhost` and this computer's own name
  MetricsServer(asio::io_context& context, Pages pages, std::vector<std::string> names = {}, std::chrono::milliseconds deadline = kDeadline);
  /// @param at  port 0: one that is free  @return what is wrong
  [[nodiscard]] std::string listen(const io::SocketAddress& at);
  [[nodiscard]] const io::SocketAddress& address() const noexcept { return address_; }
  void stop();

 private:
  class Visit;
  void accept_next();

  asio::io_context& context_;
  Pages pages_;
  std::vector<std::string> names_;
  std::chrono::milliseconds deadline_;
  asio::ip::tcp::acceptor acceptor_;
  io::SocketAddress address_;
  asio::steady_timer rest_;  ///< after an error of accepting that is ours, such as no file descriptors left
  std::list<std::weak_ptr<Visit>> visits_;  ///< the oldest first
};

}  // namespace tandem::server
