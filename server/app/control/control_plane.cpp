#include "server/app/control/control_plane.h"

#include <netinet/tcp.h>

#include <asio/ip/v6_only.hpp>
#include <asio/post.hpp>
#include <csignal>
#include <cstring>

#include "server/app/control/control_connection.h"

namespace tandem::server {
namespace {

using asio::ip::tcp;

/// Enables TCP keep-alive. A seat's control connection stays open for the whole session, so the kernel must detect
/// vanished peers. It sends three probes after 30 s of silence.
void enable_keepalive(tcp::socket& socket) {
  asio::error_code ignored;
  socket.set_option(tcp::socket::keep_alive(true), ignored);
  const auto set = [&](int option, int value) {
    ::setsockopt(socket.native_handle(), IPPROTO_TCP, option, &value, sizeof value);
  };
  set(TCP_KEEPIDLE, 30);
  set(TCP_KEEPINTVL, 10);
  set(TCP_KEEPCNT, 3);
}

/// Pause after a failed accept that the server itself causes, such as a lack of file descriptors.
constexpr auto kAcceptPause = std::chrono::milliseconds(100);
constexpr auto kSweep = std::chrono::milliseconds(250);
/// Rate and burst of accepted connections. Accepting and closing a connection costs about 20 us.
constexpr double kTakenPerS = 5000, kTakenAtOnce = 1000;

auth::PendingSlots::Limits pending_limits(const ControlLimits& limits) {
  return {.places = kMostPerPending * limits.pending,
          .pending = limits.pending,
          .handshakes_per_s = limits.accept.all_rate,
          .handshakes_at_once = limits.accept.all_burst,
          .first_byte = limits.first_byte,
          .first_byte_pressed = limits.first_byte_pressed,
          .deadline = limits.deadline};
}

/// With ephemeral keys all clients share one key, so only their sources distinguish them.
auth::ConnectionSlots::Limits connection_limits(const ControlLimits& limits, bool one_key) {
  return {.places = limits.connections,
          .per_key = one_key ? limits.unjoined_per_source : limits.unjoined_per_key,
          .per_source = limits.unjoined_per_source,
          .idle = limits.unjoined_idle};
}

/// Resets a connection: the kernel keeps no data of it.
void reset(tcp::socket& socket) {
  asio::error_code ignored;
  socket.set_option(asio::socket_base::linger(true, 0), ignored);
  socket.close(ignored);
}

}  // namespace

std::string_view to_text(ControlEvent event) noexcept {
  constexpr std::array<std::string_view, kControlEvents> kNames{
      "accepted", "rate_limited", "handshake_failed", "deadline", "too_much_input", "bad_frame", "not_enrolled",
      "blocked",  "enrolled",     "code_refused",     "welcomed", "refused",        "command",   "command_rate_limited",
      "error",    "forbidden",    "evicted",          "idle",     "too_many"};
  const auto i = static_cast<std::size_t>(event);
  return i < kNames.size() ? kNames[i] : "?";
}

std::string_view control_event_text(ControlEvent event) noexcept {
  constexpr std::array<std::string_view, kControlEvents> kWords{"connected",
                                                                "connected too often",
                                                                "failed in the TLS handshake",
                                                                "took too long",
                                                                "sent too much",
                                                                "sent an invalid message",
                                                                "is not enrolled here",
                                                                "is blocked after too many wrong codes",
                                                                "was enrolled",
                                                                "was refused for a wrong code",
                                                                "joined",
                                                                "was refused",
                                                                "sent a command",
                                                                "sent commands too often",
                                                                "met an error",
                                                                "may not do that",
                                                                "was closed for another connection",
                                                                "was silent for too long",
                                                                "had too many connections"};
  const auto i = static_cast<std::size_t>(event);
  return i < kWords.size() ? kWords[i] : "?";
}

ControlPlane::ControlPlane(asio::io_context& context, auth::ServerKeystore& trust, JoinHandler& admissions,
                           const ControlLimits& limits, ControlClocks clocks,
                           std::function<void(const ControlEventRecord&)> tell)
    : context_(context),
      trust_(trust),
      join_handler_(admissions),
      limits_(limits),
      clocks_(std::move(clocks)),
      on_event_(std::move(tell)),
      tls_(auth::server_tls(trust.identity())),
      accept_rate_(kTakenPerS, kTakenAtOnce),
      accepts_(limits.accept),
      attempts_(limits.loopback_exempt),
      pending_(pending_limits(limits)),
      places_(connection_limits(limits, !trust.on_disk())),
      pending_timer_(context),
      sweep_timer_(context) {
  schedule_sweep();
}

ControlPlane::~ControlPlane() { stop(); }

std::expected<io::SocketAddress, std::string> ControlPlane::listen(const io::SocketAddress& at) {
  tcp::endpoint endpoint;
  endpoint.resize(at.size);
  std::memcpy(endpoint.data(), at.get(), at.size);
  Acceptor& door = acceptors_.emplace_back(Acceptor{tcp::acceptor(context_), asio::steady_timer(context_)});
  asio::error_code error;
  const auto tried = [&error](auto&&... call) { return (... && (call(), !error)); };
  const bool good =
      tried([&] { door.acceptor.open(endpoint.protocol(), error); },
            [&] { door.acceptor.set_option(tcp::acceptor::reuse_address(true), error); },
            [&] {
              if (endpoint.protocol() == tcp::v6()) door.acceptor.set_option(asio::ip::v6_only(true), error);
            },
            [&] { door.acceptor.bind(endpoint, error); }, [&] { door.acceptor.listen(4096, error); },
            [&] { door.acceptor.non_blocking(true, error); }, [&] { endpoint = door.acceptor.local_endpoint(error); });
  if (!good) {
    acceptors_.pop_back();
    return std::unexpected("cannot listen on " + io::to_text(at) + ": " + error.message());
  }
  io::SocketAddress bound;
  bound.size = static_cast<socklen_t>(endpoint.size());
  std::memcpy(&bound.storage, endpoint.data(), endpoint.size());
  accept_next(door);
  return bound;
}

void ControlPlane::pause_accepting(Acceptor& door, Duration time) {
  door.accepting = true;
  door.pause.expires_after(time);
  door.pause.async_wait([this, &door](const asio::error_code& cancelled) {
    door.accepting = false;
    if (!cancelled) accept_next(door);
  });
}

void ControlPlane::accept_next(Acceptor& door) {
  if (stopped_ || door.accepting) return;
  if (const Duration pause = accept_rate_.wait(clocks_.monotonic()); pause > Duration::zero())
    return pause_accepting(door, pause);
  door.accepting = true;
  door.acceptor.async_accept([this, &door](const asio::error_code& error, tcp::socket socket) {
    door.accepting = false;
    if (stopped_ || error == asio::error::operation_aborted) return;
    if (!error) {
      on_accepted(std::move(socket));
      return accept_next(door);
    }
    record_event(ControlEvent::kTrouble, "", "", "accept: " + error.message());
    if (error == asio::error::no_descriptors)
      if (const auto id = pending_.evict(clocks_.monotonic())) close_unproven(*id, ControlEvent::kEvicted);
    pause_accepting(door, kAcceptPause);
  });
}

void ControlPlane::on_accepted(tcp::socket socket) {
  const Time now = clocks_.monotonic();
  (void)accept_rate_.take(now);
  asio::error_code error;
  const tcp::endpoint from = socket.remote_endpoint(error);
  if (error) return;  // the peer has closed it already
  const bool v4 = from.address().is_v4();
  const auth::Source source =
      v4 ? auth::Source::v4(from.address().to_v4().to_uint()) : auth::Source::of_v6(from.address().to_v6().to_bytes());
  const auth::Origin origin =
      v4 ? auth::Origin::v4(from.address().to_v4().to_uint()) : auth::Origin::of_v6(from.address().to_v6().to_bytes());
  io::SocketAddress address;
  address.size = static_cast<socklen_t>(from.size());
  std::memcpy(&address.storage, from.data(), from.size());
  std::string text = io::to_text(address);
  if (!accepts_.accept(source, now)) {
    reset(socket);
    return record_event(ControlEvent::kTooFast, std::move(text));
  }
  record_event(ControlEvent::kAccepted, text);
  const auto placed = pending_.arrive(origin, returning_.contains(origin, now), now);
  waiting_.emplace(placed.id, std::make_shared<PendingConnection>(
                                  PendingConnection{std::move(socket), origin, source, std::move(text), now}));
  wait_for_first_byte(placed.id);
  if (placed.evicted) close_unproven(*placed.evicted, ControlEvent::kEvicted);
  service_pending();
}

// A silent connection costs neither a TLS context nor a part of the shared handshake rate.
void ControlPlane::wait_for_first_byte(Id id) {
  waiting_.at(id)->socket.async_wait(tcp::socket::wait_read, [this, id](const asio::error_code& error) {
    if (!stopped_ && error != asio::error::operation_aborted) on_first_byte(id);
  });
}

void ControlPlane::on_first_byte(Id id) {
  const auto found = waiting_.find(id);
  if (found == waiting_.end()) return;
  std::byte first;
  const ssize_t size = ::recv(found->second->socket.native_handle(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return wait_for_first_byte(id);
  if (size <= 0) {
    record_event(ControlEvent::kHandshakeFailed, found->second->address, "",
                 "the peer closed the connection before the TLS handshake");
    waiting_.erase(found);
    pending_.leave(id);
  } else {
    pending_.first_byte(id);
  }
  service_pending();
}

void ControlPlane::service_pending() {
  if (stopped_ || servicing_pending_) return;  // closing a connection calls this function again
  servicing_pending_ = true;
  const Time now = clocks_.monotonic();
  while (const auto late = pending_.expire(now)) close_unproven(*late, ControlEvent::kDeadline);
  while (const auto next = pending_.next_handshake(now)) {
    if (next->evicted) close_unproven(*next->evicted, ControlEvent::kEvicted);
    begin_handshake(next->id);
  }
  servicing_pending_ = false;
  const auto next = pending_.next_event(now);
  if (!next || (pending_due_ && *pending_due_ <= *next && *pending_due_ > now)) return;
  pending_due_ = *next;
  pending_timer_.expires_after(std::max(*next - now, Duration{std::chrono::milliseconds(1)}));
  pending_timer_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled) return;
    pending_due_.reset();
    service_pending();
  });
}

