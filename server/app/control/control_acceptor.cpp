#include "server/app/control/control_acceptor.h"

#include <utility>

#include "server/app/control/tcp_listener.h"

namespace tandem::server {
namespace {

using asio::ip::tcp;

constexpr auto kFailurePause = std::chrono::milliseconds(100);
constexpr int kBacklog = 4096;
constexpr double kAcceptsPerS = 5000, kAcceptsBurst = 1000;

}  // namespace

ControlAcceptor::ControlAcceptor(asio::io_context& context, std::function<Time()> clock, Handlers handlers)
    : context_(context), clock_(std::move(clock)), handlers_(std::move(handlers)), rate_(kAcceptsPerS, kAcceptsBurst) {}

std::expected<io::SocketAddress, std::string> ControlAcceptor::listen(const io::SocketAddress& at) {
  tcp::acceptor acceptor(context_);
  auto bound = start_listening(acceptor, at, kBacklog, true);
  if (bound) accept_next(listeners_.emplace_back(Listener{std::move(acceptor), asio::steady_timer(context_)}));
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
