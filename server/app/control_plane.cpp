#include "server/app/control_plane.h"

#include <asio/ip/v6_only.hpp>
#include <asio/post.hpp>
#include <csignal>
#include <cstring>
#include <netinet/tcp.h>

#include "server/app/control_connection.h"

namespace tandem::server {
namespace {

using asio::ip::tcp;

/// A connection stands as long as it is open, so who vanished without a word must be noticed by the kernel: after half a minute of
/// silence it asks, three times.
void notice_the_dead(tcp::socket& socket) {
  asio::error_code ignored;
  socket.set_option(tcp::socket::keep_alive(true), ignored);
  const auto set = [&](int option, int value) { ::setsockopt(socket.native_handle(), IPPROTO_TCP, option, &value, sizeof value); };
  set(TCP_KEEPIDLE, 30);
  set(TCP_KEEPINTVL, 10);
  set(TCP_KEEPCNT, 3);
}

/// After an error of accepting that is ours, such as no file descriptors left.
constexpr auto kRest = std::chrono::milliseconds(100);

}  // namespace

std::string_view to_text(ControlEvent event) noexcept {
  constexpr std::array<std::string_view, kControlEvents> kNames{"accepted", "too_fast",     "handshake_failed", "deadline", "too_much_input",
                                                                "bad_frame", "not_enrolled", "blocked",          "enrolled", "code_refused",
                                                                "welcomed",  "refused",      "command",          "command_too_fast", "trouble", "forbidden"};
  const auto i = static_cast<std::size_t>(event);
  return i < kNames.size() ? kNames[i] : "?";
}

ControlPlane::ControlPlane(asio::io_context& context, trust::ServerTrust& trust, Admissions& admissions, const ControlLimits& limits, ControlClocks clocks,
                           std::function<void(const ControlNews&)> tell)
    : context_(context),
      trust_(trust),
      admissions_(admissions),
      limits_(limits),
      clocks_(std::move(clocks)),
      tell_(std::move(tell)),
      tls_(trust::server_tls(trust.identity())),
      accepts_(limits.accept) {}

ControlPlane::~ControlPlane() { stop(); }

std::expected<io::SocketAddress, std::string> ControlPlane::listen(const io::SocketAddress& at) {
  tcp::endpoint endpoint;
  endpoint.resize(at.size);
  std::memcpy(endpoint.data(), at.get(), at.size);
  Door& door = doors_.emplace_back(Door{tcp::acceptor(context_), asio::steady_timer(context_)});
  asio::error_code error;
  const auto tried = [&error](auto&&... call) { return (... && (call(), !error)); };
  const bool good = tried([&] { door.acceptor.open(endpoint.protocol(), error); }, [&] { door.acceptor.set_option(tcp::acceptor::reuse_address(true), error); },
                          [&] {
                            if (endpoint.protocol() == tcp::v6()) door.acceptor.set_option(asio::ip::v6_only(true), error);
                          },
                          [&] { door.acceptor.bind(endpoint, error); }, [&] { door.acceptor.listen(4096, error); }, [&] { door.acceptor.non_blocking(true, error); },
                          [&] { endpoint = door.acceptor.local_endpoint(error); });
  if (!good) {
    doors_.pop_back();
    return std::unexpected("cannot listen on " + io::to_text(at) + ": " + error.message());
  }
  io::SocketAddress bound;
  bound.size = static_cast<socklen_t>(endpoint.size());
  std::memcpy(&bound.storage, endpoint.data(), endpoint.size());
  accept_next(door);
  return bound;
}

void ControlPlane::accept_next(Door& door) {
  if (stopped_ || (connections_.size() >= limits_.connections && !make_room())) return;
  if (door.accepting || pending_ >= limits_.pending) return;  // to make room may have opened it again
  door.accepting = true;
  if (const Duration pause = accepts_.pause(clocks_.monotonic()); pause > Duration::zero()) {
    door.pause.expires_after(pause);
    door.pause.async_wait([this, &door](const asio::error_code& error) {
      door.accepting = false;
      if (!error) accept_next(door);
    });
    return;
  }
  door.acceptor.async_accept([this, &door](const asio::error_code& error, tcp::socket socket) {
    door.accepting = false;
    if (stopped_ || error == asio::error::operation_aborted) return;
    if (!error) {
      took(door, std::move(socket));
      return accept_next(door);
    }
    note(ControlEvent::kTrouble, "", "", "accept: " + error.message());
    door.accepting = true;
    door.pause.expires_after(kRest);
    door.pause.async_wait([this, &door](const asio::error_code& cancelled) {
      door.accepting = false;
      if (!cancelled) accept_next(door);
    });
  });
}

bool ControlPlane::make_room() {
  for (const auto& connection : connections_) {
    if (!connection->dispensable()) continue;
    const auto kept = connection;  // it leaves the set
    kept->stop();
    return true;
  }
  return false;
}

void ControlPlane::took(Door&, tcp::socket socket) {
  asio::error_code error;
  const tcp::endpoint from = socket.remote_endpoint(error);
  if (error) return;  // gone already
  const trust::Source source = from.address().is_v4() ? trust::Source::v4(from.address().to_v4().to_uint()) : trust::Source::of_v6(from.address().to_v6().to_bytes());
  io::SocketAddress address;
  address.size = static_cast<socklen_t>(from.size());
  std::memcpy(&address.storage, from.data(), from.size());
  std::string text = io::to_text(address);
  if (!accepts_.accept(source, clocks_.monotonic())) return note(ControlEvent::kTooFast, std::move(text));
  note(ControlEvent::kAccepted, text);
  socket.set_option(tcp::no_delay(true), error);
  notice_the_dead(socket);
  socket.set_option(asio::socket_base::send_buffer_size(limits_.unread_max / 2), error);  // Linux doubles it, for its own book-keeping
  ++pending_;
  const auto connection = std::make_shared<ControlConnection>(*this, std::move(socket), source, std::move(text));
  connections_.insert(connection);
  connection->start();
}

void ControlPlane::note(ControlEvent event, std::string address, std::string workstation, std::string detail) {
  counts_[static_cast<std::size_t>(event)].fetch_add(1, std::memory_order_relaxed);
  if (tell_) tell_({event, std::move(address), std::move(workstation), std::move(detail)});
}

void ControlPlane::no_longer_pending() {
  --pending_;
  open_doors();
}

void ControlPlane::ended(const std::shared_ptr<ControlConnection>& connection) {
  connections_.erase(connection);
  open_doors();
}

void ControlPlane::open_doors() {
  for (Door& door : doors_) accept_next(door);
}

void ControlPlane::look_for_revoked() {
  const auto all = connections_;
  for (const auto& connection : all) connection->look_for_revocation();
}

void ControlPlane::stop() {
  if (stopped_) return;
  stopped_ = true;
  asio::error_code ignored;
  for (Door& door : doors_) {
    door.acceptor.close(ignored);
    door.pause.cancel();
  }
  const auto all = connections_;
  for (const auto& connection : all) connection->stop();
}

void ControlThread::start() {
  work_.emplace(context_.get_executor());
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { context_.run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void ControlThread::stop(std::function<void()> last) {
  if (!thread_.joinable()) return;
  asio::post(context_, std::move(last));
  work_.reset();
  thread_.join();
}

ControlThread::~ControlThread() {
  if (!thread_.joinable()) return;
  context_.stop();
  thread_.join();
}

}  // namespace tandem::server