void ControlPlane::begin_handshake(Id id) {
  const auto found = waiting_.find(id);
  const std::shared_ptr<PendingConnection> waited = found->second;
  waiting_.erase(found);
  tcp::socket& socket = waited->socket;
  asio::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  enable_keepalive(socket);
  // Linux doubles the value, for its own book-keeping.
  socket.set_option(asio::socket_base::send_buffer_size(limits_.unread_max / 2), ignored);
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(waited->arrived + limits_.deadline - clocks_.monotonic());
  const auto connection = std::make_shared<ControlConnection>(*this, id, std::move(socket), waited->origin,
                                                              waited->source, std::move(waited->address));
  connections_.emplace(id, connection);
  connection->start(std::max(left, std::chrono::milliseconds(1)));
}

void ControlPlane::close_unproven(Id id, ControlEvent why) {
  if (const auto waits = waiting_.find(id); waits != waiting_.end()) {
    record_event(why, waits->second->address);
    reset(waits->second->socket);
    waiting_.erase(waits);
  } else if (const auto open = connections_.find(id); open != connections_.end()) {
    const auto kept = open->second;  // keeps it alive while it leaves the table
    kept->close(why);
  }
}

void ControlPlane::close_unjoined() {
  while (const auto closed = places_.close_one(clocks_.monotonic())) {
    const auto found = connections_.find(closed->id);
    if (found == connections_.end()) continue;
    const auto kept = found->second;
    kept->close(closed->cause == auth::ConnectionSlots::Cause::kIdle ? ControlEvent::kIdle : ControlEvent::kTooMany);
  }
}

