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
constexpr auto kSweep = std::chrono::milliseconds(250);
/// Connections taken from the kernel per second, and at once. To take one and close it again costs some 20 us.
constexpr double kTakenPerS = 5000, kTakenAtOnce = 1000;

trust::PendingPlaces::Limits pending_limits(const ControlLimits& limits) {
  return {.places = kMostPerPending * limits.pending,
          .pending = limits.pending,
          .handshakes_per_s = limits.accept.all_rate,
          .handshakes_at_once = limits.accept.all_burst,
          .first_byte = limits.first_byte,
          .first_byte_pressed = limits.first_byte_pressed,
          .deadline = limits.deadline};
}

/// Where keys are made on the spot everybody has the same one: there only sources tell people apart.
trust::ConnectionPlaces::Limits connection_limits(const ControlLimits& limits, bool one_key) {
  return {.places = limits.connections, .per_key = one_key ? limits.bare_per_source : limits.bare_per_key, .per_source = limits.bare_per_source, .idle = limits.bare_idle};
}

/// Ends a connection at once: the kernel keeps nothing of it.
void reset(tcp::socket& socket) {
  asio::error_code ignored;
  socket.set_option(asio::socket_base::linger(true, 0), ignored);
  socket.close(ignored);
}

}  // namespace

std::string_view to_text(ControlEvent event) noexcept {
  constexpr std::array<std::string_view, kControlEvents> kNames{"accepted", "too_fast",     "handshake_failed", "deadline", "too_much_input",
                                                                "bad_frame", "not_enrolled", "blocked",          "enrolled", "code_refused",
                                                                "welcomed",  "refused",      "command",          "command_too_fast", "trouble", "forbidden",
                                                                "evicted",   "idle",         "too_many"};
  const auto i = static_cast<std::size_t>(event);
  return i < kNames.size() ? kNames[i] : "?";
}

std::string_view words_of(ControlEvent event) noexcept {
  constexpr std::array<std::string_view, kControlEvents> kWords{
      "connected", "came too often", "failed in the TLS handshake", "took too long", "sent too much", "sent what is no message", "is not enrolled here",
      "is shut out after too many wrong codes", "was enrolled", "was refused for a wrong code", "was let in", "was refused", "gave an order", "gave orders too often",
      "met trouble", "may not do that", "made room for another", "said nothing for too long", "had too many connections"};
  const auto i = static_cast<std::size_t>(event);
  return i < kWords.size() ? kWords[i] : "?";
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
      taken_(kTakenPerS, kTakenAtOnce),
      accepts_(limits.accept),
      attempts_(limits.loopback_exempt),
      pending_(pending_limits(limits)),
      places_(connection_limits(limits, !trust.on_disk())),
      tend_(context),
      sweep_(context) {
  sweep_now_and_then();
}

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

void ControlPlane::rest(Door& door, Duration time) {
  door.accepting = true;
  door.pause.expires_after(time);
  door.pause.async_wait([this, &door](const asio::error_code& cancelled) {
    door.accepting = false;
    if (!cancelled) accept_next(door);
  });
}

void ControlPlane::accept_next(Door& door) {
  if (stopped_ || door.accepting) return;
  if (const Duration pause = taken_.wait(clocks_.monotonic()); pause > Duration::zero()) return rest(door, pause);
  door.accepting = true;
  door.acceptor.async_accept([this, &door](const asio::error_code& error, tcp::socket socket) {
    door.accepting = false;
    if (stopped_ || error == asio::error::operation_aborted) return;
    if (!error) {
      took(std::move(socket));
      return accept_next(door);
    }
    note(ControlEvent::kTrouble, "", "", "accept: " + error.message());
    if (error == asio::error::no_descriptors)
      if (const auto id = pending_.evict(clocks_.monotonic())) close_unproven(*id, ControlEvent::kEvicted);
    rest(door, kRest);
  });
}

void ControlPlane::took(tcp::socket socket) {
  const Time now = clocks_.monotonic();
  (void)taken_.take(now);
  asio::error_code error;
  const tcp::endpoint from = socket.remote_endpoint(error);
  if (error) return;  // gone already
  const bool v4 = from.address().is_v4();
  const trust::Source source = v4 ? trust::Source::v4(from.address().to_v4().to_uint()) : trust::Source::of_v6(from.address().to_v6().to_bytes());
  const trust::Origin origin = v4 ? trust::Origin::v4(from.address().to_v4().to_uint()) : trust::Origin::of_v6(from.address().to_v6().to_bytes());
  io::SocketAddress address;
  address.size = static_cast<socklen_t>(from.size());
  std::memcpy(&address.storage, from.data(), from.size());
  std::string text = io::to_text(address);
  if (!accepts_.accept(source, now)) {
    reset(socket);
    return note(ControlEvent::kTooFast, std::move(text));
  }
  note(ControlEvent::kAccepted, text);
  const auto placed = pending_.arrive(origin, returning_.contains(origin, now), now);
  waiting_.emplace(placed.id, std::make_shared<Waiting>(Waiting{std::move(socket), origin, source, std::move(text), now}));
  wait_for_first_byte(placed.id);
  if (placed.evicted) close_unproven(*placed.evicted, ControlEvent::kEvicted);
  tend();
}

// Somebody who says nothing costs neither TLS nor a handshake of everybody's rate.
void ControlPlane::wait_for_first_byte(Id id) {
  waiting_.at(id)->socket.async_wait(tcp::socket::wait_read, [this, id](const asio::error_code& error) {
    if (!stopped_ && error != asio::error::operation_aborted) first_byte(id);
  });
}

void ControlPlane::first_byte(Id id) {
  const auto found = waiting_.find(id);
  if (found == waiting_.end()) return;
  std::byte first;
  const ssize_t size = ::recv(found->second->socket.native_handle(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return wait_for_first_byte(id);
  if (size <= 0) {
    note(ControlEvent::kHandshakeFailed, found->second->address, "", "the other side ended the connection before it was safe");
    waiting_.erase(found);
    pending_.leave(id);
  } else {
    pending_.first_byte(id);
  }
  tend();
}

void ControlPlane::tend() {
  if (stopped_ || tending_) return;  // what is closed here comes by again
  tending_ = true;
  const Time now = clocks_.monotonic();
  while (const auto late = pending_.expire(now)) close_unproven(*late, ControlEvent::kDeadline);
  while (const auto next = pending_.next_handshake(now)) {
    if (next->evicted) close_unproven(*next->evicted, ControlEvent::kEvicted);
    begin_handshake(next->id);
  }
  tending_ = false;
  const auto next = pending_.next_event(now);
  if (!next || (tend_at_ && *tend_at_ <= *next && *tend_at_ > now)) return;
  tend_at_ = *next;
  tend_.expires_after(std::max(*next - now, Duration{std::chrono::milliseconds(1)}));
  tend_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled) return;
    tend_at_.reset();
    tend();
  });
}

