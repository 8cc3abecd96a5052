#include "server/app/control/control_plane.h"

#include <netinet/tcp.h>

#include <utility>

#include "server/app/control/tcp_listener.h"

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

constexpr auto kSweep = std::chrono::milliseconds(250);

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

ControlPlane::ControlPlane(asio::io_context& context, auth::ServerKeystore& trust, JoinHandler& join_handler,
                           const ControlLimits& limits, ControlClocks clocks,
                           std::function<void(const ControlEventRecord&)> on_event)
    : services_{context,
                trust,
                join_handler,
                limits,
                std::move(clocks),
                ControlEvents(std::move(on_event)),
                auth::server_tls(trust.identity()),
                auth::AttemptLimiter(limits.loopback_exempt),
                auth::ConnectionSlots(connection_limits(limits, !trust.on_disk()))},
      acceptor_(context, services_.clocks.monotonic,
                {[this](tcp::socket socket) { on_accepted(std::move(socket)); },
                 [this](const asio::error_code& error) { on_accept_failed(error); }}),
      accept_limiter_(limits.accept),
      pending_(pending_limits(limits)),
      pending_timer_(context),
      sweep_timer_(context) {
  schedule_sweep();
}

ControlPlane::~ControlPlane() { stop(); }

void ControlPlane::on_accept_failed(const asio::error_code& error) {
  services_.events.record(ControlEvent::kTrouble, "", "", "accept: " + error.message());
  if (error == asio::error::no_descriptors)
    if (const auto id = pending_.evict(services_.now())) close_unproven(*id, ControlEvent::kEvicted);
}

void ControlPlane::on_accepted(tcp::socket socket) {
  const Time now = services_.now();
  asio::error_code error;
  const tcp::endpoint from = socket.remote_endpoint(error);
  if (error) return;  // the peer has closed it already
  const auto ip = from.address();
  const auth::Origin origin =
      ip.is_v4() ? auth::Origin::v4(ip.to_v4().to_uint()) : auth::Origin::of_v6(ip.to_v6().to_bytes());
  std::string text = io::to_text(socket_address_of(from));
  if (!accept_limiter_.accept(auth::Source::of(origin), now)) {
    reset(socket);
    return services_.events.record(ControlEvent::kTooFast, std::move(text));
  }
  services_.events.record(ControlEvent::kAccepted, text);
  const auto placed = pending_.arrive(origin, returning_.contains(origin, now), now);
  waiting_.emplace(placed.id, std::make_shared<PendingConnection>(
                                  PendingConnection{std::move(socket), origin, std::move(text), now}));
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
    services_.events.record(ControlEvent::kHandshakeFailed, found->second->address, "",
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
  const Time now = services_.now();
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
  socket.set_option(asio::socket_base::send_buffer_size(services_.limits.unread_max / 2), ignored);
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(waited->arrived + services_.limits.deadline - services_.now());
  const auto connection = std::make_shared<ControlConnection>(
      services_, id, std::move(socket), waited->origin, std::move(waited->address),
      [this](const ControlConnection& changed, ConnectionChange change) { on_change(changed, change); });
  connections_.emplace(id, connection);
  connection->start(std::max(left, std::chrono::milliseconds(1)));
}

void ControlPlane::close_unproven(Id id, ControlEvent why) {
  if (const auto waits = waiting_.find(id); waits != waiting_.end()) {
    services_.events.record(why, waits->second->address);
    reset(waits->second->socket);
    waiting_.erase(waits);
  } else if (const auto open = connections_.find(id); open != connections_.end()) {
    const auto kept = open->second;  // keeps it alive while it leaves the table
    kept->close(why);
  }
}

void ControlPlane::close_unjoined() {
  while (const auto closed = services_.slots.close_one(services_.now())) {
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
    const Time now = services_.now();
    for (const auto& [id, connection] : connections_) {
      const rpc::Welcome* const welcome = connection->welcome();
      const bool holds = welcome != nullptr && services_.join_handler.is_current(*welcome);
      services_.slots.set_joined(id, holds, now);
      if (holds && !welcome->seat.empty()) returning_.note(connection->origin(), now);
    }
    close_unjoined();
    schedule_sweep();
  });
}

void ControlPlane::on_change(const ControlConnection& connection, ConnectionChange change) {
  const Id id = connection.id();
  const Time now = services_.now();
  switch (change) {
    case ConnectionChange::kKeyProved:  // it no longer competes with unknown peers
      pending_.leave(id);
      services_.slots.enter(id, connection.fingerprint(), auth::Source::of(connection.origin()), now);
      close_unjoined();
      return service_pending();
    case ConnectionChange::kJoined:
      services_.slots.set_joined(id, true, now);
      if (!connection.welcome()->seat.empty()) returning_.note(connection.origin(), now);
      return;
    case ConnectionChange::kEnded:
      pending_.leave(id);
      services_.slots.leave(id);
      connections_.erase(id);
      return service_pending();
  }
}

void ControlPlane::disconnect_revoked() {
  const auto all = connections_;
  for (const auto& [id, connection] : all) connection->disconnect_if_revoked();
}

void ControlPlane::stop() {
  if (stopped_) return;
  stopped_ = true;
  acceptor_.stop();
  pending_timer_.cancel();
  sweep_timer_.cancel();
  waiting_.clear();
  const auto all = connections_;
  for (const auto& [id, connection] : all) connection->stop();
}

}  // namespace tandem::server
