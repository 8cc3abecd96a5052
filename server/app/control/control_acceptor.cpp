#include "server/app/control/control_acceptor.h"

#include <asio/ip/v6_only.hpp>
#include <cstring>
#include <utility>

namespace tandem::server {
namespace {

using asio::ip::tcp;

constexpr auto kFailurePause = std::chrono::milliseconds(100);
constexpr double kAcceptsPerS = 5000, kAcceptsBurst = 1000;

}  // namespace

ControlAcceptor::ControlAcceptor(asio::io_context& context, std::function<Time()> clock, Handlers handlers)
    : context_(context), clock_(std::move(clock)), handlers_(std::move(handlers)), rate_(kAcceptsPerS, kAcceptsBurst) {}

std::expected<io::SocketAddress, std::string> ControlAcceptor::listen(const io::SocketAddress& at) {
  tcp::endpoint endpoint;
  endpoint.resize(at.size);
  std::memcpy(endpoint.data(), at.get(), at.size);
  Listener& listener = listeners_.emplace_back(Listener{tcp::acceptor(context_), asio::steady_timer(context_)});
  tcp::acceptor& acceptor = listener.acceptor;
  asio::error_code error;
  const auto tried = [&error](auto&&... call) { return (... && (call(), !error)); };
  const bool good =
      tried([&] { acceptor.open(endpoint.protocol(), error); },
            [&] { acceptor.set_option(tcp::acceptor::reuse_address(true), error); },
            [&] {
              if (endpoint.protocol() == tcp::v6()) acceptor.set_option(asio::ip::v6_only(true), error);
            },
            [&] { acceptor.bind(endpoint, error); }, [&] { acceptor.listen(4096, error); },
            [&] { acceptor.non_blocking(true, error); }, [&] { endpoint = acceptor.local_endpoint(error); });
  if (!good) {
    listeners_.pop_back();
    return std::unexpected("cannot listen on " + io::to_text(at) + ": " + error.message());
  }
  io::SocketAddress bound;
  bound.size = static_cast<socklen_t>(endpoint.size());
  std::memcpy(&bound.storage, endpoint.data(), endpoint.size());
  accept_next(listener);
  return bound;
}

void ControlAcceptor::pause(Listener& listener, Duration time) {
  listener.busy = true;
  listener.timer.expires_after(time);
  listener.timer.async_wait([this, &listener](const asio::error_code& cancelled) {
    listener.busy = false;
    if (!cancelled) accept_next(listener);
  });
}

void ControlAcceptor::accept_next(Listener& listener) {
  if (stopped_ || listener.busy) return;
  if (const Duration wait = rate_.wait(clock_()); wait > Duration::zero()) return pause(listener, wait);
  listener.busy = true;
  listener.acceptor.async_accept([this, &listener](const asio::error_code& error, tcp::socket socket) {
    listener.busy = false;
    if (stopped_ || error == asio::error::operation_aborted) return;
    if (!error) {
      (void)rate_.take(clock_());
      handlers_.accepted(std::move(socket));
      return accept_next(listener);
    }
    handlers_.failed(error);
    pause(listener, kFailurePause);
  });
}

void ControlAcceptor::stop() {
  stopped_ = true;
  asio::error_code ignored;
  for (Listener& listener : listeners_) {
    listener.acceptor.close(ignored);
    listener.timer.cancel();
  }
}

}  // namespace tandem::server
