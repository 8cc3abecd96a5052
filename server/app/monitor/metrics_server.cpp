#include "server/app/monitor/metrics_server.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <asio/buffer.hpp>
#include <asio/read_until.hpp>
#include <asio/steady_timer.hpp>
#include <asio/write.hpp>
#include <cstddef>

#include "server/app/control/tcp_listener.h"

namespace tandem::server {
namespace {

using asio::ip::tcp;

constexpr std::size_t kRequestMax = 4096;  // [bytes]
constexpr auto kRest = std::chrono::milliseconds(100);

const char* reason_of(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 400:
      return "Bad Request";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 421:
      return "Misdirected Request";
    default:
      return "Service Unavailable";
  }
}

bool same_word(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// All values of a header.
std::vector<std::string_view> values_of(std::string_view request, std::string_view header) {
  std::vector<std::string_view> values;
  for (std::size_t at = request.find("\r\n"); at != std::string_view::npos && at + 2 < request.size();) {
    const std::size_t end = request.find("\r\n", at + 2);
    const std::string_view line = request.substr(at + 2, end == std::string_view::npos ? end : end - at - 2);
    if (const auto colon = line.find(':'); colon != std::string_view::npos && same_word(line.substr(0, colon), header))
      values.push_back(trimmed(line.substr(colon + 1)));
    at = end;
  }
  return values;
}

std::string own_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

bool host_is_ours(std::string_view host, const std::vector<std::string>& names) {
  const bool bracketed = host.starts_with('[');
  const std::size_t end = bracketed ? host.find(']') : host.rfind(':');
  if (bracketed && end == std::string_view::npos) return false;
  const std::string_view port = end == std::string_view::npos ? "" : host.substr(bracketed ? end + 1 : end);
  if (!port.empty() && (port.front() != ':' || port.find_first_not_of("0123456789", 1) != std::string_view::npos))
    return false;
  const std::string name(bracketed ? host.substr(1, end - 1) : host.substr(0, end));
  std::array<std::byte, 16> address;
  if (::inet_pton(bracketed ? AF_INET6 : AF_INET, name.c_str(), address.data()) == 1) return true;
  if (bracketed || name.empty()) return false;
  return same_word(name, "localhost") ||
         std::ranges::any_of(names, [&](const std::string& own) { return same_word(name, own); });
}

/// One connection: reads a request, writes a response, closes.
class MetricsServer::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, const MetricsServer& server)
      : socket_(std::move(socket)), timer_(socket_.get_executor()), server_(server) {}

  void start() {
    timer_.expires_after(server_.deadline_);
    timer_.async_wait([weak = weak_from_this()](const asio::error_code& cancelled) {
      if (const auto self = weak.lock(); self && !cancelled) self->drop();
    });
    asio::async_read_until(
        socket_, asio::dynamic_buffer(request_, kRequestMax), "\r\n\r\n",
        [self = shared_from_this()](const asio::error_code& error, std::size_t size) {
          if (error) return self->end();  // the peer closed, was too slow, or sent more than a monitoring request needs
          self->on_request(self->request_.substr(0, size));
        });
  }

  /// Resets the connection, so that the kernel keeps no unread response.
  void drop() {
    asio::error_code ignored;
    socket_.set_option(asio::socket_base::linger(true, 0), ignored);
    timer_.cancel();
    socket_.close(ignored);
  }

  void end() {
    asio::error_code ignored;
    timer_.cancel();
    socket_.shutdown(tcp::socket::shutdown_both, ignored);
    socket_.close(ignored);
  }

 private:
  void on_request(const std::string& request) {
    const std::string line = request.substr(0, request.find("\r\n"));
    const auto method_end = line.find(' '), path_end = line.rfind(' ');
    if (method_end == std::string::npos || path_end <= method_end || !line.substr(path_end + 1).starts_with("HTTP/1."))
      return answer({400, "text/plain", "not HTTP/1.1\n"}, true);
    const std::string method = line.substr(0, method_end);
    if (method != "GET" && method != "HEAD") return answer({405, "text/plain", "only GET\n"}, true);
    const auto hosts = values_of(request, "Host");
    const bool may_lack = line.ends_with("/1.0");  // [RFC 9112, 3.2]
    if (hosts.size() > 1 || (hosts.empty() && !may_lack))
      return answer({400, "text/plain", "one Host header is needed\n"}, true);
    if (!hosts.empty() && !host_is_ours(hosts.front(), server_.names_))
      return answer({421, "text/plain",
                     "the Host header names an unknown host: use the address of the server, or add the name to "
                     "metrics_host of its configuration\n"},
                    true);
    std::string path = line.substr(method_end + 1, path_end - method_end - 1);
    path = path.substr(0, path.find('?'));
    answer(server_.handler_(path), method == "GET");
  }

  void answer(const HttpResponse& page, bool with_body) {
    response_ = "HTTP/1.1 " + std::to_string(page.status) + " " + reason_of(page.status) +
                "\r\nContent-Type: " + page.type + "\r\nContent-Length: " + std::to_string(page.body.size()) +
                "\r\nCache-Control: no-store\r\nConnection: close\r\n" +
                (page.status == 405 ? "Allow: GET, HEAD\r\n" : "") + "\r\n" + (with_body ? page.body : "");
    asio::async_write(socket_, asio::buffer(response_),
                      [self = shared_from_this()](const asio::error_code&, std::size_t) { self->end(); });
  }

  tcp::socket socket_;
  asio::steady_timer timer_;
  const MetricsServer& server_;
  std::string request_, response_;
};

MetricsServer::MetricsServer(asio::io_context& context, RequestHandler pages, std::vector<std::string> names,
                             std::chrono::milliseconds deadline)
    : context_(context),
      handler_(std::move(pages)),
      names_(std::move(names)),
      deadline_(deadline),
      acceptor_(context),
      accept_pause_(context) {
  names_.push_back(own_name());
}

std::string MetricsServer::listen(const io::SocketAddress& at) {
  const auto bound = start_listening(acceptor_, at, static_cast<int>(kConnectionsMax), false);
  if (!bound) return bound.error();
  address_ = *bound;
  accept_next();
  return {};
}

void MetricsServer::accept_next() {
  acceptor_.async_accept([this](const asio::error_code& error, tcp::socket socket) {
    if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
    connections_.remove_if([](const auto& connection) { return connection.expired(); });
    if (error) {
      accept_pause_.expires_after(kRest);
      accept_pause_.async_wait([this](const asio::error_code& cancelled) {
        if (!cancelled) accept_next();
      });
      return;
    }
    if (connections_.size() >= kConnectionsMax) {
      if (const auto oldest = connections_.front().lock()) oldest->drop();
      connections_.pop_front();
    }
    const auto connection = std::make_shared<Connection>(std::move(socket), *this);
    connections_.push_back(connection);
    connection->start();
    accept_next();
  });
}

void MetricsServer::stop() {
  asio::error_code ignored;
  acceptor_.close(ignored);
  accept_pause_.cancel();
  for (const auto& connection : connections_)
    if (const auto alive = connection.lock()) alive->end();
}

}  // namespace tandem::server