void ControlPlane::schedule_sweep() {
  sweep_timer_.expires_after(kSweep);
  sweep_timer_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled || stopped_) return;
    const Time now = clocks_.monotonic();
    for (const auto& [id, connection] : connections_) {
      const rpc::Welcome* const standing = connection->welcome();
      const bool holds = standing != nullptr && join_handler_.is_current(*standing);
      places_.set_joined(id, holds, now);
      if (holds && !standing->seat.empty()) returning_.note(connection->origin(), now);
    }
    close_unjoined();
    schedule_sweep();
  });
}

void ControlPlane::on_key_proved(const ControlConnection& connection) {
  pending_.leave(connection.id());
  places_.enter(connection.id(), connection.fingerprint(), connection.source(), clocks_.monotonic());
  close_unjoined();
  service_pending();
}

void ControlPlane::on_joined(const ControlConnection& connection, const rpc::Welcome& welcome) {
  const Time now = clocks_.monotonic();
  places_.set_joined(connection.id(), true, now);
  if (!welcome.seat.empty()) returning_.note(connection.origin(), now);
}

void ControlPlane::set_busy(const ControlConnection& connection, bool busy) {
  places_.set_busy(connection.id(), busy, clocks_.monotonic());
}

void ControlPlane::record_event(ControlEvent event, std::string address, std::string workstation, std::string detail) {
  counts_[static_cast<std::size_t>(event)].fetch_add(1, std::memory_order_relaxed);
  if (on_event_) on_event_({event, std::move(address), std::move(workstation), std::move(detail)});
}

void ControlPlane::on_ended(const ControlConnection& connection) {
  const Id id = connection.id();
  pending_.leave(id);
  places_.leave(id);
  connections_.erase(id);
  service_pending();
}

void ControlPlane::disconnect_revoked() {
  const auto all = connections_;
  for (const auto& [id, connection] : all) connection->disconnect_if_revoked();
}

void ControlPlane::stop() {
  if (stopped_) return;
  stopped_ = true;
  asio::error_code ignored;
  for (Acceptor& door : acceptors_) {
    door.acceptor.close(ignored);
    door.pause.cancel();
  }
  pending_timer_.cancel();
  sweep_timer_.cancel();
  waiting_.clear();
  const auto all = connections_;
  for (const auto& [id, connection] : all) connection->stop();
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