void ControlPlane::begin_handshake(Id id) {
  const auto found = waiting_.find(id);
  const std::shared_ptr<Waiting> waited = found->second;
  waiting_.erase(found);
  tcp::socket& socket = waited->socket;
  asio::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  notice_the_dead(socket);
  socket.set_option(asio::socket_base::send_buffer_size(limits_.unread_max / 2), ignored);  // Linux doubles it, for its own book-keeping
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(waited->arrived + limits_.deadline - clocks_.monotonic());
  const auto connection = std::make_shared<ControlConnection>(*this, id, std::move(socket), waited->origin, waited->source, std::move(waited->address));
  connections_.emplace(id, connection);
  connection->start(std::max(left, std::chrono::milliseconds(1)));
}

void ControlPlane::close_unproven(Id id, ControlEvent why) {
  if (const auto waits = waiting_.find(id); waits != waiting_.end()) {
    note(why, waits->second->address);
    reset(waits->second->socket);
    waiting_.erase(waits);
  } else if (const auto open = connections_.find(id); open != connections_.end()) {
    const auto kept = open->second;  // it leaves the table
    kept->close(why);
  }
}

void ControlPlane::close_bare() {
  while (const auto closed = places_.close_one(clocks_.monotonic())) {
    const auto found = connections_.find(closed->id);
    if (found == connections_.end()) continue;
    const auto kept = found->second;
    kept->close(closed->cause == trust::ConnectionPlaces::Cause::kIdle ? ControlEvent::kIdle : ControlEvent::kTooMany);
  }
}

void ControlPlane::sweep_now_and_then() {
  sweep_.expires_after(kSweep);
  sweep_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled || stopped_) return;
    const Time now = clocks_.monotonic();
    for (const auto& [id, connection] : connections_) {
      const control::Welcome* const standing = connection->standing();
      const bool holds = standing != nullptr && admissions_.holds(*standing);
      places_.set_joined(id, holds, now);
      if (holds && !standing->seat.empty()) returning_.note(connection->origin(), now);
    }
    close_bare();
    sweep_now_and_then();
  });
}

void ControlPlane::proved(const ControlConnection& connection) {
  pending_.leave(connection.id());
  places_.enter(connection.id(), connection.pin(), connection.source(), clocks_.monotonic());
  close_bare();
  tend();
}

void ControlPlane::joined(const ControlConnection& connection, const control::Welcome& welcome) {
  const Time now = clocks_.monotonic();
  places_.set_joined(connection.id(), true, now);
  if (!welcome.seat.empty()) returning_.note(connection.origin(), now);
}

void ControlPlane::busy(const ControlConnection& connection, bool busy) { places_.set_busy(connection.id(), busy, clocks_.monotonic()); }

void ControlPlane::note(ControlEvent event, std::string address, std::string workstation, std::string detail) {
  counts_[static_cast<std::size_t>(event)].fetch_add(1, std::memory_order_relaxed);
  if (tell_) tell_({event, std::move(address), std::move(workstation), std::move(detail)});
}

void ControlPlane::ended(const ControlConnection& connection) {
  const Id id = connection.id();
  pending_.leave(id);
  places_.leave(id);
  connections_.erase(id);
  tend();
}

void ControlPlane::look_for_revoked() {
  const auto all = connections_;
  for (const auto& [id, connection] : all) connection->look_for_revocation();
}

void ControlPlane::stop() {
  if (stopped_) return;
  stopped_ = true;
  asio::error_code ignored;
  for (Door& door : doors_) {
    door.acceptor.close(ignored);
    door.pause.cancel();
  }
  tend_.cancel();
  sweep_.cancel();
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
