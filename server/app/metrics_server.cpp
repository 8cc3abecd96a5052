#include "server/app/metrics_server.h"

#include <asio/buffer.hpp>
#include <asio/read_until.hpp>
#include <asio/steady_timer.hpp>
#include <asio/write.hpp>
#include <chrono>
#include <cstring>

namespace tandem::server {
namespace {

using asio::ip::tcp;

constexpr std::size_t kRequestMax = 4096;  // [bytes]
constexpr std::size_t kConnectionsMax = 16;
constexpr auto kPatience = std::chrono::seconds(5);
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
    default:
      return "Service Unavailable";
  }
}

}  // namespace

/// One connection: a request, an answer, the end.
class MetricsServer::Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(tcp::socket socket, const Pages& pages) : socket_(std::move(socket)), timer_(socket_.get_executor()), pages_(pages) {}

  void start() {
    timer_.expires_after(kPatience);
    timer_.async_wait([weak = weak_from_this()](const asio::error_code& cancelled) {
      if (const auto self = weak.lock(); self && !cancelled) self->end();
    });
    asio::async_read_until(socket_, asio::dynamic_buffer(request_, kRequestMax), "\r\n\r\n", [self = shared_from_this()](const asio::error_code& error, std::size_t size) {
      if (error) return self->end();  // gone, too slow, or longer than any request of those who look on
      self->took(self->request_.substr(0, size));
    });
  }

  void end() {
    asio::error_code ignored;
    timer_.cancel();
    socket_.shutdown(tcp::socket::shutdown_both, ignored);
    socket_.close(ignored);
  }

 private:
  void took(const std::string& request) {
    const std::string line = request.substr(0, request.find("\r\n"));
    const auto method_end = line.find(' '), path_end = line.rfind(' ');
    if (method_end == std::string::npos || path_end <= method_end || !line.substr(path_end + 1).starts_with("HTTP/1.")) return answer({400, "text/plain", "not HTTP/1.1\n"}, true);
    const std::string method = line.substr(0, method_end);
    if (method != "GET" && method != "HEAD") return answer({405, "text/plain", "only GET\n"}, true);
    std::string path = line.substr(method_end + 1, path_end - method_end - 1);
    path = path.substr(0, path.find('?'));
    answer(pages_(path), method == "GET");
  }

  void answer(const Page& page, bool with_body) {
    response_ = "HTTP/1.1 " + std::to_string(page.status) + " " + reason_of(page.status) + "\r\nContent-Type: " + page.type +
                "\r\nContent-Length: " + std::to_string(page.body.size()) + "\r\nCache-Control: no-store\r\nConnection: close\r\n" +
                (page.status == 405 ? "Allow: GET, HEAD\r\n" : "") + "\r\n" + (with_body ? page.body : "");
    asio::async_write(socket_, asio::buffer(response_), [self = shared_from_this()](const asio::error_code&, std::size_t) { self->end(); });
  }

  tcp::socket socket_;
  asio::steady_timer timer_;
  const Pages& pages_;
  std::string request_, response_;
};

MetricsServer::MetricsServer(asio::io_context& context, Pages pages) : context_(context), pages_(std::move(pages)), acceptor_(context), rest_(context) {}

std::string MetricsServer::listen(const io::SocketAddress& at) {
  tcp::endpoint endpoint;
  endpoint.resize(at.size);
  std::memcpy(endpoint.data(), at.get(), at.size);
  asio::error_code error;
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(static_cast<int>(kConnectionsMax), error);
  if (!error) endpoint = acceptor_.local_endpoint(error);
  if (error) return "cannot listen on " + io::to_text(at) + ": " + error.message();
  address_.size = static_cast<socklen_t>(endpoint.size());
  std::memcpy(&address_.storage, endpoint.data(), endpoint.size());
  accept_next();
  return {};
}

void MetricsServer::accept_next() {
  acceptor_.async_accept([this](const asio::error_code& error, tcp::socket socket) {
    if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
    visits_.remove_if([](const auto& visit) { return visit.expired(); });
    if (error) {
      rest_.expires_after(kRest);
      rest_.async_wait([this](const asio::error_code& cancelled) {
        if (!cancelled) accept_next();
      });
      return;
    }
    if (visits_.size() < kConnectionsMax) {
      const auto visit = std::make_shared<Visit>(std::move(socket), pages_);
      visits_.push_back(visit);
      visit->start();
    }
    accept_next();
  });
}

void MetricsServer::stop() {
  asio::error_code ignored;
  acceptor_.close(ignored);
  rest_.cancel();
  for (const auto& visit : visits_)
    if (const auto alive = visit.lock()) alive->end();
}

}  // namespace tandem::server
